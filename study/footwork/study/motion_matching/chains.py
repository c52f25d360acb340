"""Frames of capture one after the other: the graph of all frames, and where each lies in its own motion."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.alignment import turn
from footwork.motion.arrays import frozen
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.metric import PointCloudMetric
from footwork.motion.mirror import mirrored
from footwork.motion.task import BEHAVIOURS
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import Minima


@dataclass(frozen=True, eq=False)
class Chains:
    """The natural edges of a graph of N nodes as stretches of successive nodes.

    Args:
        first: the first node of each node's stretch.  # (N,)
        last: the last one.  # (N,)
        place: planar place (x, z, yaw) of each node as seen from the first of its stretch.  # (N, 3)
        edge: the natural edge out of each node, -1 for none.  # (N,)
    """

    first: NDArray[np.int32]
    last: NDArray[np.int32]
    place: NDArray[np.float64]
    edge: NDArray[np.int32]


def graph_of_all_frames(clips: Sequence[Clip], mirror: bool = False) -> MotionGraph:
    """Every frame of some clips with natural edges alone: its last frames are dead ends, to be left by a leap.

    Args:
        clips: of the common body, at 30 frames a second.
        mirror: whether their mirror images come along.

    Raises:
        InputError: for no clips, clips of different bodies or not at 30 frames a second.
    """
    clips = [*clips, *(mirrored(clip) for clip in clips if mirror)]
    nodes = nodes_of(clips, BEHAVIOURS)
    none = np.zeros(0, np.intp)
    return standard_graph(nodes, PointCloudMetric.of_clips(clips), Minima(none, none, np.zeros(0)), sigma=1.0)


def chains_of(graph: MotionGraph) -> Chains:
    """The natural stretches of a graph.

    Raises:
        InputError: for a natural edge that does not lead to the node next in number.
    """
    edges = np.flatnonzero(graph.natural)
    source = graph.source[edges]
    astray = np.flatnonzero(graph.target[edges] != source + 1)
    if astray.size:
        problem = f"a natural edge from node {source[astray[0]]} to {graph.target[edges[astray[0]]]}"
        raise InputError(f"{problem}, expected natural edges to the next node only", graph.where)
    edge = np.full(graph.node_count, -1, np.int32)
    edge[source] = edges
    begins = np.concatenate([[True], edge[:-1] < 0])
    starts, which = np.flatnonzero(begins), np.cumsum(begins) - 1
    first, last = starts[which], np.append(starts[1:], graph.node_count)[which] - 1
    place = _places(graph, edge, first)
    return Chains(frozen(first, np.int32), frozen(last, np.int32), frozen(place, np.float64), frozen(edge, np.int32))


def _places(graph: MotionGraph, edge: NDArray, first: NDArray) -> NDArray[np.float64]:
    """Steps summed from the first node of each stretch on.  # (N, 3)"""
    step = np.where(edge[:, None] >= 0, graph.displacement[edge].astype(np.float64), 0.0)
    step = np.concatenate([np.zeros((1, 3)), step[:-1]])
    yaw = np.cumsum(step[:, 2])
    yaw -= yaw[first]
    before = np.concatenate([[0.0], yaw[:-1]])
    x, z = turn(step[:, 0], step[:, 1], before)
    along = np.cumsum(np.stack([x, z], axis=-1), axis=0)
    return np.column_stack([along - along[first], yaw])


def world_points(graph: MotionGraph, chains: Chains, joints: NDArray[np.intp] | slice) -> NDArray[np.float64]:
    """Joints of every node as seen from the first node of its stretch, metres.  # (N, joints, 3)"""
    points = graph.joint_places[:, joints]
    x, z = turn(points[..., 0], points[..., 2], chains.place[:, 2:])
    return np.stack([x + chains.place[:, :1], points[..., 1], z + chains.place[:, 1:2]], axis=-1)
