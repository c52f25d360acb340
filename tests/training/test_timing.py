import numpy as np
import pytest

from footwork.training.chains import CONTEXT
from footwork.training.segments import Segments
from footwork.training.timing import durations, row_positions, timing_of


def segments(frames, signature):
    start = np.cumsum(frames) - frames
    zeros = np.zeros(len(frames))
    return Segments(zeros.astype(int), start, start + frames, np.full(len(frames), signature), zeros > 0, zeros)


def test_flights_last_the_root_mean_square_and_stances_the_mean():
    assert durations([[6.0, 8.0]], [True], [0.5])[0] == pytest.approx(np.sqrt(50.0))
    assert durations([[6.0, 8.0]], [False], [0.25])[0] == pytest.approx(7.5)


def test_a_flights_acceleration_is_that_of_its_sources_whatever_the_weight():
    # x(u) = -g/2 (uT)^2 in both sources, u the phase: their mix over the duration T_w has the same g
    one, other = 10.0, 18.0
    for w in (0.1, 0.3, 0.7):
        span = durations([[one, other]], [True], [w])[0]
        assert (w * one**2 + (1 - w) * other**2) / span**2 == pytest.approx(1.0)
        linear = durations([[one, other]], [False], [w])[0]
        assert (w * one**2 + (1 - w) * other**2) / linear**2 > 1.01


def test_a_stances_rows_fill_both_segments_evenly():
    made = segments(np.array([12, 20]), 1)
    timing = timing_of(made, [[0, 1]], [0.5])
    assert timing.frames[0] == 16
    np.testing.assert_allclose(timing.rate[0], [12 / 16, 20 / 16])
    last = timing.begin[0] + 15 * timing.rate[0]
    # from half a step after the edge between frames to half a step before the next
    np.testing.assert_allclose(timing.begin[0], [-0.5 + 6 / 16, 11.5 + 10 / 16])
    np.testing.assert_allclose(last, [11.5 - 6 / 16, 31.5 - 10 / 16])


def test_equal_durations_give_the_frames_themselves():
    timing = timing_of(segments(np.array([7, 7]), 2), [[0, 1]], [0.3])
    which, position = row_positions(timing, np.array([0]))
    np.testing.assert_array_equal(which, 0)
    np.testing.assert_allclose(position[CONTEXT:-CONTEXT, 0], np.arange(7))
    np.testing.assert_allclose(position[CONTEXT:-CONTEXT, 1], np.arange(7, 14))


def test_context_goes_on_at_one_frame_a_row():
    timing = timing_of(segments(np.array([6, 12]), 1), [[0, 1]], [0.5])
    position = row_positions(timing, np.array([0]))[1]
    steps = np.diff(position, axis=0)
    np.testing.assert_allclose(steps[:CONTEXT], 1.0)
    np.testing.assert_allclose(steps[-CONTEXT:], 1.0)
    np.testing.assert_allclose(steps[CONTEXT:-CONTEXT], np.tile(timing.rate[0], (8, 1)))


def test_flights_run_at_the_durations_own_rate():
    timing = timing_of(segments(np.array([5, 8]), 0), [[0, 1]], [0.5])
    span = np.sqrt(0.5 * (25 + 64))
    np.testing.assert_allclose(timing.rate[0], [5 / span, 8 / span])
    middle = timing.begin[0] + 0.5 * (timing.frames[0] - 1) * timing.rate[0]
    np.testing.assert_allclose(middle, [2.0, 8.5])
