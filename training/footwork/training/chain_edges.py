"""Edges between the nodes of chains: natural ones, transitions, and joins from one interpolated segment to the next."""

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion.arrays import frozen
from footwork.motion.metric import UNIT, align_windows
from footwork.motion.window import RADIUS
from footwork.training.chains import NO_CHAIN, Chains
from footwork.training.transitions import Minima

_WINDOWS_AT_ONCE = 4096


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


def edges_of_chains(
    chains: Chains, minima: Minima, threshold: float, joint_weights: ArrayLike | None = None
) -> ChainEdges:
    """All edges over the nodes of chains (conventions.md 2).

    Natural edges lead to the next frame of a chain. A minimum (i, j) gives i -> j + 1 and j -> i + 1 where those are
    frames of the chains. A join leads from the last frame of an interpolated segment to the first of the segment of
    both next sources at the same weight, where s is under the threshold.

    Args:
        chains: the nodes.
        minima: their transitions.
        threshold: joins cost less than this s.
        joint_weights: of the metric, as in ``PointCloudMetric``.  # (J,)
    """
    goes_on = np.ones(chains.node_count, dtype=bool)
    goes_on[chains.last_node] = False
    natural = np.flatnonzero(goes_on)
    there, back = goes_on[minima.j], goes_on[minima.i]
    join_source, join_target, join_cost = _joins(chains, threshold, joint_weights)
    source = np.concatenate([natural, minima.i[there], minima.j[back], join_source], dtype=np.int32)
    target = np.concatenate([natural + 1, minima.j[there] + 1, minima.i[back] + 1, join_target], dtype=np.int32)
    cost = np.concatenate([np.zeros(len(natural)), minima.cost[there], minima.cost[back], join_cost])
    order = _sorted_order(source, target, len(natural), chains.node_count)
    return ChainEdges(source[order], target[order], cost[order], order < len(natural))


def row_windows(chains: Chains, rows: NDArray[np.intp]) -> NDArray[np.float64]:
    """World places of the windows of chosen rows, held at the ends of their chains, metres.  # (n, LENGTH, J, 3)"""
    chain = np.searchsorted(chains.first_row, rows, side="right") - 1
    first = chains.first_row[chain]
    last = first + (chains.length + 2 * chains.context)[chain] - 1
    around = rows[:, None] + np.arange(-RADIUS, RADIUS + 1)
    return chains.places[np.clip(around, first[:, None], last[:, None])]


def _joins(
    chains: Chains, threshold: float, joint_weights: ArrayLike | None
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
    """Source, target and cost of the joins under the threshold."""
    chain = np.flatnonzero(chains.followers != NO_CHAIN)
    source, target = chains.last_node[chain], chains.first_node[chains.followers[chain]]
    here, there = chains.row_of_node[source], chains.row_of_node[target] - 1
    cost = np.empty(len(chain))
    for begun in range(0, len(chain), _WINDOWS_AT_ONCE):
        part = slice(begun, begun + _WINDOWS_AT_ONCE)
        windows = row_windows(chains, here[part]), row_windows(chains, there[part])
        cost[part] = align_windows(*windows, joint_weights).square / UNIT**2
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
        part = order[begin : start[node + 1]]
        order[begin : start[node + 1]] = part[np.argsort(target[part])]
