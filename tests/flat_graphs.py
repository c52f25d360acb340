"""Graphs as flat arrays, without poses, for tests of what runs on edges alone; and slow ways to measure them."""

import numpy as np
from numpy.typing import NDArray


def csr(nodes: int, source, target) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Edges in CSR form."""
    source, target = np.asarray(source, dtype=np.int64), np.asarray(target, dtype=np.int64)
    order = np.lexsort((target, source))
    start = np.searchsorted(source[order], np.arange(nodes + 1))
    return start.astype(np.int32), target[order].astype(np.int32)


def random_graph(seed: int, nodes: int, edges: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Random edges, parallel ones and loops among them."""
    return csr(nodes, *np.random.default_rng(seed).integers(0, nodes, (2, edges)))


def ring(nodes: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """One loop."""
    return csr(nodes, np.arange(nodes), (np.arange(nodes) + 1) % nodes)


def line(nodes: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """One chain from the first node to the last."""
    return csr(nodes, np.arange(nodes - 1), np.arange(1, nodes))


def sources_of(edge_start: NDArray) -> NDArray[np.intp]:
    """The node each edge leaves."""
    return np.repeat(np.arange(len(edge_start) - 1), np.diff(edge_start))


def distances(edge_start: NDArray, target: NDArray, cost=1.0) -> NDArray[np.float64]:
    """Lengths of the shortest ways between all nodes, infinite where there is none (Floyd and Warshall)."""
    nodes = len(edge_start) - 1
    table = np.full((nodes, nodes), np.inf)
    np.fill_diagonal(table, 0.0)
    np.minimum.at(table, (sources_of(edge_start), target), cost)
    np.fill_diagonal(table, 0.0)
    for middle in range(nodes):
        table = np.minimum(table, table[:, [middle]] + table[[middle]])
    return table
