import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flat_graphs import distances, line, random_graph, ring
from footwork.study.behaviour_times import behaviour_times

KINDS = ("idle", "walk", "run")


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 14), st.integers(0, 40))
def test_both_tables_are_those_of_all_shortest_ways(seed, nodes, edges):
    graph, rng = random_graph(seed, nodes, edges), np.random.default_rng(seed)
    kind, frames = rng.integers(-1, 3, nodes), np.flatnonzero(rng.random(nodes) < 0.7)
    found = behaviour_times(*graph, kind, KINDS, frames)
    table = distances(*graph) / 30
    for row, start in enumerate(found.kinds):
        for column, end in enumerate(found.kinds):
            a, b = (frames[kind[frames] == KINDS.index(name)] for name in (start, end))
            nearest = table[np.ix_(a, b)].min(axis=1)
            known = nearest[np.isfinite(nearest)]
            expected = (known.min(), known.mean()) if known.size else (np.nan, np.nan)
            np.testing.assert_allclose((found.least[row, column], found.mean[row, column]), expected)
    assert set(found.kinds) == {KINDS[index] for index in np.unique(kind[frames]) if index >= 0}


def test_round_a_ring_of_two_halves():
    found = behaviour_times(*ring(12), np.repeat([0, 2], 6), KINDS)
    assert found.kinds == ("idle", "run")
    np.testing.assert_allclose(found.least * 30, [[0, 1], [1, 0]])
    np.testing.assert_allclose(found.mean * 30, [[0, 3.5], [3.5, 0]])
    assert found.mean_off_diagonal == (pytest.approx(1 / 30), pytest.approx(3.5 / 30))
    assert found.tables()["mean_s"]["idle"]["run"] == pytest.approx(3.5 / 30)


def test_where_there_is_no_way_back_there_is_no_time():
    found = behaviour_times(*line(4), np.array([0, 0, 1, 1]), KINDS)
    assert found.tables()["least_s"]["walk"]["idle"] is None
    json.dumps(found.tables(), allow_nan=False)
    assert behaviour_times(*line(2), np.zeros(2), KINDS).mean_off_diagonal == (None, None)
