import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.training.transitions import MIN_GAP, local_minima


def slow_minima(costs, lengths, threshold):
    """The definition, pair by pair."""
    clip = np.repeat(np.arange(len(lengths)), lengths)
    count = len(clip)
    found = []

    def together(a, b):
        return 0 <= a < count and 0 <= b < count and clip[a] == clip[b]

    for i in range(count):
        for j in range(i + 1, count):
            steps = [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1) if (a, b) != (0, 0)]
            near = [(i + a, j + b) for a, b in steps if together(i, i + a) and together(j, j + b)]
            lower = all(costs[i, j] < costs[a, b] or (costs[i, j] == costs[a, b] and (i, j) < (a, b)) for a, b in near)
            apart = clip[i] != clip[j] or j - i >= MIN_GAP
            leaves = together(i, i + 1) or together(j, j + 1)
            if costs[i, j] < threshold and lower and apart and leaves:
                found.append((i, j))
    return found


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.lists(st.integers(1, 25), min_size=1, max_size=5), st.integers(2, 30))
def test_minima_are_those_of_the_definition(seed, lengths, levels):
    # few levels make many ties
    count = sum(lengths)
    costs = np.random.default_rng(seed).integers(0, levels, (count, count)).astype(float)
    costs = np.minimum(costs, costs.T)
    threshold = 0.6 * levels
    found = local_minima(costs, lengths, threshold)
    assert list(zip(found.i.tolist(), found.j.tolist(), strict=True)) == slow_minima(costs, lengths, threshold)
    np.testing.assert_array_equal(found.cost, costs[found.i, found.j])


def test_a_flat_stretch_gives_one_minimum():
    costs = np.zeros((40, 40))
    found = local_minima(costs, [20, 20], 1.0)
    assert (found.i.tolist(), found.j.tolist()) == ([0], [20])


def test_more_minima_than_expected_are_all_found():
    rows, columns = np.meshgrid(np.arange(400), np.arange(400))
    costs = ((rows + columns) % 2 + (rows % 2)).astype(float)
    costs = np.minimum(costs, costs.T)
    found = local_minima(costs, [100] * 4)
    assert len(found.i) == len(slow_minima(costs, [100] * 4, np.inf)) > 4096


def test_the_threshold_itself_is_not_under_the_threshold():
    costs = np.full((20, 20), 5.0)
    costs[3, 13] = costs[13, 3] = 1.0
    assert len(local_minima(costs, [10, 10], 1.0).i) == 0
    assert len(local_minima(costs, [10, 10], np.nextafter(1.0, 2.0)).i) == 1


@pytest.mark.parametrize("threshold", [0.5, 2.0])
def test_a_lower_threshold_keeps_some_of_the_same(threshold):
    costs = np.random.default_rng(0).random((60, 60)) * 4.0
    costs = np.minimum(costs, costs.T)
    kept = local_minima(costs, [30, 30]).under(threshold)
    direct = local_minima(costs, [30, 30], threshold)
    np.testing.assert_array_equal(kept.i, direct.i)
    np.testing.assert_array_equal(kept.j, direct.j)
