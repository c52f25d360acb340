"""Keep of a graph with interpolated motion what the best paths between original frames need (conventions.md 4).

After Zhao and Safonova (2008): at first the original frames are kept; for a few of them at a time the best paths to
all others are found and then their nodes and edges kept. An edge costs its path cost where both its ends are kept and
mu times as much elsewhere, so that paths prefer what is kept already: the larger mu, the smaller the graph.

Costs are at most mu times the best: let P be the path chosen from a to b and Q the best one by path cost alone. An
edge's cost c during the search lies between its path cost and mu times that, so cost(P) <= c(P) <= c(Q) <= mu cost(Q).
All nodes and edges of P are kept. At mu = 1 the costs are those of the whole graph.
"""

import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen
from footwork.training.chosen_edges import ChosenEdges
from footwork.training.edge_order import order_by, starts
from footwork.training.graph_options import ORDERS
from footwork.training.kept_edges import keep, kept_edges
from footwork.training.path_cost import UNIT
from footwork.training.reachability import between_originals
from footwork.training.search_stream import Found, SearchStream
from footwork.training.source_order import dealt, runs_of_originals

STREAMS = 2
MOST = 1e4  # larger mu count as this: no detour over kept nodes is as long
DEAREST = np.iinfo(np.uint16).max
Tell = Callable[[float], None]


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
    streams: int = STREAMS,
    prune: bool = True,
    progress: Tell | None = None,
) -> Reduction:
    """The nodes and edges on the best paths between original frames.

    Clips (runs of originals that natural edges join) are dealt to a few streams of searches. Each stream takes its
    clips one after the other, each from its last frame to its first, because a search learns much from that of the
    frame behind it. The streams go on in rounds, side by side: each searches from one frame on what was kept before
    the round. So the result depends on the order of clips and the number of streams, and on nothing else.
    Natural edges between originals are best paths and so always kept.

    Args:
        count: the number of nodes N.
        originals: the nodes 0 .. originals - 1 are the original frames.
        source: the node each edge leaves; memory is saved where it ascends.  # (E,)
        target: the node it leads to.  # (E,)
        base: its path cost in 1 / UNIT frames, UNIT to DEAREST; natural edges have UNIT.  # (E,)
        mu: how much dearer edges outside of what is kept are, at least 1; above MOST as MOST.
        order: of the clips: "frames" as they come, "reverse" from the last to the first, "random" by ``seed``.
        seed: for the random order.
        streams: how many searches each round has, at least 1.
        prune: pass over what cannot be on a best path; the result is the same without.
        progress: told the share of the sources done after each round.

    Raises:
        InputError: for mu under 1 or not a number, another order, or edges of other costs or nodes.
    """
    started = time.perf_counter()
    _check(count, originals, source, target, base, mu, order)
    sorting = order_by(source)
    target_of, base_of, start = target[sorting], base[sorting], starts(count, source)
    dealing = dealt(runs_of_originals(originals, start, target_of, base_of, order, seed), streams)
    walk = _Walk(originals, start, target_of, base_of, min(mu, MOST), prune)
    try:
        kept, links = walk.run(dealing, np.int32, progress)
    except OverflowError:
        kept, links = walk.run(dealing, np.int64, progress)
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


class _Walk:
    """The searches from all originals, in rounds of one of each stream."""

    def __init__(self, originals: int, start: NDArray, target: NDArray, base: NDArray, mu: float, prune: bool) -> None:
        self._graph = originals, start, target, base
        self._mu, self._prune = mu, prune
        self.passable = len(start) - 1
        self.looked = 0

    def run(
        self, streams: list[list[NDArray[np.intp]]], kind: type[np.signedinteger], progress: Tell | None
    ) -> tuple[NDArray[np.intp], ChosenEdges]:
        """The kept nodes, ascending, and the edges on the paths, with costs of a type.

        Raises:
            OverflowError: where costs of paths may grow too large for that type.
        """
        originals, start, target, base = self._graph
        far = np.floor(self._mu * np.arange(base.max(initial=UNIT) + 1)).astype(kind)
        edges, links, done = kept_edges(start, target, base, far), ChosenEdges(), 0
        useful = between_originals(originals, edges) if self._prune else np.ones(len(start) - 1, dtype=bool)
        self.passable, self.looked = int(useful.sum()), 0
        keep(edges, np.arange(originals, dtype=np.int32))
        searches = [SearchStream(runs, originals, edges, useful, self._prune) for runs in streams]
        for round_ in _rounds(searches):
            for found in round_:
                keep(edges, found.new[edges.kept[found.new] == 0])
                links.add(found.source, found.target)
                self.looked += found.looked
            done += len(round_)
            if progress is not None:
                progress(done / originals)
        return np.flatnonzero(edges.kept), links


def _rounds(streams: list[SearchStream]) -> Iterator[list[Found]]:
    """What one search of each stream that has any left found, again and again; the streams go on side by side."""
    nothing: list[NDArray[np.int32]] = []
    with ThreadPoolExecutor(len(streams)) as threads:
        going = [(stream, nothing) for stream in streams if stream.left]
        while going:
            found = list(threads.map(lambda turn: turn[0].search(turn[1]), going))
            yield found
            new = [one.new for one in found]
            going = [(stream, new[:k] + new[k + 1 :]) for k, (stream, _) in enumerate(going) if stream.left]
