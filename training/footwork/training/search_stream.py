"""Searches of a stream, one after the other, each of which learns from the one before it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.training.best_paths import forget, no_paths, search, take, tighten
from footwork.training.bucket_queue import bucket_queue
from footwork.training.kept_edges import KeptEdges
from footwork.training.path_cost import UNIT
from footwork.training.raised_budgets import allow


class Found(NamedTuple):
    """What a search found.

    Args:
        new: nodes on its paths that were not kept, each behind the ones before it on its path.  # (K,)
        source: the sources of edges on its paths, but for edges that the stream has named before.  # (L,)
        target: their targets.  # (L,)
        looked: how many edges were looked at.
    """

    new: NDArray[np.int32]
    source: NDArray[np.int32]
    target: NDArray[np.int32]
    looked: int


class SearchStream:
    """Searches from originals run by run; what is kept changes between them only.

    Args:
        runs: the originals of each clip, from its last frame to its first.
        originals: the nodes 0 .. originals - 1 are the original frames.
        edges: the graph, shared by all streams.
        useful: the nodes that paths may pass.  # (N,)
        prune: pass over what cannot be on a best path.
    """

    def __init__(
        self,
        runs: list[NDArray[np.intp]],
        originals: int,
        edges: KeptEdges,
        useful: NDArray[np.bool_],
        prune: bool,
    ) -> None:
        count, self._dearest = len(edges.kept), int(edges.far[-1])
        self._sources = [(int(origin), place * UNIT) for run in runs for place, origin in enumerate(run)]
        self._originals, self._edges, self._useful, self._prune = originals, edges, useful, prune
        self._paths = no_paths(count, edges.far.dtype.type)
        self._queue = bucket_queue(count, self._dearest)
        self._seen, self._before, self._changed, self._new = (np.full(count, -1, dtype=np.int32) for _ in range(4))
        self._waiting, self._stands = np.empty(count + 1, dtype=np.int32), np.zeros(count, dtype=np.uint8)
        self._done, self._touched = 0, 0

    @property
    def left(self) -> int:
        """How many searches are still to be done."""
        return len(self._sources) - self._done

    def search(self, others: list[NDArray[np.int32]]) -> Found:
        """Do the next search, on what is kept by now.

        Args:
            others: what each other stream found new since the last one.

        Raises:
            OverflowError: where costs of paths may grow too large for their type.
        """
        origin, shift = self._sources[self._done]
        looked = self._follow(others) if shift else 0
        self._forget(shift)
        paths, edges = self._paths, self._edges
        self._touched, left, buckets, more = search(origin, edges, paths, self._queue, shift)
        if (buckets + 1) * UNIT + self._dearest >= paths.unknown[0]:
            raise OverflowError
        found = self._take(origin)
        looked += more + (tighten(edges, paths, left, shift) if self._prune else 0)
        self._done += 1
        return found._replace(looked=looked)

    def _follow(self, others: list[NDArray[np.int32]]) -> int:
        shift, looked = self._sources[self._done - 1][1], 0
        for nodes in others:
            looked += allow(nodes, self._edges, self._paths, shift, self._waiting, self._stands)
            self._paths.label[nodes] = self._paths.unknown
        return looked

    def _forget(self, shift: int) -> None:
        self._paths.label[self._paths.touched[: self._touched]] = self._paths.unknown
        if not shift:
            forget(self._paths, self._useful)

    def _take(self, origin: int) -> Found:
        changes, count = take(
            origin,
            self._originals,
            self._edges.kept,
            self._paths,
            self._seen,
            self._before,
            self._changed,
            self._new,
        )
        new, changed = self._new[:count], self._changed[:changes].copy()
        # every edge costs something, so that labels rise along paths
        return Found(new[np.argsort(self._paths.label[new], kind="stable")], self._before[changed], changed, 0)
