"""The recipe of the well-connected motion graph: interpolation, transitions over all nodes, node reduction.

Source: Zhao and Safonova, Achieving good connectivity in motion graphs (2008); conventions.md 4.
"""

from collections.abc import Callable, Sequence
from typing import Any

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.task import SteeringTask
from footwork.training.bridges import bridged
from footwork.training.chain_edges import ChainEdges, edges_of_chains
from footwork.training.chain_graph import graph_of_chains
from footwork.training.chains import Chains
from footwork.training.connectivity import largest_component, restricted
from footwork.training.graph_options import AUTO_WEIGHTS, GraphOptions
from footwork.training.interpolation import interpolated
from footwork.training.path_cost import path_costs
from footwork.training.recipe import Built
from footwork.training.reduction import Reduction, reduced
from footwork.training.row_metric import row_metric
from footwork.training.stages import Stages
from footwork.training.transition_search import search

Tell = Callable[[float], None]


def build_well_connected(clips: Sequence[Clip], options: GraphOptions, task: SteeringTask, stages: Stages) -> Built:
    """The well-connected motion graph, in the stages "interpolation", "transitions", "reduction", "graph" and,
    where asked for, "bridges".

    Raises:
        InputError: for more data than memory has room for, or where nothing can be walked without end.
    """
    sigma = task.smoothness_sigma
    with stages("interpolation") as tell:
        chains, interpolation = chains_between(clips, options, task, tell)
    with stages("transitions") as tell:
        metric = None if options.metric == "uniform" else row_metric(options.metric, chains)
        minima = search(chains, options.number, metric=metric, progress=tell)
        edges = edges_of_chains(chains, minima, options.number, metric)
        del minima
    with stages("reduction") as tell:
        kept = reduction_of(chains, edges, options, sigma, tell)
        before = {"nodes": chains.node_count, "edges": len(edges.source)}
        edges = edges.some(kept.edges)
    with stages("graph"):
        whole = graph_of_chains(clips, chains, kept.nodes, edges, sigma, metric)
    if options.bridges:
        with stages("bridges") as tell:
            whole = bridged(whole, options.bridges, sigma, tell)
    with stages("graph"):
        part = largest_component(whole.node_count, whole.source, whole.target)
        if not part.size:
            problem = f"nothing can be walked without end at threshold {options.number:g}, expected a greater one"
            raise InputError(problem, "threshold")
        graph = restricted(whole, part)
    measured = {"interpolation": interpolation, "before_reduction": before}
    return Built(graph, chains.original_count, whole.node_count, whole.edge_count, measured)


def chains_between(
    clips: Sequence[Clip], options: GraphOptions, task: SteeringTask, tell: Tell | None = None
) -> tuple[Chains, dict[str, Any]]:
    """The clips and the motions between their segments, with a report."""
    threshold = options.number if options.weights == "auto" else None
    weights = AUTO_WEIGHTS if options.weights == "auto" else options.weights
    return interpolated(clips, task.behaviours, weights, options.pairing, threshold, tell)


def reduction_of(
    chains: Chains, edges: ChainEdges, options: GraphOptions, sigma: float, tell: Tell | None = None
) -> Reduction:
    """The nodes and edges that the best paths between captured frames need."""
    base = path_costs(edges.cost, sigma)
    count, originals = chains.node_count, chains.original_count
    return reduced(count, originals, edges.source, edges.target, base, options.mu, order=options.order, progress=tell)
