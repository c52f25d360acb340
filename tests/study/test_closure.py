import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flat_graphs import csr, distances, line, random_graph, ring
from footwork.errors import InputError
from footwork.study import closure as module
from footwork.study.closure import closure, closure_share


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 150), st.floats(0.0, 2.0))
def test_the_closure_is_what_shortest_ways_reach(seed, nodes, density):
    graph = random_graph(seed, nodes, int(density * nodes))
    frames = np.random.default_rng(seed).permutation(nodes)[: max(2, nodes // 2)]
    expected = np.isfinite(distances(*graph)[np.ix_(frames, frames)])
    np.testing.assert_array_equal(closure(*graph, frames), expected)
    pairs = len(frames) * (len(frames) - 1)
    assert closure_share(*graph, frames) == pytest.approx((expected.sum() - len(frames)) / pairs)


def test_wide_closures_are_gathered_in_blocks(monkeypatch):
    graph, frames = random_graph(5, 400, 380), np.arange(400)
    whole, share = closure(*graph, frames), closure_share(*graph, frames)
    monkeypatch.setattr(module, "_BYTES_AT_ONCE", 1)
    np.testing.assert_array_equal(closure(*graph, frames), whole)
    assert closure_share(*graph, frames) == share


def test_all_of_a_ring_half_of_a_line_and_two_rings_apart():
    assert closure_share(*ring(10), np.arange(10)) == 1.0
    assert closure_share(*line(10), np.arange(10)) == pytest.approx(0.5)
    apart = csr(10, np.arange(10), [1, 2, 3, 4, 0, 6, 7, 8, 9, 5])
    assert closure_share(*apart, np.arange(10)) == pytest.approx(40 / 90)


def test_one_frame_makes_no_pair():
    with pytest.raises(InputError, match="expected at least 2"):
        closure_share(*ring(3), np.array([1]))
