import math
from dataclasses import replace

import numpy as np
import pytest

from footwork.motion.node_speed import REACH, node_speeds
from motion_samples import ring_graph


def test_a_body_that_goes_straight_on_is_as_fast_as_its_steps():
    np.testing.assert_allclose(node_speeds(ring_graph(40)), 1.2)


def test_a_bend_is_cut_short():
    turn, ticks = math.radians(4.0), 2 * REACH + 1
    before = np.array([math.sin(-turn), 0.0, math.cos(turn)], np.float32) * 1.2
    graph = replace(ring_graph(90, turn), root_velocity=np.tile(before, (90, 1)))
    chord = 0.04 * math.sin(ticks * turn / 2) / math.sin(turn / 2)
    np.testing.assert_allclose(node_speeds(graph), chord * 30 / ticks, rtol=1e-5)


def test_sway_within_half_a_second_cancels():
    sway = np.tile([[0.03, 0.04, 0.0], [-0.03, 0.04, 0.0]], (20, 1)).astype(np.float32)
    assert node_speeds(replace(ring_graph(40), displacement=sway)) == pytest.approx(1.2, rel=0.01)


def test_a_frame_without_neighbours_keeps_its_own_velocity():
    alone = replace(ring_graph(4), natural=np.zeros(4, np.bool_), root_velocity=np.full((4, 3), [0.3, 5.0, 0.4]))
    np.testing.assert_allclose(node_speeds(alone), 0.5)


def test_the_time_that_natural_edges_cover_counts():
    natural = np.ones(20, np.bool_)
    natural[4] = False
    slow_start = np.full((20, 3), [0.0, 0.0, 0.3])
    speeds = node_speeds(replace(ring_graph(20), natural=natural, root_velocity=slow_start))
    assert speeds[5] == pytest.approx((REACH * 0.04 + 0.01) * 30 / (REACH + 1))
    assert speeds[4] == pytest.approx((REACH * 0.04 + 0.01) * 30 / (REACH + 1))
    assert speeds[14] == pytest.approx((2 * REACH * 0.04 + 0.01) * 30 / (2 * REACH + 1))
