import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.training.edge_order import order_by, starts
from footwork.training.kept_edges import keep, kept_edges
from random_graphs import random_graph


@given(st.integers(0, 10_000))
@settings(max_examples=30, deadline=None)
def test_edges_to_kept_nodes_come_first_and_none_is_lost(seed):
    graph, random = random_graph(seed), np.random.default_rng(seed)
    edges = kept_edges(starts(graph.nodes, graph.source), graph.target, graph.base, np.arange(7000, dtype=np.int32))
    for nodes in np.array_split(random.permutation(graph.nodes)[: graph.nodes // 2].astype(np.int32), 3):
        keep(edges, nodes)
    for node in range(graph.nodes):
        begin, middle, end = edges.start[node], edges.middle[node], edges.start[node + 1]
        assert np.all(edges.kept[edges.target[begin:middle]] == 1)
        assert np.all(edges.kept[edges.target[middle:end]] == 0)
        there = sorted(zip(edges.target[begin:end].tolist(), edges.base[begin:end].tolist(), strict=True))
        own = graph.source == node
        assert there == sorted(zip(graph.target[own].tolist(), graph.base[own].tolist(), strict=True))


def test_the_sources_of_a_node_are_those_of_the_edges_into_it():
    graph = random_graph(4)
    edges = kept_edges(starts(graph.nodes, graph.source), graph.target, graph.base, np.arange(7000, dtype=np.int32))
    for node in range(graph.nodes):
        found = edges.source[edges.into[node] : edges.into[node + 1]]
        assert sorted(found.tolist()) == sorted(graph.source[graph.target == node].tolist())


def test_edges_in_order_are_not_sorted_again():
    assert order_by(np.array([0, 0, 2, 5])) == slice(None)
    np.testing.assert_array_equal(order_by(np.array([2, 0, 2, 0])), [1, 3, 0, 2])
