"""The standard motion graph: every frame leads to its successor, and transitions to the frames after similar ones."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion.alignment import Alignment, turn
from footwork.motion.graph import MotionGraph
from footwork.motion.metric import Metric, PointCloudMetric
from footwork.training.nodes import Nodes
from footwork.training.transitions import Minima


@dataclass(frozen=True, eq=False)
class Edges:
    """Edges before they know where they lead on the ground.

    Args:
        source: the frame an edge leaves.  # (E,)
        similar: the frame like ``source`` whose successor is the target; ``source`` itself for natural edges.  # (E,)
        cost: s(source, similar), 0 for natural edges.  # (E,)
    """

    source: NDArray[np.intp]
    similar: NDArray[np.intp]
    cost: NDArray[np.float64]

    @property
    def target(self) -> NDArray[np.intp]:
        """The frame an edge leads to.  # (E,)"""
        return self.similar + 1


def edges_of(ends: NDArray[np.intp], minima: Minima) -> Edges:
    """Natural edges, and for a minimum (i, j) the edges i -> j + 1 and j -> i + 1 where those frames exist.

    Sorted by source; a frame's natural edge comes first, then its transitions by target.

    Args:
        ends: for each frame the last frame of its clip.  # (N,)
        minima: the pairs of similar frames.
    """
    natural = np.flatnonzero(np.arange(len(ends)) < ends)
    source = np.concatenate([natural, minima.i, minima.j])
    similar = np.concatenate([natural, minima.j, minima.i])
    cost = np.concatenate([np.zeros(len(natural)), minima.cost, minima.cost])
    order = np.lexsort((similar, source != similar, source))
    order = order[similar[order] < ends[similar[order]]]
    return Edges(source[order], similar[order], cost[order])


def standard_graph(
    nodes: Nodes, metric: Metric, minima: Minima, sigma: float, uniform: PointCloudMetric | None = None
) -> MotionGraph:
    """The standard motion graph over all frames.

    Args:
        nodes: the frames.
        metric: the metric of the same frames, which aligns the two sides of a transition.
        minima: the pairs of frames where transitions are.
        sigma: the task's smoothness_sigma: smoothness is exp(-s / sigma) by the uniform metric.
        uniform: that metric of the same frames, where ``metric`` is another.
    """
    edges = edges_of(nodes.ends, minima)
    judged = edges.cost.copy()
    if uniform is not None:
        jumps = np.flatnonzero(edges.source != edges.similar)
        judged[jumps] = uniform.pair_costs(edges.source[jumps], edges.similar[jumps])
    return MotionGraph(
        skeleton=nodes.skeleton,
        clips=nodes.clips,
        labels=nodes.labels,
        behaviours=nodes.behaviours,
        edge_start=np.searchsorted(edges.source, np.arange(len(nodes.ends) + 1)).astype(np.int32),
        target=edges.target.astype(np.int32),
        cost=edges.cost.astype(np.float32),
        smoothness=np.exp(-judged / sigma).astype(np.float32),
        displacement=_displacements(nodes.places, edges, metric).astype(np.float32),
        natural=edges.source == edges.similar,
        **nodes.arrays,
    )


def _displacements(places: NDArray, edges: Edges, metric: Metric) -> NDArray[np.float64]:
    """Each target's planar place in its source's planar frame, the transitions aligned by the metric.  # (E, 3)"""
    there = places[edges.target].copy()
    jumps = np.flatnonzero(edges.source != edges.similar)
    there[jumps] = moved(there[jumps], metric.align(edges.source[jumps], edges.similar[jumps]))
    return relative(places[edges.source], there)


def moved(places: NDArray, alignment: Alignment) -> NDArray[np.float64]:
    """Planar places x, z, yaw moved by an alignment.  # (M, 3)"""
    x, z = turn(places[:, 0], places[:, 1], alignment.theta)
    return np.column_stack([x + alignment.x0, z + alignment.z0, places[:, 2] + alignment.theta])


def relative(here: NDArray, there: NDArray) -> NDArray[np.float64]:
    """The planar places ``there`` seen from ``here``, yaw in -pi..pi.  # (M, 3)"""
    away = there - here
    x, z = turn(away[:, 0], away[:, 1], -here[:, 2])
    yaw = np.arctan2(np.sin(away[:, 2]), np.cos(away[:, 2]))
    return np.column_stack([x, z, yaw])
