"""Clips back out of a motion graph: the frames of one source clip in the order they were captured."""

import numpy as np

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph

FPS = 30.0


def clip_of_graph(graph: MotionGraph, clip: int) -> Clip:
    """The nodes of source clip ``clip`` as a clip of their own, placed by the natural edges between them.

    Where a frame is missing from the graph, the next one stands where the last one stood.

    Raises:
        InputError: for a clip of which the graph has no node.
    """
    nodes = np.flatnonzero(graph.clip == clip)
    if not nodes.size:
        raise InputError(f"clip {clip} has no node in it", graph.where)
    nodes = nodes[np.argsort(graph.frame[nodes], kind="stable")]
    places = np.zeros((len(nodes), 3))
    for row in range(1, len(nodes)):
        places[row] = _beyond(places[row - 1], _natural_step(graph, nodes[row - 1], nodes[row]))
    turn = quaternion.from_yaw(places[:, 2])
    rotations = graph.rotations[nodes].astype(np.float64)
    rotations[:, 0] = quaternion.multiply(turn, rotations[:, 0])
    return Clip(
        name=graph.clips[clip],
        skeleton=graph.skeleton,
        fps=FPS,
        root_position=graph.root_position[nodes] + places[:, [0, 0, 1]] * [1.0, 0.0, 1.0],
        rotations=rotations,
        contacts=graph.contacts[nodes],
        labels=np.array(graph.labels)[graph.label[nodes]],
    )


def clips_of_graph(graph: MotionGraph) -> list[Clip]:
    """All source clips of which the graph has a node."""
    return [clip_of_graph(graph, int(clip)) for clip in np.unique(graph.clip)]


def _natural_step(graph: MotionGraph, source: int, target: int) -> np.ndarray:
    edges = np.arange(graph.edge_start[source], graph.edge_start[source + 1])
    edges = edges[graph.natural[edges] & (graph.target[edges] == target)]
    return graph.displacement[edges[0]].astype(np.float64) if edges.size else np.zeros(3)


def _beyond(place: np.ndarray, step: np.ndarray) -> np.ndarray:
    """The planar place a step (x, z, yaw) beyond another."""
    ahead = quaternion.rotate(quaternion.from_yaw(place[2]), [step[0], 0.0, step[1]])
    return np.array([place[0] + ahead[0], place[1] + ahead[2], place[2] + step[2]])
