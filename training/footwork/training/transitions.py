"""Where one motion may be left for another: frames less unlike than a threshold, at local minima of the metric."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.threads import THREADS

MIN_GAP = 15  # frames: two frames of one clip nearer than 0.5 s are no transition (conventions.md 2)


@dataclass(frozen=True, eq=False)
class Minima:
    """Pairs of frames i < j that are local minima of the metric, sorted by i, then j.

    Args:
        i: the earlier frame of each pair.  # (M,)
        j: the later frame.  # (M,)
        cost: s of the pair.  # (M,)
    """

    i: NDArray[np.intp]
    j: NDArray[np.intp]
    cost: NDArray[np.float64]

    def under(self, threshold: float) -> "Minima":
        """Those of a cost under ``threshold``."""
        kept = self.cost < threshold
        return Minima(self.i[kept], self.j[kept], self.cost[kept])


def local_minima(costs: NDArray[np.float64], lengths: Sequence[int], threshold: float = np.inf) -> Minima:
    """Pairs of frames whose cost is under ``threshold`` and no more than that of their neighbours.

    A pair's neighbours are those of the eight pairs around it whose frames lie in the same two clips: a capture
    has no frames past its ends, and its last frame can only be left by a transition. Pairs of two last frames
    lead nowhere and are left out. Of equal neighbours the first in reading order (by i, then j) counts as the
    lower one, so that the result is deterministic and a plateau gives few minima.

    Args:
        costs: s of every pair of frames, symmetric.  # (N, N)
        lengths: frames of each clip; they sum to N.
        threshold: only pairs under it.
    """
    first = np.repeat(np.cumsum(lengths) - lengths, lengths)
    last = np.repeat(np.cumsum(lengths) - 1, lengths)
    rows = [np.arange(thread, len(costs), THREADS) for thread in range(THREADS)]

    def find(part: NDArray) -> NDArray[np.intp]:
        found = np.empty((1024, 2), dtype=np.intp)
        while (count := _find(costs, first, last, part, threshold, MIN_GAP, found)) > len(found):
            found = np.empty((count, 2), dtype=np.intp)
        return found[:count]

    with ThreadPoolExecutor(THREADS) as pool:
        pairs = np.concatenate(list(pool.map(find, rows)))
    i, j = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].T
    return Minima(i, j, costs[i, j])


@numba.njit(cache=True, nogil=True)
def _find(
    costs: NDArray, first: NDArray, last: NDArray, rows: NDArray, threshold: float, gap: int, found: NDArray
) -> int:
    """Write the minima of some rows into ``found`` (as many as fit) and return how many there are."""
    count = 0
    for i in rows:
        for j in range(i + 1, costs.shape[1]):
            if not costs[i, j] < threshold or (first[i] == first[j] and j - i < gap):
                continue
            if (i < last[i] or j < last[j]) and _is_minimum(costs, first, last, i, j):
                if count < found.shape[0]:
                    found[count, 0], found[count, 1] = i, j
                count += 1
    return count


@numba.njit(cache=True, nogil=True)
def _is_minimum(costs: NDArray, first: NDArray, last: NDArray, i: int, j: int) -> bool:
    here = costs[i, j]
    for a in range(max(i - 1, first[i]), min(i + 1, last[i]) + 1):
        for b in range(max(j - 1, first[j]), min(j + 1, last[j]) + 1):
            before = a < i or (a == i and b < j)
            if costs[a, b] < here or (before and costs[a, b] == here):
                return False
    return True
