from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from every_pair import transitions_by_brute_force
from footwork.errors import InputError
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.metric import PointCloudMetric
from footwork.motion.metrics import NAMES
from footwork.motion.pair_weights import PairWeights
from footwork.motion.task import SteeringTask
from footwork.training import transition_search
from footwork.training.chain_bands import COLUMNS, DIAGONALS, ROWS, STRETCH
from footwork.training.chain_minima import _diagonals
from footwork.training.chains import CONTEXT, Chains, chains_of_clips
from footwork.training.dataset import load_clips
from footwork.training.interpolation import interpolated
from footwork.training.row_metric import RowMetric, row_metric
from footwork.training.transition_search import search
from footwork.training.transitions import local_minima
from motion_samples import sample_clip
from shared_data import MOTIONS, needs_motions

BEHAVIOURS = SteeringTask().behaviours


def wandering_chains(seed: int, clips: int, interpolated_chains: int, joints: int = 3, longest: int = 39) -> Chains:
    """Points that wander smoothly, many of them along nearly the same way; context where chains are interpolated."""
    rng = np.random.default_rng(seed)
    count = clips + interpolated_chains
    length = rng.integers(1, longest + 1, count)
    context = np.where(np.arange(count) < clips, 0, CONTEXT)
    way = np.cumsum(np.cumsum(rng.normal(0.0, 0.002, (60, joints, 3)), axis=0), axis=0)
    places = [
        way[np.minimum(np.arange(rows), 59)] + np.cumsum(rng.normal(0.0, 0.003, (rows, joints, 3)), axis=0)
        for rows in (length + 2 * context).tolist()
    ]
    nodes = int(length.sum())
    none = np.zeros(nodes)
    source = np.where(np.arange(count) < clips, -1, np.arange(count))
    fields: dict[str, Any] = dict.fromkeys(("clip", "frame", "other_clip", "other_frame", "label", "behaviour"), none)
    fields |= {"skeleton": default_body(), "clips": ("made up",), "labels": ("",), "behaviours": ("stop",)}
    fields |= {"length": length, "context": context, "places": np.concatenate(places), "first": source}
    fields |= {"second": source, "chain_weight": np.ones(count), "contacts": np.zeros((nodes, 2))}
    return Chains(**fields)


def assert_same(found, expected):
    assert list(zip(found.i.tolist(), found.j.tolist(), strict=True)) == list(
        zip(expected.i.tolist(), expected.j.tolist(), strict=True)
    )
    np.testing.assert_allclose(found.cost, expected.cost, rtol=0.0, atol=1e-9)


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 4), st.integers(0, 12), st.sampled_from([0.05, 0.5, 4.0, np.inf]))
def test_transitions_are_those_of_comparing_every_pair(seed, clips, others, threshold):
    chains = wandering_chains(seed, clips, others)
    metric = RowMetric(chains, chains.places, np.random.default_rng(seed).random(3))
    assert_same(search(chains, threshold), transitions_by_brute_force(chains, threshold))
    weighted = search(chains, threshold, metric=metric)
    assert_same(weighted, transitions_by_brute_force(chains, threshold, metric))


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 4), st.integers(0, 12), st.sampled_from([0.05, 0.5, 4.0, np.inf]))
def test_weights_of_each_pair_give_what_comparing_every_pair_gives(seed, clips, others, threshold):
    rng, chains = np.random.default_rng(seed), wandering_chains(seed, clips, others)
    chains = replace(
        chains, contacts=np.repeat(rng.random((chains.node_count // 5 + 1, 2)) < 0.5, 5, 0)[: chains.node_count]
    )
    pair = PairWeights(rng.dirichlet(np.ones(3)), 2.0 * rng.random((2, 3)))
    metric = RowMetric(chains, chains.places, pair.mass, pair)
    found = search(chains, threshold, metric=metric)
    assert_same(found, transitions_by_brute_force(chains, threshold, metric))


@pytest.mark.parametrize("seed", range(3))
def test_chains_longer_than_what_is_dealt_with_at_once_give_the_same(seed):
    chains = wandering_chains(seed, 3, 0, longest=200)
    assert chains.length.max() > 2 * STRETCH
    for threshold in (0.5, np.inf):
        assert_same(search(chains, threshold), transitions_by_brute_force(chains, threshold))


def test_the_furthest_diagonals_have_room():
    near = np.array([[0, 1 << (ROWS - 1)], [COLUMNS - 1, 1]])
    used, bands = np.zeros(DIAGONALS, dtype=np.bool_), np.empty((DIAGONALS, 2), dtype=np.int64)
    assert (
        _diagonals.py_func(near, used, bands) == 2
    )  # as plain Python, which counts from the end or says what is not there
    assert bands[:2].tolist() == [[1 - COLUMNS] * 2, [ROWS - 1] * 2]


@needs_motions
@pytest.mark.parametrize("name", NAMES)
def test_every_metric_finds_on_capture_what_comparing_every_pair_finds(name):
    clips = [clip.cut(0, min(clip.frame_count, 60)) for clip in capture("dataset2", 3)]
    chains = interpolated(clips, BEHAVIOURS, weights=2)[0]
    metric = row_metric(name, chains)
    expected = transitions_by_brute_force(chains, 0.4, metric)
    assert len(expected.i) > 20
    assert_same(search(chains, 0.4, metric=metric), expected)


@pytest.mark.parametrize("share", [0.0, 0.02, 0.3])
def test_only_pairs_with_an_active_side_are_found(share):
    chains = wandering_chains(3, 3, 20)
    active = np.random.default_rng(0).random(chains.node_count) < share
    expected = transitions_by_brute_force(chains, 2.0, active=active)
    assert_same(search(chains, 2.0, active=active), expected)
    assert (len(expected.i) > 0) == (share > 0.0)


@needs_motions
@pytest.mark.parametrize("threshold", [0.2, 0.6])
def test_capture_and_its_interpolations_give_what_comparing_every_pair_gives(threshold):
    clips = capture("dataset3", 5) + capture("dataset1", 1)
    clips = [clip.cut(0, min(clip.frame_count, 80)) for clip in clips]
    assert sum(clip.frame_count for clip in clips) >= 300
    chains = interpolated(clips, BEHAVIOURS, weights=2)[0]
    expected = transitions_by_brute_force(chains, threshold)
    found = search(chains, threshold)
    assert len(found.i) > 50
    assert_same(found, expected)
    standard = local_minima(PointCloudMetric.of_clips(clips).all_pairs(), [c.frame_count for c in clips], threshold)
    between = found.j < chains.original_count
    assert np.array_equal(found.i[between], standard.i)
    assert np.array_equal(found.j[between], standard.j)


def capture(name: str, count: int) -> list[Clip]:
    return list(load_clips(MOTIONS / name, ranges=Path(MOTIONS / "core_ranges.csv"), body=default_body()).clips[:count])


def test_transitions_between_clips_are_those_of_the_standard_graph():
    chains = wandering_chains(7, 6, 0)
    lengths = chains.length.tolist()
    metric = PointCloudMetric(np.split(chains.places, np.cumsum(lengths)[:-1]))
    expected = local_minima(metric.all_pairs(), lengths, 4.0)
    assert len(expected.i) > 5
    assert_same(search(chains, 4.0), expected)


def test_a_motion_that_comes_twice_is_left_at_its_first_frame_alone_on_the_plateau():
    clip = sample_clip(1, 40)
    found = search(chains_of_clips([clip, clip], BEHAVIOURS), 1e-6)
    assert (found.i.tolist(), found.j.tolist(), found.cost.tolist()) == ([0], [40], [0.0])


def test_the_result_does_not_depend_on_how_the_work_is_cut(monkeypatch):
    chains = wandering_chains(5, 3, 40)
    whole = search(chains, 2.0)
    for count in (2, 17, 1000):
        monkeypatch.setattr(transition_search, "TASKS", count)
        monkeypatch.setattr(transition_search, "_FEWEST", 1)
        parts = search(chains, 2.0)
        assert np.array_equal(parts.i, whole.i)
        assert np.array_equal(parts.j, whole.j)
        assert np.array_equal(parts.cost, whole.cost)


def test_one_frame_by_itself_has_no_transition():
    chains = wandering_chains(0, 1, 0)
    still = Chains(**{**vars_of(chains), "length": [1], "places": chains.places[:1]} | first_nodes(chains, 1))
    assert len(search(still, np.inf).i) == 0


def vars_of(chains: Chains) -> dict:
    return {name: getattr(chains, name) for name in chains.__dataclass_fields__}


def first_nodes(chains: Chains, count: int) -> dict:
    names = ("clip", "frame", "other_clip", "other_frame", "label", "behaviour", "contacts")
    return {name: getattr(chains, name)[:count] for name in names}


def test_progress_ends_at_one():
    told: list[float] = []
    search(wandering_chains(1, 2, 2), 1.0, progress=told.append)
    assert told[-1] == 1.0


@pytest.mark.parametrize("threshold", [0.0, -1.0, np.nan])
def test_a_threshold_that_is_none_is_refused(threshold):
    with pytest.raises(InputError, match="expected a number above 0"):
        search(wandering_chains(1, 1, 1), threshold)


@pytest.mark.parametrize("weights", [[0.0, 0.0, 0.0], [1.0, -1.0, 1.0], [1.0, np.nan, 1.0], [1.0, 1.0]])
def test_weights_that_cannot_be_scaled_are_refused(weights):
    with pytest.raises(InputError, match="weights"):
        RowMetric(chains := wandering_chains(1, 1, 1), chains.places, np.array(weights))
