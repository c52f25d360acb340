import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.training.connectivity import connecting_threshold, largest_component, restricted
from footwork.training.standard_graph import edges_of
from footwork.training.transitions import Minima
from motion_samples import ring_graph


def reachable(count, source, target):
    """Which nodes lead to which by at least one edge, by repeated squaring."""
    reach = np.zeros((count, count), dtype=bool)
    reach[source, target] = True
    for _ in range(count):
        reach |= reach @ reach
    return reach


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 12), st.integers(0, 20))
def test_the_largest_part_is_the_largest_set_of_nodes_that_reach_each_other(seed, count, edges):
    source, target = np.random.default_rng(seed).integers(0, count, (2, edges))
    reach = reachable(count, source, target)
    mutual = reach & reach.T
    sizes = mutual.sum(axis=1)
    expected = np.flatnonzero(mutual[np.argmax(sizes)]) if sizes.max() else []
    np.testing.assert_array_equal(largest_component(count, source, target), expected)


def test_a_chain_has_no_part_that_can_be_walked_without_end():
    assert largest_component(5, np.arange(4), np.arange(1, 5)).size == 0
    assert largest_component(5, np.array([], int), np.array([], int)).size == 0


def test_a_restricted_graph_keeps_the_edges_between_its_nodes():
    graph = ring_graph(8)
    part = restricted(graph, np.array([2, 3, 4, 7]))
    np.testing.assert_array_equal(part.frame, [2, 3, 4, 7])
    np.testing.assert_array_equal(part.source, [0, 1])
    np.testing.assert_array_equal(part.target, [1, 2])
    whole = restricted(graph, np.arange(8))
    np.testing.assert_array_equal(whole.edge_start, graph.edge_start)
    np.testing.assert_array_equal(whole.target, graph.target)


@pytest.mark.parametrize("seed", range(8))
def test_the_connecting_threshold_connects_and_no_lower_one_does(seed):
    rng = np.random.default_rng(seed)
    lengths = np.array([12, 20, 9, 15])
    ends = np.repeat(np.cumsum(lengths) - 1, lengths)
    i, j = np.sort(rng.integers(0, lengths.sum(), (2, 60)), axis=0)
    minima = Minima(i, j, rng.random(60))

    def share(threshold):
        edges = edges_of(ends, minima.under(threshold))
        return largest_component(len(ends), edges.source, edges.target).size / len(ends)

    found = connecting_threshold(ends, minima, 0.5)
    tried = [cost for cost in np.sort(minima.cost) if share(np.nextafter(cost, 2.0)) >= 0.5]
    if found is None:
        assert not tried
    else:
        assert found == np.nextafter(tried[0], 2.0)


def test_clips_that_are_never_alike_cannot_be_connected():
    none = np.array([], dtype=np.intp)
    assert connecting_threshold(np.full(10, 9), Minima(none, none, np.array([]))) is None
