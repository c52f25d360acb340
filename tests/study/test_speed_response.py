from dataclasses import replace

import numpy as np
import pytest

from footwork.controllers.steering import SteeringController
from footwork.motion.graph import MotionGraph
from footwork.motion.task import SteeringTask
from footwork.study.speed_response import speed_response, speeds_kept, with_midways
from footwork.training.speed_levels import with_speed_levels
from footwork.training.value_iteration import solve
from motion_samples import ring_graph

PACES = np.repeat([0.6, 0.9, 1.2], 4)
TASK = SteeringTask(behaviours=("stop", "walk"), heading_bins=8, discount=0.9)


def paced() -> MotionGraph:
    """Three loops of walking, each at a pace of its own, with a way from every frame to one of each other loop."""
    ring, nodes = ring_graph(12), np.arange(12)
    onward = nodes // 4 * 4 + (nodes + 1) % 4
    target = np.stack([onward, (nodes + 4) % 12, (nodes + 8) % 12], axis=1).ravel()
    natural = np.tile([True, False, False], 12)
    ahead = PACES[target] / 30
    return replace(
        ring,
        root_velocity=np.stack([np.zeros(12), np.zeros(12), PACES], axis=1),
        edge_start=np.arange(0, 37, 3),
        target=target,
        cost=np.where(natural, 0.0, 0.05),
        smoothness=np.where(natural, 1.0, 0.95),
        displacement=np.stack([np.zeros(36), ahead, np.zeros(36)], axis=1),
        natural=natural,
    )


def test_levels_are_those_that_frames_show():
    levels = with_speed_levels(TASK, paced(), 3).speeds
    assert levels == {"walk": (0.6, 0.9, 1.2)}
    assert with_speed_levels(replace(TASK, speeds={"walk": (0.7,)}), paced(), 3).speeds == {"walk": (0.7,)}
    assert with_speed_levels(TASK, paced(), 0) is TASK


def test_characters_come_to_the_speed_they_are_asked_for():
    graph = paced()
    controller = SteeringController(graph, solve(graph, with_speed_levels(TASK, graph, 2)))
    assert controller.speeds == {"walk": (0.6, 1.2)}
    for asked, reached in [(0.6, 0.6), (1.2, 1.2), (0.9, 0.9), (0.1, 0.6), (9.0, 1.2)]:
        kept = speeds_kept(graph, controller, "walk", asked)
        np.testing.assert_allclose(kept[-30:], reached, rtol=1e-5)
    (middle,) = (row for row in speed_response(graph, controller)["walk"] if row["asked_m_s"] == pytest.approx(0.9))
    assert middle["reached_m_s"] == pytest.approx(0.9)
    assert middle["answered_share"] == 1.0
    assert middle["mean_s"] < 0.5


def test_midways_lie_between_levels():
    assert with_midways((1.0, 2.0, 4.0)) == [1.0, 1.5, 2.0, 3.0, 4.0]
