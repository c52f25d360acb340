"""Keep of a graph with interpolated motion what the best paths between original frames need (conventions.md 4).

After Zhao and Safonova (2008): at first the original frames are kept; for each of them in turn the best paths to all
others are found and their nodes and edges kept. An edge costs its path cost where both its ends are kept and mu times
as much elsewhere, so that paths prefer what is kept already: the larger mu, the smaller the graph.

Costs are at most mu times the best: let P be the path chosen from a to b and Q the best one by path cost alone. An
edge's cost c during the search lies between its path cost and mu times that, so cost(P) <= c(P) <= c(Q) <= mu cost(Q).
All nodes and edges of P are kept. At mu = 1 the costs are those of the whole graph.
"""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen
from footwork.training.best_paths import forget, no_paths, search, take, tighten
from footwork.training.bucket_queue import bucket_queue
from footwork.training.chosen_edges import ChosenEdges
from footwork.training.edge_order import order_by, starts
from footwork.training.kept_edges import KeptEdges, keep, kept_edges
from footwork.training.path_cost import UNIT
from footwork.training.reachability import between_originals

ORDERS = ("frames", "reverse", "random")
MOST = 1e4  # larger mu count as this: no detour over kept nodes is as long
DEAREST = np.iinfo(np.uint16).max


@dataclass(frozen=True, eq=False)
class Reduction:
    """What is kept of a graph.

    Args:
        nodes: the kept nodes, ascending; the originals come first.  # (K,)
        edges: the kept edges, ascending.  # (L,)
        mu: the largest ratio of a kept path's cost to the best.
        passable: how many nodes lie on some path between originals.
        looked: how many edges were looked at.
        seconds: how long it took.
    """

    nodes: NDArray[np.intp]
    edges: NDArray[np.intp]
    mu: float
    passable: int
    looked: int
    seconds: float


def reduced(
    count: int,
    originals: int,
    source: NDArray[np.int32],
    target: NDArray[np.int32],
    base: NDArray[np.int32],
    mu: float,
    *,
    order: str = "frames",
    seed: int = 0,
    prune: bool = True,
    progress: Callable[[float], None] | None = None,
) -> Reduction:
    """The nodes and edges on the best paths between original frames.

    The result depends on the order in which sources are taken, and on nothing else. Clips (runs of originals that
    natural edges join) are taken one after the other, each from its last frame to its first, because a search
    learns much from that of the frame behind it. Natural edges between originals are best paths and so always kept.

    Args:
        count: the number of nodes N.
        originals: the nodes 0 .. originals - 1 are the original frames.
        source: the node each edge leaves; memory is saved where it ascends.  # (E,)
        target: the node it leads to.  # (E,)
        base: its path cost in 1 / UNIT frames, UNIT to DEAREST; natural edges have UNIT.  # (E,)
        mu: how much dearer edges outside of what is kept are, at least 1; above MOST as MOST.
        order: of the clips: "frames" as they come, "reverse" from the last to the first, "random" by ``seed``.
        seed: for the random order.
        prune: pass over what cannot be on a best path; the result is the same without.
        progress: told the share of the sources done after each.

    Raises:
        InputError: for mu under 1 or not a number, another order, or edges of other costs or nodes.
    """
    started = time.perf_counter()
    _check(count, originals, source, target, base, mu, order)
    sorting = order_by(source)
    target_of, base_of, start = target[sorting], base[sorting], starts(count, source)
    runs = _runs(originals, start, target_of, base_of, order, seed)
    walk = _Walk(originals, start, target_of, base_of, min(mu, MOST), prune)
    try:
        kept, links = walk.run(runs, np.int32, progress)
    except OverflowError:
        kept, links = walk.run(runs, np.int64, progress)
    edges = links.edges(start, target_of, base_of)
    edges = edges if isinstance(sorting, slice) else np.sort(sorting[edges])
    seconds = time.perf_counter() - started
    return Reduction(frozen(kept, np.intp), frozen(edges, np.intp), mu, walk.passable, walk.looked, seconds)


def _check(count: int, originals: int, source: NDArray, target: NDArray, base: NDArray, mu: float, order: str) -> None:
    if not mu >= 1.0:
        raise InputError(f"{mu:g}, expected at least 1", "mu")
    if order not in ORDERS:
        raise InputError(f"{order!r}, expected one of {', '.join(ORDERS)}", "order")
    if not 0 <= originals <= count:
        raise InputError(f"{originals} originals among {count} nodes", "graph")
    if not len(base):
        return
    if min(source.min(), target.min()) < 0 or max(source.max(), target.max()) >= count:
        raise InputError(f"edges of nodes that are not there, expected 0 to {count - 1}", "graph")
    if base.min() < UNIT or base.max() > DEAREST:
        raise InputError(f"edges cost {base.min()} to {base.max()}, expected {UNIT} to {DEAREST}", "graph")


def _runs(
    originals: int, start: NDArray, target: NDArray, base: NDArray, order: str, seed: int
) -> list[NDArray[np.intp]]:
    """The originals clip by clip, each clip from its last frame to its first."""
    leaving = slice(0, start[originals])
    source = np.repeat(np.arange(originals), np.diff(start[: originals + 1]))
    natural = (target[leaving] == source + 1) & (source + 1 < originals) & (base[leaving] == UNIT)
    last = np.ones(originals, dtype=bool)
    last[source[natural]] = False
    runs = [run[::-1] for run in np.split(np.arange(originals), np.flatnonzero(last)[:-1] + 1)]
    if order == "reverse":
        return runs[::-1]
    if order == "random":
        return [runs[k] for k in np.random.default_rng(seed).permutation(len(runs))]
    return runs


class _Walk:
    """The searches from all originals, one after the other."""

    def __init__(self, originals: int, start: NDArray, target: NDArray, base: NDArray, mu: float, prune: bool) -> None:
        self._graph = originals, start, target, base
        self._mu, self._prune = mu, prune
        self.passable = len(start) - 1
        self.looked = 0

    def run(
        self, runs: list[NDArray[np.intp]], kind: type[np.signedinteger], progress: Callable[[float], None] | None
    ) -> tuple[NDArray[np.intp], ChosenEdges]:
        """The kept nodes, ascending, and the edges on the paths, with costs of a type.

        Raises:
            OverflowError: where costs of paths may grow too large for that type.
        """
        originals, start, target, base = self._graph
        far = np.floor(self._mu * np.arange(base.max(initial=UNIT) + 1)).astype(kind)
        edges, links = kept_edges(start, target, base, far), ChosenEdges()
        useful = between_originals(originals, edges) if self._prune else np.ones(len(start) - 1, dtype=bool)
        self.passable, self.looked = int(useful.sum()), 0
        keep(edges, np.arange(originals, dtype=np.int32))
        for done, looked in enumerate(self._searches(edges, runs, links, useful), start=1):
            self.looked += looked
            if progress is not None:
                progress(done / originals)
        return np.flatnonzero(edges.kept), links

    def _searches(
        self, edges: KeptEdges, runs: list[NDArray[np.intp]], links: ChosenEdges, useful: NDArray[np.bool_]
    ) -> Iterator[int]:
        """Search from each original of each run and keep what its paths need; how many edges each looked at."""
        originals, count, dearest = self._graph[0], len(edges.kept), int(edges.far[-1])
        paths, queue = no_paths(count, edges.far.dtype.type), bucket_queue(count, dearest)
        seen, before, changed, new = (np.full(count, -1, dtype=np.int32) for _ in range(4))
        for run in runs:
            forget(paths, useful)
            for place, origin in enumerate(run):
                shift = place * UNIT
                touched, left, buckets, looked = search(origin, edges, paths, queue, shift)
                if (buckets + 1) * UNIT + dearest >= paths.unknown[0]:
                    raise OverflowError
                changes, more = take(origin, originals, edges.kept, paths, seen, before, changed, new)
                links.add(before[changed[:changes]], changed[:changes])
                keep(edges, new[:more])
                looked += tighten(edges, paths, left, shift) if self._prune else 0
                paths.label[paths.touched[:touched]] = paths.unknown
                yield looked
