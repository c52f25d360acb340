"""How many bytes a motion graph of so many nodes and edges takes."""

from dataclasses import dataclass

from footwork.motion.graph import EDGE_ARRAYS, NODE_ARRAYS, MotionGraph

MEGABYTE = 1e6


@dataclass(frozen=True)
class BytesEach:
    """Bytes of one node and of one edge, with everything that is stored for them."""

    node: float
    edge: float

    def megabytes(self, nodes: int, edges: int) -> float:
        """Size of a graph of so many, 10^6 bytes."""
        return (self.node * nodes + self.edge * edges) / MEGABYTE


def bytes_each(graph: MotionGraph) -> BytesEach:
    """Those of any graph on the same body."""
    nodes = sum(getattr(graph, name).nbytes for name in (*NODE_ARRAYS, "edge_start"))
    edges = sum(getattr(graph, name).nbytes for name in EDGE_ARRAYS)
    return BytesEach(nodes / graph.node_count, edges / graph.edge_count)
