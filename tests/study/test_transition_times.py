import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flat_graphs import distances, line, random_graph, ring
from footwork.errors import InputError
from footwork.study.transition_times import transition_times


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 90), st.data())
def test_the_mean_is_that_of_all_pairs_that_have_a_way(seed, nodes, data):
    graph = random_graph(seed, nodes, data.draw(st.integers(0, 3 * nodes)))
    frames = np.flatnonzero(np.random.default_rng(seed).random(nodes) < 0.6)
    frames = frames if frames.size else np.array([0])
    between = distances(*graph)[np.ix_(frames, frames)]
    between[np.eye(len(frames), dtype=bool)] = np.inf
    known = between[np.isfinite(between)]
    times = transition_times(*graph, frames)
    assert times.exact
    assert times.mean == (pytest.approx(known.mean() / 30) if known.size else None)
    np.testing.assert_array_equal(times.reached, np.isfinite(between).sum(axis=1))
    np.testing.assert_array_equal(times.histogram[1:], np.bincount(known.astype(int))[1:] if known.size else [])
    assert times.reachable_share == pytest.approx(
        known.size / max(len(frames) * (len(frames) - 1), 1) or float(len(frames) == 1)
    )


def test_on_a_ring_ways_are_half_round_on_average():
    times = transition_times(*ring(300), np.arange(300))
    assert times.mean == pytest.approx(150 / 30)
    assert times.percentile(1.0) == pytest.approx(299 / 30)
    assert times.interval == (times.mean, times.mean)


def test_on_a_line_ways_go_one_way_and_take_a_third_of_it():
    times = transition_times(*line(80), np.arange(80))
    assert times.mean == pytest.approx(81 / 3 / 30)
    assert times.reachable_share == pytest.approx(0.5)


def test_every_source_of_a_ring_tells_the_mean():
    times = transition_times(*ring(500), np.arange(500), sources=7)
    assert len(times.sources) == 7
    assert not times.exact
    assert times.interval == (pytest.approx(times.mean), pytest.approx(times.mean))
    assert times.mean == pytest.approx(250 / 30)


def test_the_interval_of_a_sample_holds_the_mean_as_often_as_it_says():
    graph = random_graph(1, 400, 900)
    frames = np.arange(400)
    exact = transition_times(*graph, frames).mean or 0.0
    tries = [transition_times(*graph, frames, sources=40, seed=seed).interval or (0.0, 0.0) for seed in range(100)]
    assert 88 <= sum(low <= exact <= high for low, high in tries) <= 100
    assert np.mean([high - low for low, high in tries]) < 0.5 * exact


def test_a_sample_is_drawn_alike_by_one_seed_and_its_figures_go_into_json():
    graph = random_graph(2, 200, 500)
    first, again, other = (transition_times(*graph, np.arange(200), sources=9, seed=seed) for seed in (4, 4, 5))
    np.testing.assert_array_equal(first.sources, again.sources)
    assert not np.array_equal(first.sources, other.sources)
    assert json.loads(json.dumps(first.summary(), allow_nan=False))["sources"] == 9


def test_nothing_to_measure_is_said_so():
    with pytest.raises(InputError, match="expected at least 1"):
        transition_times(*ring(4), np.array([], dtype=int))
    with pytest.raises(InputError, match="expected at least 1"):
        transition_times(*ring(4), np.arange(4), sources=0)
    alone = transition_times(*line(1), np.arange(1))
    assert alone.mean is alone.interval is alone.percentile(0.5) is None
