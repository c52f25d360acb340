"""Edges between the nodes of chains: natural ones, transitions, and joins from one interpolated segment to the next."""

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.arrays import frozen
from footwork.training.chains import NO_CHAIN, Chains
from footwork.training.row_metric import RowMetric, uniform_rows
from footwork.training.transitions import Minima


@dataclass(frozen=True, eq=False)
class ChainEdges:
    """E edges sorted by source; a node's natural edge comes first, then the others by target.

    Args:
        source: the node an edge leaves.  # (E,)
        target: the node it leads to. An edge that is not natural goes on from ``source`` as if that were the row
            before ``target``.  # (E,)
        cost: s of ``source`` and the row before ``target``, 0 for natural edges.  # (E,)
        natural: follows a chain.  # (E,)
    """

    source: NDArray[np.int32]
    target: NDArray[np.int32]
    cost: NDArray[np.float64]
    natural: NDArray[np.bool_]

    def __post_init__(self) -> None:
        for name, kind in (("source", np.int32), ("target", np.int32), ("cost", np.float64), ("natural", np.bool_)):
            object.__setattr__(self, name, frozen(getattr(self, name), kind))

    def some(self, edges: NDArray[np.intp]) -> "ChainEdges":
        """Chosen edges, ascending."""
        return ChainEdges(self.source[edges], self.target[edges], self.cost[edges], self.natural[edges])


def edges_of_chains(chains: Chains, minima: Minima, threshold: float, metric: RowMetric | None = None) -> ChainEdges:
    """All edges over the nodes of chains (conventions.md 2).

    Natural edges lead to the next frame of a chain. A minimum (i, j) gives i -> j + 1 and j -> i + 1 where those are
    frames of the chains. A join leads from the last frame of an interpolated segment to the first of the segment of
    both next sources at the same weight, where s is under the threshold.

    Args:
        chains: the nodes.
        minima: their transitions.
        threshold: joins cost less than this s.
        metric: of these chains, the uniform one where not given.
    """
    goes_on = np.ones(chains.node_count, dtype=bool)
    goes_on[chains.last_node] = False
    natural = np.flatnonzero(goes_on)
    there, back = goes_on[minima.j], goes_on[minima.i]
    join_source, join_target, join_cost = _joins(metric or uniform_rows(chains), threshold)
    source = np.concatenate([natural, minima.i[there], minima.j[back], join_source], dtype=np.int32)
    target = np.concatenate([natural + 1, minima.j[there] + 1, minima.i[back] + 1, join_target], dtype=np.int32)
    cost = np.concatenate([np.zeros(len(natural)), minima.cost[there], minima.cost[back], join_cost])
    order = _sorted_order(source, target, len(natural), chains.node_count)
    return ChainEdges(source[order], target[order], cost[order], order < len(natural))


def _joins(metric: RowMetric, threshold: float) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
    """Source, target and cost of the joins under the threshold."""
    chains = metric.chains
    chain = np.flatnonzero(chains.followers != NO_CHAIN)
    source, target = chains.last_node[chain], chains.first_node[chains.followers[chain]]
    cost = metric.costs(chains.row_of_node[source], chains.row_of_node[target] - 1)
    kept = cost < threshold
    return source[kept], target[kept], cost[kept]


def _sorted_order(source: NDArray, target: NDArray, naturals: int, nodes: int) -> NDArray[np.intp]:
    """Order by source, the first ``naturals`` edges before others, then target."""
    start = np.concatenate([[0], np.cumsum(np.bincount(source, minlength=nodes))])
    order = np.empty(len(source), dtype=np.intp)
    _place(source, target, naturals, start, order)
    return order


@numba.njit(cache=True, nogil=True)
def _place(source: NDArray, target: NDArray, naturals: int, start: NDArray, order: NDArray) -> None:
    """Put each edge among those of its source, then sort these: far quicker than sorting all edges at once."""
    end = start[:-1].copy()
    for edge in range(len(source)):
        order[end[source[edge]]] = edge
        end[source[edge]] += 1
    for node in range(len(end)):
        begin = start[node]
        if begin < start[node + 1] and order[begin] < naturals:
            begin += 1
        part = order[begin : start[node + 1]].copy()
        sorting = np.argsort(target[part])
        for at in range(len(part)):
            order[begin + at] = part[sorting[at]]
