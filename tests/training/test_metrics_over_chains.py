import numpy as np
import pytest

from footwork.motion.metrics import NAMES, metric_of
from footwork.training.chain_edges import edges_of_chains
from footwork.training.chain_graph import graph_of_chains
from footwork.training.chains import NO_CHAIN, chains_of_clips
from footwork.training.interpolation import interpolated
from footwork.training.nodes import nodes_of
from footwork.training.row_metric import row_metric
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import Minima, local_minima
from motion_samples import EVERY_WAY, sample_clips, stepping

BEHAVIOURS = ("stop", "walk", "run", "jump")


def stepping_clips(count: int, frames: int):
    return [stepping(clip, 9, EVERY_WAY) for clip in sample_clips(count, frames)]


@pytest.mark.parametrize("name", NAMES)
def test_the_graph_of_clips_alone_is_the_standard_graph_of_the_metric(name):
    clips = stepping_clips(3, 70)
    metric, nodes, chains = metric_of(name, clips), nodes_of(clips, BEHAVIOURS), chains_of_clips(clips, BEHAVIOURS)
    minima = local_minima(metric.all_pairs(), nodes.lengths, 3.0)
    assert len(minima.i) > 10
    expected = standard_graph(nodes, metric, minima, 1.0)
    rows = row_metric(name, chains)
    edges = edges_of_chains(chains, minima, 3.0, rows)
    graph = graph_of_chains(clips, chains, np.arange(chains.node_count), edges, 1.0, rows)
    np.testing.assert_array_equal(graph.target, expected.target)
    np.testing.assert_array_equal(graph.cost, expected.cost)
    np.testing.assert_allclose(graph.displacement, expected.displacement, atol=1e-5)


@pytest.mark.parametrize("name", NAMES)
def test_joins_cost_what_the_metric_says(name):
    clips = stepping_clips(2, 70)
    chains = interpolated(clips, BEHAVIOURS, weights=2, pairing="plain")[0]
    rows, nothing = row_metric(name, chains), Minima(np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0))
    edges = edges_of_chains(chains, nothing, np.inf, rows)
    joins = np.flatnonzero(~edges.natural)
    assert len(joins) == np.sum(chains.followers != NO_CHAIN) > 0
    here, there = chains.row_of_node[edges.source[joins]], chains.row_of_node[edges.target[joins]] - 1
    np.testing.assert_array_equal(edges.cost[joins], rows.costs(here, there))
    under = edges_of_chains(chains, nothing, float(np.median(edges.cost[joins])), rows)
    assert np.sum(~under.natural) == np.sum(edges.cost[joins] < np.median(edges.cost[joins]))
