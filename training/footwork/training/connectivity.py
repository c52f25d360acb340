"""What of a graph can be walked without end: its largest strongly connected part, and what it takes to have one."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from footwork.motion.graph import EDGE_ARRAYS, NODE_ARRAYS, MotionGraph
from footwork.training.standard_graph import edges_of
from footwork.training.transitions import Minima


def largest_component(count: int, source: NDArray, target: NDArray) -> NDArray[np.intp]:
    """The nodes of the largest strongly connected part, ascending; none where there is no cycle.

    Of parts of one size the one with the lowest node is taken.

    Args:
        count: the number of nodes N.
        source: the node each edge leaves.  # (E,)
        target: the node it leads to.  # (E,)
    """
    matrix = csr_array((np.ones(len(source), dtype=np.int8), (source, target)), shape=(count, count))
    _, part = connected_components(matrix, directed=True, connection="strong")
    # parts of one node count only with an edge to itself
    sizes = np.bincount(part, minlength=1)
    sizes[(sizes == 1) & ~np.isin(np.arange(len(sizes)), part[source[source == target]])] = 0
    if not sizes.max(initial=0):
        return np.empty(0, dtype=np.intp)
    lowest = np.argmax(sizes[part] == sizes.max())
    return np.flatnonzero(part == part[lowest])


def restricted(graph: MotionGraph, nodes: NDArray[np.intp], links: NDArray[np.bool_] | None = None) -> MotionGraph:
    """The graph of some of its nodes (ascending) and the edges between them, or of those only that ``links`` has."""
    number = np.full(graph.node_count, -1, dtype=np.int32)
    number[nodes] = np.arange(len(nodes))
    source, target = number[graph.source], number[graph.target]
    kept = (source >= 0) & (target >= 0)
    if links is not None:
        kept &= links
    arrays = {name: getattr(graph, name)[nodes] for name in NODE_ARRAYS}
    arrays |= {name: getattr(graph, name)[kept] for name in EDGE_ARRAYS if name != "target"}
    start = np.searchsorted(source[kept], np.arange(len(nodes) + 1)).astype(np.int32)
    return replace(graph, edge_start=start, target=target[kept], **arrays)


def connecting_threshold(ends: NDArray[np.intp], minima: Minima, share: float = 0.5) -> float | None:
    """The smallest threshold whose largest strongly connected part holds ``share`` of all frames.

    None where even all minima together do not. Parts grow with the threshold, so halving the sorted costs finds it.

    Args:
        ends: for each frame the last frame of its clip.  # (N,)
        minima: all local minima, whatever they cost.
        share: of the frames, above 0.
    """

    def holds(threshold: float) -> bool:
        return _connected(ends, minima.under(threshold)) >= share * len(ends)

    return least_threshold(np.nextafter(np.unique(minima.cost), np.inf), holds)


def least_threshold(thresholds: NDArray[np.float64], holds: Callable[[float], bool]) -> float | None:
    """The first of ascending thresholds at which something holds that goes on to hold from there; None without one."""
    low, high = 0, len(thresholds)
    while low < high:
        middle = (low + high) // 2
        if holds(float(thresholds[middle])):
            high = middle
        else:
            low = middle + 1
    return float(thresholds[low]) if low < len(thresholds) else None


def _connected(ends: NDArray[np.intp], minima: Minima) -> int:
    edges = edges_of(ends, minima)
    return len(largest_component(len(ends), edges.source, edges.target))
