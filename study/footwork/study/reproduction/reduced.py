"""Well-connected graphs after node reduction, each reduced once in a run."""

import numpy as np

from footwork.motion.graph import MotionGraph
from footwork.study.reproduction.flat_graph import FlatGraph
from footwork.study.reproduction.graphs import SIGMA, Graphs, connected_part
from footwork.study.reproduction.workbench import BUILT_AT, Workbench
from footwork.training.chain_graph import graph_of_chains
from footwork.training.graph_options import GraphOptions
from footwork.training.reduction import Reduction
from footwork.training.well_connected_recipe import reduction_of as kept_of

MU = 5.0  # suboptimality scalar of the graphs that are played


def reduction_of(graphs: Graphs, mu: float) -> Reduction:
    """What of a well-connected graph at BUILT_AT is kept at a suboptimality scalar, as a stage of ``graphs``."""
    edges = graphs.edges(BUILT_AT)
    with graphs.stages(f"reduction at {mu:g}") as tell:
        return kept_of(graphs.chains, edges, GraphOptions(graph="well-connected", mu=mu), SIGMA, tell)


def reduction(bench: Workbench, name: str, mu: float) -> Reduction:
    """That of a set's core ranges."""
    return bench.once(("reduction", name, mu), lambda: reduction_of(bench.graphs(name), mu))


def reduced_graph(bench: Workbench, name: str, mu: float) -> FlatGraph:
    """A set's well-connected graph after reduction, flat."""
    kept, graphs = reduction(bench, name, mu), bench.graphs(name)
    chains, edges = graphs.chains, graphs.edges(BUILT_AT).some(kept.edges)
    source = np.searchsorted(kept.nodes, edges.source)
    return FlatGraph(
        edge_start=np.searchsorted(source, np.arange(len(kept.nodes) + 1)),
        target=np.searchsorted(kept.nodes, edges.target).astype(np.int32),
        kind=chains.label[kept.nodes],
        kinds=chains.labels,
        frames=np.arange(chains.original_count, dtype=np.int32),
        captured=chains.original_count,
    )


def well_connected_motion_graph(bench: Workbench, name: str) -> MotionGraph:
    """The largest connected part of a set's well-connected graph, reduced at MU, with poses."""

    def make() -> MotionGraph:
        kept, graphs = reduction(bench, name, MU), bench.graphs(name)
        edges = graphs.edges(BUILT_AT).some(kept.edges)
        return connected_part(graph_of_chains(graphs.clips, graphs.chains, kept.nodes, edges, SIGMA))

    return bench.once(("motion graph", name), make)
