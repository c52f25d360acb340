import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.training.edge_order import starts
from footwork.training.kept_edges import kept_edges
from footwork.training.reachability import between_originals
from random_graphs import random_graph


@given(st.integers(0, 10_000), st.integers(0, 60))
@settings(max_examples=40, deadline=None)
def test_the_nodes_between_originals_are_those_that_both_closures_hold(seed, edges):
    graph = random_graph(seed, edges=edges)
    flat = kept_edges(starts(graph.nodes, graph.source), graph.target, graph.base, np.arange(7000, dtype=np.int32))
    joined = np.eye(graph.nodes, dtype=bool)
    joined[graph.source, graph.target] = True
    for _ in range(graph.nodes.bit_length()):
        joined = joined @ joined
    entered = joined[: graph.originals].any(axis=0)
    left = joined[:, : graph.originals].any(axis=1)
    np.testing.assert_array_equal(between_originals(graph.originals, flat), entered & left)
