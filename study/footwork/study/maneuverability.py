"""Local maneuverability: how soon a character in the middle of some motion can begin another kind of motion.

LM_k = 1/|C| sum over c of (D_c / 2 + MDMPC_ck), LM the mean over k (Reitsma and Pollard 2007, as Zhao and Safonova
2008 use it): C are the motion segments of the graph, D_c their durations and MDMPC_ck the least duration of motion
from the end of c to any frame of kind k. Convention: segments are the longest chains without a branch, a segment of m
frames lasts m - 1 ticks, every edge one tick, and MDMPC is 0 where c ends in k already; the variant ``reentry``
asks there for the time until k is left and entered anew.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.study.breadth_first import UNREACHED, reversed_edges, ticks_from


@dataclass(frozen=True, eq=False)
class Segments:
    """The longest chains of nodes without a branch: each node is in one of them.

    Args:
        last: the last node of each.  # (C,)
        length: its nodes.  # (C,)
    """

    last: NDArray[np.int32]
    length: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Maneuverability:
    """Local maneuverability in seconds, by kind; kinds that no node has are left out.

    Args:
        kinds: the words.
        seconds: LM_k over the segments from which k can be reached, NaN where that is none.  # (K,)
        answered: share of the segments from which k can be reached.  # (K,)
    """

    kinds: tuple[str, ...]
    seconds: NDArray[np.float64]
    answered: NDArray[np.float64]

    @property
    def mean(self) -> float | None:
        """LM: the mean over the kinds that can be reached, None without any."""
        known = self.seconds[np.isfinite(self.seconds)]
        return float(known.mean()) if known.size else None

    def by_kind(self) -> dict[str, float | None]:
        """Seconds by word, None where it cannot be reached."""
        return {
            kind: float(value) if np.isfinite(value) else None
            for kind, value in zip(self.kinds, self.seconds, strict=True)
        }


def segments(edge_start: NDArray, target: NDArray) -> Segments:
    """Cut a graph into segments: a node goes on with the next where neither has another edge on that side.

    A loop without any branch is one segment that ends before its lowest node.
    """
    following = _only_successors(edge_start, target)
    first = np.ones(len(following), dtype=np.bool_)
    first[following[following >= 0]] = False
    last = np.empty(len(following), dtype=np.int32)
    length = np.empty(len(following), dtype=np.int64)
    count = _follow(following, first, last, length)
    return Segments(last[:count], length[:count])


def maneuverability(
    edge_start: NDArray,
    target: NDArray,
    kind: NDArray,
    kinds: Sequence[str],
    *,
    reentry: bool = False,
    frames: NDArray | None = None,
) -> Maneuverability:
    """Local maneuverability of a graph given in CSR form.

    With ``frames`` the mean goes over those nodes, each a segment of its own, instead of over the graph's segments:
    for comparing graphs over the same captured frames, whatever else they hold and wherever they branch.

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        kind: index into ``kinds`` of each node, -1 for none.  # (N,)
        kinds: the words, such as a graph's labels or behaviours.
        reentry: from within k, count the time until it is left and entered anew instead of 0.
        frames: the nodes to start from, all segments where not given.  # (F,)
    """
    cut = segments(edge_start, target) if frames is None else Segments(frames, np.ones(len(frames), dtype=np.int64))
    back = reversed_edges(edge_start, target)
    shown = [index for index in range(len(kinds)) if (kind == index).any()]
    seconds, answered = np.full(len(shown), np.nan), np.zeros(len(shown))
    for row, index in enumerate(shown):
        inside = kind == index
        ticks = ticks_from(*back, np.flatnonzero(inside))
        if reentry:
            ticks = _reentry_ticks(*back, inside, ticks)
        to_kind = ticks[cut.last]
        reached = to_kind != UNREACHED
        answered[row] = reached.mean()
        if reached.any():
            seconds[row] = (0.5 * (cut.length[reached] - 1) + to_kind[reached]).mean() * TICK
    return Maneuverability(tuple(kinds[index] for index in shown), seconds, answered)


def _only_successors(edge_start: NDArray, target: NDArray) -> NDArray[np.int32]:
    """The node that continues each node's segment, -1 where the segment ends.  # (N,)"""
    nodes = len(edge_start) - 1
    following = np.full(nodes, -1, dtype=np.int32)
    single = np.flatnonzero(np.diff(edge_start) == 1)
    after = target[edge_start[single]]
    alone = np.bincount(target, minlength=nodes)[after] == 1
    following[single[alone]] = after[alone]
    return following


@numba.njit(cache=True, nogil=True)
def _follow(following: NDArray, first: NDArray, last: NDArray, length: NDArray) -> int:
    """Walk every segment from its first node, then the loops; return how many there are."""
    done = np.zeros(first.shape[0], dtype=np.bool_)
    count = 0
    for loops in (False, True):
        for start in range(first.shape[0]):
            if done[start] or not (first[start] or loops):
                continue
            node, length[count] = start, 1
            done[start] = True
            while following[node] >= 0 and not done[following[node]]:
                node = following[node]
                done[node] = True
                length[count] += 1
            last[count] = node
            count += 1
    return count


def _reentry_ticks(back_start: NDArray, source: NDArray, inside: NDArray, ticks: NDArray) -> NDArray[np.int32]:
    """Ticks from each node to the next entry into a kind from outside it, UNREACHED where there is none.  # (N,)

    Args:
        back_start: edges turned round, as ``reversed_edges`` gives them.  # (N + 1,)
        source: the nodes that lead to each node.  # (E,)
        inside: which nodes are of the kind.  # (N,)
        ticks: from each node to the nearest node of the kind.  # (N,)
    """
    again = np.where(inside, UNREACHED, ticks).astype(np.int32)
    outside = np.flatnonzero(again >= 0)
    outside = outside[np.argsort(again[outside], kind="stable")].astype(np.int32)
    _spread_inwards(back_start, source, inside, outside, again)
    return again


@numba.njit(cache=True, nogil=True)
def _spread_inwards(back_start: NDArray, source: NDArray, inside: NDArray, outside: NDArray, again: NDArray) -> None:
    """Fill ``again`` inside the kind from the nodes outside, which come by rising ticks, one tick an edge."""
    queue = np.empty(inside.shape[0], dtype=np.int32)
    waiting, done, taken = 0, 0, 0
    while taken < outside.shape[0] or done < waiting:
        nearer = done == waiting or (taken < outside.shape[0] and again[outside[taken]] <= again[queue[done]])
        if nearer:
            node = outside[taken]
            taken += 1
        else:
            node = queue[done]
            done += 1
        for before in source[back_start[node] : back_start[node + 1]]:
            if inside[before] and again[before] < 0:
                again[before] = again[node] + 1
                queue[waiting] = before
                waiting += 1
