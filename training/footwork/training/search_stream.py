"""Searches of a stream, one after the other, each of which learns from the one before it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.training.best_paths import BEGUN, forget, no_paths, search, spread, take
from footwork.training.bucket_queue import bucket_queue
from footwork.training.budgets import bound, tighten
from footwork.training.kept_edges import KeptEdges
from footwork.training.path_cost import UNIT
from footwork.training.raised_budgets import allow, join, no_raising

# a search that leaves more of the graph than this has budgets so loose that bounding all anew costs less
_LOOSE = 1 / 16


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
        self._bounding, self._worth = bucket_queue(count, self._dearest), np.empty_like(self._paths.label)
        self._raising, self._own = no_raising(count), np.empty(0, dtype=np.int32)
        self._done, self._looked = 0, 0

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
        self._looked = 0
        seeds = self._follow(origin, others) if shift and self._prune else self._forget()
        paths = self._paths
        # where nothing is followed labels count from the origin
        paths.label[origin], paths.parent[origin] = -shift if self._prune else 0, origin
        left, turn = self._search(np.unique(np.append(seeds, np.int32(origin))))
        if max(shift, (turn + 1) * UNIT + self._dearest) >= paths.unknown[0]:
            raise OverflowError
        found = self._take(origin)
        if self._prune:
            self._looked += tighten(self._edges, paths, left)
        self._done, self._own = self._done + 1, found.new
        return found._replace(looked=self._looked)

    def _forget(self) -> NDArray[np.int32]:
        forget(self._paths, self._useful)
        return np.empty(0, dtype=np.int32)

    def _follow(self, origin: int, others: list[NDArray[np.int32]]) -> NDArray[np.int32]:
        """Take up what has been kept since the last search: the nodes whose edges may lower labels."""
        paths, edges = self._paths, self._edges
        paths.parent[self._sources[self._done - 1][0]] = origin
        seeds = [self._own, *others]
        self._looked += sum(join(nodes, edges, paths) for nodes in seeds)
        for nodes in others:
            raised, looked = allow(nodes, edges, paths, self._raising)
            seeds.append(self._raising.nodes[:raised].copy())
            self._looked += looked
        found = np.concatenate(seeds)
        return found[paths.label[found] < paths.unknown]

    def _search(self, seeds: NDArray[np.int32]) -> tuple[int, int]:
        """Lower labels from seeds on; how many nodes were left, and the last bucket."""
        paths, edges = self._paths, self._edges
        own = edges.kept[seeds] == 1
        first, due = _by(paths.label, seeds[own])
        among_kept = spread(first, due, edges, paths, self._queue)
        self._looked += among_kept.looked
        leaving = np.union1d(paths.left[: among_kept.left], seeds[~own])
        leaving, due = _by(paths.label, leaving[paths.label[leaving] <= paths.budget[leaving]])
        if not len(leaving):
            return 0, among_kept.turn
        loose = int(_LOOSE * len(paths.label)) + 1 if self._prune else len(paths.label)
        done = search(leaving, due, edges, paths, self._queue, BEGUN, loose)
        if self._prune and done.left == loose:
            kept, worth = _by(-paths.label, np.flatnonzero(edges.kept).astype(np.int32))
            self._looked += bound(kept, worth, edges, paths, self._bounding, self._worth)
            done = search(leaving, due, edges, paths, self._queue, done, len(paths.label))
        self._looked += done.looked
        return done.left, max(among_kept.turn, done.turn)

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


def _by(label: NDArray, nodes: NDArray[np.int32]) -> tuple[NDArray[np.int32], NDArray]:
    """Nodes by label, and their labels."""
    due = label[nodes]
    order = np.argsort(due, kind="stable")
    return nodes[order], due[order]
