"""The steering task: its axes, its reward and what it refuses."""

import math

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import lookahead
from footwork.motion.actions import rules_of
from footwork.motion.task import SteeringTask

TASK = SteeringTask()
STOP, WALK, RUN, JUMP = range(4)


def test_the_task_is_that_of_the_papers():
    # conventions.md 5: 36 bins, 30 degrees, sigma 1, discount 0.98
    assert (TASK.heading_bins, TASK.smoothness_sigma, TASK.discount) == (36, 1.0, 0.98)
    assert math.degrees(TASK.heading_sigma) == pytest.approx(30.0)


def test_quality_is_a_gaussian_of_the_heading_where_the_heading_counts():
    deltas = np.radians([0.0, 30.0, -30.0, 330.0, 180.0])
    expected = [1.0, math.exp(-0.5), math.exp(-0.5), math.exp(-0.5), math.exp(-18.0)]
    assert np.allclose(TASK.control_quality(deltas, np.full(5, WALK), np.full(5, WALK)), expected)
    assert np.array_equal(TASK.control_quality(deltas, np.full(5, STOP), np.full(5, STOP)), np.ones(5))


def test_another_behaviour_than_asked_for_is_worth_nothing():
    assert not TASK.control_quality(np.zeros(3), np.array([RUN, JUMP, STOP]), np.array([WALK, -1, WALK])).any()


def test_the_kernel_gives_the_same_quality():
    rng = np.random.default_rng(0)
    for delta, wanted, shown in zip(
        rng.uniform(-9, 9, 99), rng.integers(0, 4, 99), rng.integers(-1, 4, 99), strict=True
    ):
        kernel = lookahead.control_quality(delta, wanted == shown, bool(TASK.headed[wanted]), TASK.heading_sigma)
        assert kernel == pytest.approx(float(TASK.control_quality(delta, wanted, shown)))


def test_speeds_are_judged_by_how_far_off_they_are_for_what_was_asked():
    task = SteeringTask(speeds={"walk": (1.0,)}, speed_sigma=0.1, speed_weight=0.75)
    off = math.exp(-0.5)
    wanted = np.array([2.0, 2.0, 0.5, math.nan])
    expected = [1.0, 0.25 + 0.75 * off, 0.25 + 0.75 * off, 1.0]
    quality = task.speed_quality(np.array([2.0, 2.2, 0.4, 7.0]), wanted)
    np.testing.assert_allclose(quality, expected)
    kernel = [
        lookahead.speed_quality(speed, asked, rules_of(task))
        for speed, asked in zip([2.0, 2.2, 0.4, 7.0], wanted.tolist(), strict=True)
    ]
    np.testing.assert_allclose(kernel, expected)


def test_interpolation_is_periodic_and_exact_at_the_bins():
    values = np.random.default_rng(1).normal(size=(2, 3, TASK.heading_bins))
    row, lowest, step = values[1, 2], np.full((2, 3), 7.0), np.full((2, 3), 3.0)
    coded = (values - 7.0) / 3.0, lowest, step
    for place, value in zip(TASK.headings, row, strict=True):
        assert lookahead.interpolate(*coded, 1, 2, place) == pytest.approx(value)
        assert lookahead.interpolate(*coded, 1, 2, place + 4 * math.pi) == pytest.approx(value)
    middle = math.pi - math.pi / TASK.heading_bins
    assert lookahead.interpolate(*coded, 1, 2, middle) == pytest.approx(0.5 * (row[-1] + row[0]))


def test_rewards_of_a_tick():
    assert lookahead.reward_of(0.5, 0.8, False, 3.0) == pytest.approx(0.4)
    assert lookahead.reward_of(0.5, 0.8, True, 3.0) == pytest.approx(0.5 + 3.0 * -0.2)


def test_extra_turns_are_levels_of_a_limit_by_behaviour():
    task = SteeringTask(warp=math.radians(6.0), warp_levels=5)
    assert task.turn_levels.tolist() == [0.0, -0.5, 0.5, -1.0, 1.0]
    limits = np.degrees(task.turn_limit(np.array([STOP, WALK, RUN, JUMP, -1])))
    assert limits == pytest.approx([1.5, 6.0, 6.0, 3.0, 0.0])
    assert SteeringTask().turn_levels.tolist() == [0.0]
    assert not SteeringTask().turn_limit(np.arange(4)).any()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("behaviours", ()),
        ("heading_bins", 3),
        ("discount", 1.0),
        ("heading_sigma", 0.0),
        ("smoothness_sigma", math.nan),
        ("discount", math.nan),
        ("reward", "greatest"),
        ("weight", 0.0),
        ("weight", math.inf),
        ("warp", math.radians(6.1)),
        ("warp", -0.1),
        ("warp", math.nan),
        ("warp_share", {"walk": 1.5}),
        ("warp_levels", 4),
        ("warp_levels", 27),
        ("segment_ticks", 0),
        ("segment_ticks", 31),
        ("speeds", {"stop": (1.0,)}),
        ("speeds", {"crawl": (1.0,)}),
        ("speeds", {"walk": ()}),
        ("speeds", {"walk": (1.0, 1.0)}),
        ("speeds", {"walk": (-0.1, 1.0)}),
        ("speeds", {"walk": (1.0, 21.0)}),
        ("speeds", {"walk": (math.nan,)}),
        ("speeds", {"run": tuple(range(17))}),
        ("speed_sigma", 0.0),
        ("speed_weight", 1.1),
        ("speed_weight", math.nan),
    ],
)
def test_a_senseless_task_is_refused(name, value):
    with pytest.raises(InputError, match="task: "):
        SteeringTask(**{name: value})
