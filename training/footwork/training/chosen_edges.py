"""The edges on the paths chosen so far, gathered search by search."""

import numba
import numpy as np
from numpy.typing import NDArray

_MOST = 1 << 22  # pairs gathered before those that come twice are dropped


class ChosenEdges:
    """Pairs of nodes that paths pass one after the other."""

    def __init__(self) -> None:
        self._pairs: list[NDArray[np.int64]] = []
        self._waiting = 0

    def add(self, source: NDArray[np.int32], target: NDArray[np.int32]) -> None:
        """More pairs, some of which may be there already.  # (M,), (M,)"""
        self._pairs.append(source.astype(np.int64) << 32 | target)
        self._waiting += len(source)
        if self._waiting > _MOST:
            self._pairs, self._waiting = [np.unique(np.concatenate(self._pairs))], 0

    def edges(self, start: NDArray, target: NDArray, base: NDArray) -> NDArray[np.intp]:
        """The edges of the pairs, ascending; of edges between the same nodes the cheapest, the first of equals.

        Args:
            start: where the edges of each node start.  # (N + 1,)
            target: the node each edge leads to.  # (E,)
            base: what it costs.  # (E,)
        """
        pairs = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *self._pairs]))
        return np.sort(_cheapest(pairs >> 32, pairs & 0xFFFFFFFF, start, target, base))


@numba.njit(cache=True, nogil=True)
def _cheapest(sources: NDArray, targets: NDArray, start: NDArray, target: NDArray, base: NDArray) -> NDArray[np.intp]:
    edges = np.empty(len(sources), dtype=np.intp)
    for k in range(len(sources)):
        best = -1
        for at in range(start[sources[k]], start[sources[k] + 1]):
            if target[at] == targets[k] and (best < 0 or base[at] < base[best]):
                best = at
        edges[k] = best
    return edges
