"""The edges that searches walk over, a node's edges to kept nodes first."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.edge_order import starts


class KeptEdges(NamedTuple):
    """Edges by source, in which each node's edges to kept nodes lie before the others; E edges, N nodes.

    An edge costs ``base`` where both its ends are kept and ``far[base]`` otherwise; T is an integer type that all
    costs of paths fit.

    Args:
        kept: which nodes are kept, 0 or 1.  # (N,)
        start: where the edges of each node start.  # (N + 1,)
        middle: where those to nodes that are not kept start.  # (N,)
        target: the node each edge leads to.  # (E,)
        base: its cost between kept nodes.  # (E,)
        far: by ``base``, what an edge costs elsewhere.  # (dearest base + 1,) T
        into: where the edges into each node start in ``source``.  # (N + 1,)
        source: the node that each edge leaves, by target.  # (E,)
        cost: its ``base``, by target.  # (E,)
    """

    kept: NDArray[np.uint8]
    start: NDArray[np.int32]
    middle: NDArray[np.int32]
    target: NDArray[np.int32]
    base: NDArray[np.uint16]
    far: NDArray
    into: NDArray[np.int32]
    source: NDArray[np.int32]
    cost: NDArray[np.uint16]


def kept_edges(start: NDArray, target: NDArray, base: NDArray, far: NDArray) -> KeptEdges:
    """Edges of a graph of which no node is kept yet.

    Args:
        start: where the edges of each node start.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        base: its cost between kept nodes.  # (E,)
        far: by ``base``, its cost elsewhere.  # (dearest base + 1,) T
    """
    count = len(start) - 1
    into, base = starts(count, target), base.astype(np.uint16)
    source, cost = _backwards(start, target, base, into)
    return KeptEdges(
        kept=np.zeros(count, dtype=np.uint8),
        start=start,
        middle=start[:-1].copy(),
        target=target.astype(np.int32),
        base=base,
        far=far,
        into=into,
        source=source,
        cost=cost,
    )


@numba.njit(cache=True, nogil=True)
def _backwards(
    start: NDArray, target: NDArray, base: NDArray, into: NDArray
) -> tuple[NDArray[np.int32], NDArray[np.uint16]]:
    """The source and the cost of each edge, by target."""
    place, source, cost = into.copy(), np.empty(len(target), dtype=np.int32), np.empty(len(target), dtype=np.uint16)
    for node in range(len(start) - 1):
        for at in range(start[node], start[node + 1]):
            there = place[target[at]]
            source[there], cost[there] = node, base[at]
            place[target[at]] += 1
    return source, cost


@numba.njit(cache=True, nogil=True)
def keep(edges: KeptEdges, nodes: NDArray) -> None:
    """Keep some nodes, none of them kept before."""
    for node in nodes:
        edges.kept[node] = 1
        for entering in range(edges.into[node], edges.into[node + 1]):
            _move(edges, edges.source[entering], node)


@numba.njit(cache=True, nogil=True)
def _move(edges: KeptEdges, source: int, node: int) -> None:
    """Move an edge from a node to one kept since to the front of those that led to others."""
    target, base = edges.target, edges.base
    front = edges.middle[source]
    at = front
    while target[at] != node:
        at += 1
    target[front], target[at] = target[at], target[front]
    base[front], base[at] = base[at], base[front]
    edges.middle[source] = front + 1
