"""Breadth first search over a motion graph, whose edges all last one tick: what can be reached, and how soon.

Everything here takes flat arrays, so that it runs on any graph: ``edge_start`` (N + 1,) and ``target`` (E,) as in
MotionGraph.
"""

from collections.abc import Iterable

import numba
import numpy as np
from numpy.typing import ArrayLike, NDArray

UNREACHED = -1


def reversed_edges(edge_start: NDArray, target: NDArray) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """The same edges turned round, in CSR form: ``edge_start`` (N + 1,) and the nodes that lead to each node (E,)."""
    nodes = len(edge_start) - 1
    start = np.zeros(nodes + 1, dtype=np.int64)
    np.cumsum(np.bincount(target, minlength=nodes), out=start[1:])
    source = np.empty(len(target), dtype=np.int32)
    _turn_round(edge_start, target, start[:-1].copy(), source)
    return start, source


def ticks_from(edge_start: NDArray, target: NDArray, sources: ArrayLike) -> NDArray[np.int32]:
    """Ticks of the shortest way from the nearest of some nodes to each node, UNREACHED where there is none.  # (N,)

    On reversed edges these are the ticks from each node to the nearest of those nodes.
    """
    nodes = len(edge_start) - 1
    ticks = np.full(nodes, UNREACHED, dtype=np.int32)
    queue = np.empty(nodes, dtype=np.int32)
    starts = np.unique(np.asarray(sources, dtype=np.int32))
    queue[: len(starts)] = starts
    ticks[starts] = 0
    _spread(edge_start, target, queue, len(starts), ticks)
    return ticks


def ticks_between(edge_start: NDArray, target: NDArray, sources: Iterable[int], ends: NDArray) -> NDArray[np.int32]:
    """Ticks of the shortest ways from each of some nodes to each of others.  # (sources, ends)"""
    rows = [ticks_from(edge_start, target, [source])[ends] for source in sources]
    return np.array(rows, dtype=np.int32).reshape(-1, len(ends))


@numba.njit(cache=True, nogil=True)
def _turn_round(edge_start: NDArray, target: NDArray, place: NDArray, source: NDArray) -> None:
    for node in range(edge_start.shape[0] - 1):
        for edge in range(edge_start[node], edge_start[node + 1]):
            end = target[edge]
            source[place[end]] = node
            place[end] += 1


@numba.njit(cache=True, nogil=True)
def _spread(edge_start: NDArray, target: NDArray, queue: NDArray, waiting: int, ticks: NDArray) -> None:
    """Fill ``ticks`` outwards from the ``waiting`` nodes at the head of the queue."""
    done = 0
    while done < waiting:
        node = queue[done]
        done += 1
        for edge in range(edge_start[node], edge_start[node + 1]):
            end = target[edge]
            if ticks[end] < 0:
                ticks[end] = ticks[node] + 1
                queue[waiting] = end
                waiting += 1
