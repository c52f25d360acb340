from dataclasses import replace

import numpy as np
import pytest

from footwork.motion.metric import PointCloudMetric
from footwork.motion.moves import LEAP
from footwork.motion.turn_warp import adjustment_cost, turn_warp
from footwork.study.charges import charges, edge_costs, leap_costs
from toy_graphs import edge_between, graph_of, wandering_clip

FRAMES = 24
CLIPS = [wandering_clip(seed, FRAMES) for seed in range(2)]
GRAPH = graph_of(CLIPS, [(3, 30), (33, 8), (20, 2)])
METRIC = PointCloudMetric.of_clips(CLIPS)


def test_a_leap_costs_what_the_metric_says_of_the_frame_left_and_the_one_before_the_target():
    random = np.random.default_rng(3)
    source, similar = random.integers(0, 2 * FRAMES, 40), random.integers(0, FRAMES - 1, 40)
    similar += FRAMES * random.integers(0, 2, 40)
    expected = METRIC.pair_costs(source, similar)
    np.testing.assert_allclose(leap_costs(GRAPH, source, similar + 1), expected, rtol=1e-4, atol=1e-5)


def test_a_leap_to_the_frame_that_follows_costs_nothing_and_one_to_a_first_frame_is_compared_with_it():
    following = np.arange(FRAMES - 1)
    np.testing.assert_allclose(leap_costs(GRAPH, following, following + 1), 0.0, atol=1e-9)
    assert leap_costs(GRAPH, np.array([7]), np.array([FRAMES])) == pytest.approx(METRIC.pair_costs(7, FRAMES), rel=1e-4)


def test_a_tick_is_charged_its_edge_or_leap_and_what_was_added_to_it():
    graph = replace(GRAPH, smoothness=np.where(GRAPH.natural, 1.0, np.exp(-0.4 / 2.0)))
    warp = turn_warp(graph)
    natural, jump = edge_between(graph, 4, 5), edge_between(graph, 3, 31)
    source, edge, target = np.array([4, 3, 9, 4]), np.array([natural, jump, LEAP, natural]), np.array([5, 31, 40, 5])
    added = np.zeros((4, 3))
    added[3] = 0.01, -0.02, 0.1
    leap = leap_costs(graph, np.array([9]), np.array([40]))[0]
    expected = [0.0, 0.4, leap, adjustment_cost(warp.moments[5], added[3])]
    np.testing.assert_allclose(charges(graph, warp, source, edge, target, added, sigma=2.0), expected, rtol=1e-5)


def test_a_smoothness_of_nothing_still_has_a_cost():
    assert np.isfinite(edge_costs(replace(GRAPH, smoothness=np.zeros(GRAPH.edge_count)), np.arange(3), 1.0)).all()
