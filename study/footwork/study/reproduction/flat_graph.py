"""A motion graph as far as measures need it: edges in CSR form and what each node shows, without poses."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.study.closure import parts_of
from footwork.training.nodes import Nodes
from footwork.training.standard_graph import edges_of
from footwork.training.transitions import Minima


@dataclass(frozen=True, eq=False)
class FlatGraph:
    """N nodes, of which some are captured frames, and E edges that all last one tick.

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        kind: label of each node, an index into ``kinds``.  # (N,)
        kinds: the labels.
        frames: the nodes that are captured frames, ascending.  # (F,)
        captured: how many frames were captured, whether they are in the graph or not.
    """

    edge_start: NDArray[np.int64]
    target: NDArray[np.int32]
    kind: NDArray[np.int16]
    kinds: tuple[str, ...]
    frames: NDArray[np.int32]
    captured: int

    @property
    def node_count(self) -> int:
        """The number of nodes N."""
        return len(self.kind)

    @property
    def edge_count(self) -> int:
        """The number of edges E."""
        return len(self.target)

    @property
    def source(self) -> NDArray[np.int32]:
        """The node each edge leaves.  # (E,)"""
        return np.repeat(np.arange(self.node_count, dtype=np.int32), np.diff(self.edge_start))

    def connected(self) -> "FlatGraph":
        """Its largest strongly connected part."""
        part = parts_of(self.edge_start, self.target)
        nodes = np.flatnonzero(part == np.argmax(np.bincount(part)))
        number = np.full(self.node_count, -1, dtype=np.int32)
        number[nodes] = np.arange(len(nodes), dtype=np.int32)
        kept = (number[self.source] >= 0) & (number[self.target] >= 0)
        counts = np.bincount(number[self.source[kept]], minlength=len(nodes))
        frames = number[self.frames]
        return FlatGraph(
            edge_start=np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
            target=number[self.target[kept]],
            kind=self.kind[nodes],
            kinds=self.kinds,
            frames=frames[frames >= 0],
            captured=self.captured,
        )

    @property
    def captured_share(self) -> float:
        """Share of all captured frames that are in the graph."""
        return len(self.frames) / self.captured


def standard_flat_graph(nodes: Nodes, minima: Minima) -> FlatGraph:
    """The standard motion graph over all captured frames with transitions at some minima."""
    edges, count = edges_of(nodes.ends, minima), len(nodes.ends)
    return FlatGraph(
        edge_start=np.searchsorted(edges.source, np.arange(count + 1)),
        target=edges.target.astype(np.int32),
        kind=nodes.arrays["label"],
        kinds=nodes.labels,
        frames=np.arange(count, dtype=np.int32),
        captured=count,
    )
