"""Hops: from the end of a segment of a state over one edge and along the segment that it leads to, to its end."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.annotation import Annotation
from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.graph_windows import composed


class Hops(NamedTuple):
    """All hops within one state, as flat arrays for kernels: R segments, H hops, T ticks.

    Args:
        row: the place of each segment among those of the state, ascending, -1 for others.  # (G,)
        start: the hops from row r are ``start[r]:start[r + 1]``.  # (R + 1,)
        edge: the edge of the graph that each takes, ascending.  # (H,)
        there: the row that each leads to.  # (H,)
        step: the planar place of the first node there, seen from the end here.  # (H, 3)
        tick_start: the nodes of row r are ``tick_start[r]:tick_start[r + 1]``.  # (R + 1,)
        tick: planar places of the nodes of rows, seen from the first of their segment.  # (T, 3)
    """

    row: NDArray[np.int32]
    start: NDArray[np.int32]
    edge: NDArray[np.int32]
    there: NDArray[np.int32]
    step: NDArray[np.float64]
    tick_start: NDArray[np.int32]
    tick: NDArray[np.float64]


def hops_within(graph: MotionGraph, annotation: Annotation, state: int) -> Hops:
    """All hops between segments of a state.

    Raises:
        InputError: for a segment that none leads on from, naming the state.
    """
    segments = annotation.of_state(state)
    row = np.full(annotation.segment_count, -1, dtype=np.int32)
    row[segments] = np.arange(len(segments))
    here, there = annotation.segment[graph.source], annotation.segment[graph.target]
    ends = graph.source == annotation.last[here]
    edge = np.flatnonzero(ends & (row[here] >= 0) & (row[there] >= 0))
    start = np.searchsorted(row[here[edge]], np.arange(len(segments) + 1))
    stuck = np.flatnonzero(np.diff(start) == 0)
    if stuck.size:
        problem = f"segment {segments[stuck[0]]} leads to none of its own state, expected transitions within it"
        raise InputError(problem, annotation.machine.place(state))
    length = annotation.length[segments]
    hops = Hops(
        row=row,
        start=start.astype(np.int32),
        edge=edge.astype(np.int32),
        there=row[there[edge]],
        step=graph.displacement[edge].astype(np.float64),
        tick_start=np.concatenate([[0], np.cumsum(length)]).astype(np.int32),
        tick=np.concatenate([_places(graph, annotation, segment) for segment in segments]),
    )
    return Hops(*(frozen(part, part.dtype) for part in hops))


def _places(graph: MotionGraph, annotation: Annotation, segment: int) -> NDArray[np.float64]:
    """Planar places of a segment's nodes, seen from its first.  # (length, 3)"""
    first, last = int(annotation.first[segment]), int(annotation.last[segment])
    places = np.zeros((last - first + 1, 3))
    for node in range(first, last):
        step = graph.displacement[graph.edge_start[node]].astype(np.float64)
        places[node - first + 1] = composed(places[node - first], step)
    return places
