"""The quickest ways from every segment of a state to every segment of another, as tables of next hops.

Quickest is what spends the least time on the segments in between, which may be of these two states only; of equally
quick ways the smoothest is taken, by the sum of its transitions' s in whole 1/1024, then the edge of the lowest number.
The search goes backwards from each goal and lowers what is known until nothing falls (Bellman 1958, Ford 1956), over
whole numbers, so that the result is the same in every order.
"""

from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.annotation import NO_WAY, NextHops
from footwork.motion.graph import MotionGraph
from footwork.motion.threads import THREADS

_TICK = 1 << 40  # above any sum of roughness, which is under 1 << 20 an edge
_UNIT = 1024
_ROUGHEST = (1 << 20) - 1
_UNKNOWN = np.int64(1 << 62)


def next_hops(graph: MotionGraph, first: NDArray, rows: NDArray, goals: NDArray) -> NextHops:
    """The quickest ways from some segments to those of them that are goals, over none but these.

    Args:
        graph: a graph cut into segments, whose edges lead from the ends of segments to beginnings.
        first: the first node of each segment, and N.  # (G + 1,)
        rows: segments, ascending.  # (R,)
        goals: some of them, ascending.  # (T,)
    """
    edge, source, target = _hops(graph, first, rows)
    roughness = np.minimum(np.rint(_UNIT * graph.cost[edge].astype(np.float64)), _ROUGHEST).astype(np.int64)
    back = np.argsort(target, kind="stable")
    into = np.searchsorted(target[back], np.arange(len(rows) + 1))
    duration = np.diff(first)[rows].astype(np.int64) * _TICK
    cost, taken = np.empty((len(goals), len(rows)), dtype=np.int64), np.empty((len(goals), len(rows)), dtype=np.int64)

    def search(part: NDArray) -> None:
        _search(np.searchsorted(rows, goals), part, source, target, roughness, back, into, duration, cost, taken)

    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(search, (np.arange(thread, len(goals), THREADS) for thread in range(THREADS))))
    found = taken.T != NO_WAY
    numbers = np.append(edge, NO_WAY)  # NO_WAY picks the last
    return NextHops(numbers[taken.T], np.where(found, cost.T // _TICK, NO_WAY))


def _hops(graph: MotionGraph, first: NDArray, rows: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """The edges from the ends of segments to others, both among ``rows``, and which of them they join.  # (H,) each"""
    segment = np.repeat(np.arange(len(first) - 1), np.diff(first))
    place = np.full(len(first) - 1, -1, dtype=np.int64)
    place[rows] = np.arange(len(rows))
    here, there = segment[graph.source], segment[graph.target]
    edge = np.flatnonzero((graph.source == first[here + 1] - 1) & (place[here] >= 0) & (place[there] >= 0))
    return edge, place[here[edge]], place[there[edge]]


@numba.njit(cache=True, nogil=True)
def _search(
    goals: NDArray,
    part: NDArray,
    source: NDArray,
    target: NDArray,
    roughness: NDArray,
    back: NDArray,
    into: NDArray,
    duration: NDArray,
    cost: NDArray,
    taken: NDArray,
) -> None:
    """For the goals numbered in ``part``, fill their rows of ``cost`` (T, R) and of the hops taken (T, R).

    Hops into row r are ``back[into[r]:into[r + 1]]``; costs are of the way between, without both its ends.
    """
    count = into.shape[0] - 1
    queue, queued = np.empty(count + 1, dtype=np.int64), np.zeros(count, dtype=np.bool_)
    for number in part:
        goal, known = goals[number], cost[number]
        known[:] = _UNKNOWN
        begin, end = 0, 1
        queue[0] = goal
        while begin != end:
            here = queue[begin]
            begin = (begin + 1) % (count + 1)
            queued[here] = False
            passed = np.int64(0) if here == goal else known[here] + duration[here]
            for at in range(into[here], into[here + 1]):
                hop = back[at]
                further = passed + roughness[hop]
                before = source[hop]
                if further < known[before]:
                    known[before] = further
                    # a way that comes through its goal has ended there
                    if before != goal and not queued[before]:
                        queued[before] = True
                        queue[end] = before
                        end = (end + 1) % (count + 1)
        taken[number, :] = -1
        for hop in range(source.shape[0] - 1, -1, -1):
            rest = np.int64(0) if target[hop] == goal else known[target[hop]] + duration[target[hop]]
            if known[source[hop]] < _UNKNOWN and rest + roughness[hop] == known[source[hop]]:
                taken[number, source[hop]] = hop
