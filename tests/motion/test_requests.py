import math

import numpy as np
import pytest

from footwork.motion.player_model import PlayerModel
from footwork.motion.requests import ANY_SPEED, asked_for, holding_speed
from footwork.motion.task import SteeringTask

TASK = SteeringTask(heading_bins=4, speeds={"run": (3.0,), "walk": (0.5, 1.0, 1.5)})
STOP, WALK, RUN = range(3)
SLOW, MIDDLE, FAST, RUNNING = range(4, 8)


def test_requests_are_the_behaviours_and_then_their_levels():
    behaviour, speed = TASK.requests
    assert behaviour.tolist() == [0, 1, 2, 3, WALK, WALK, WALK, RUN]
    np.testing.assert_array_equal(speed, [ANY_SPEED] * 4 + [0.5, 1.0, 1.5, 3.0])
    assert SteeringTask().requests.behaviour.tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize(
    ("behaviour", "speed", "within", "low", "high", "share"),
    [
        (WALK, ANY_SPEED, ANY_SPEED, WALK, WALK, 0.0),
        (STOP, 1.0, ANY_SPEED, STOP, STOP, 0.0),
        (WALK, 0.5, 0.5, SLOW, SLOW, 0.0),
        (WALK, 0.6, 0.6, SLOW, MIDDLE, 0.2),
        (WALK, 1.0, 1.0, MIDDLE, MIDDLE, 0.0),
        (WALK, 1.25, 1.25, MIDDLE, FAST, 0.5),
        (WALK, 0.1, 0.5, SLOW, SLOW, 0.0),
        (WALK, 9.0, 1.5, FAST, FAST, 0.0),
        (RUN, 0.0, 3.0, RUNNING, RUNNING, 0.0),
    ],
)
def test_a_speed_lies_between_two_levels_or_at_the_nearest(behaviour, speed, within, low, high, share):
    asked = asked_for(TASK.requests, behaviour, speed)
    assert asked.behaviour == behaviour
    np.testing.assert_array_equal(asked.speed, within)
    assert (asked.low, asked.high) == (low, high)
    assert asked.share == pytest.approx(share)


def test_a_speed_is_held_as_long_as_the_behaviour_is():
    change = np.random.default_rng(0).random((4, 4, 4))
    player = PlayerModel(TASK.behaviours, change / change.sum(axis=(1, 2), keepdims=True))
    held = holding_speed(player, TASK.requests)
    behaviour, speed = TASK.requests
    for before in range(8):
        for after in range(8):
            same = behaviour[before] == behaviour[after]
            possible = before == after if same else math.isnan(speed[after])
            expected = player.change[behaviour[before], behaviour[after]] * possible
            np.testing.assert_array_equal(held.change[before, after], expected)
    assert holding_speed(player, SteeringTask(heading_bins=4).requests) is player
