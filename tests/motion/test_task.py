"""The steering task: its axes, its reward and what it refuses."""

import math

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion import lookahead
from footwork.motion.task import SteeringTask

TASK = SteeringTask()
STOP, WALK, RUN, JUMP = range(4)


def test_the_task_is_that_of_the_papers():
    # conventions.md 5: 36 bins, 30 degrees, sigma 1, discount 0.98
    assert (TASK.heading_bins, TASK.smoothness_sigma, TASK.discount) == (36, 1.0, 0.98)
    assert math.degrees(TASK.heading_sigma) == pytest.approx(30.0)


def test_of_equal_edges_the_first_is_taken():
    best = np.full(1, -1, dtype=np.int32)
    lookahead.best_edges(
        node=np.zeros(1, np.int32),
        heading=np.zeros(1),
        wanted=np.zeros(1, np.int32),
        headed=np.zeros(1, np.bool_),
        sigma=1.0,
        discount=0.9,
        values=np.ones((2, 1, 4), np.float32),
        edge_start=np.array([0, 3, 3], np.int32),
        target=np.array([0, 1, 1], np.int32),
        behaviour=np.array([-1, 0], np.int16),
        turn=np.zeros(3, np.float32),
        smoothness=np.ones(3, np.float32),
        best=best,
    )
    assert best[0] == 1


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


def test_interpolation_is_periodic_and_exact_at_the_bins():
    values = np.random.default_rng(1).normal(size=TASK.heading_bins)
    for place, value in zip(TASK.headings, values, strict=True):
        assert lookahead.interpolate(values, place) == pytest.approx(value)
        assert lookahead.interpolate(values, place + 4 * math.pi) == pytest.approx(value)
    middle = math.pi - math.pi / TASK.heading_bins
    assert lookahead.interpolate(values, middle) == pytest.approx(0.5 * (values[-1] + values[0]))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("behaviours", ()),
        ("heading_bins", 3),
        ("discount", 1.0),
        ("heading_sigma", 0.0),
        ("smoothness_sigma", math.nan),
    ],
)
def test_a_senseless_task_is_refused(name, value):
    with pytest.raises(InputError, match="task: "):
        SteeringTask(**{name: value})
