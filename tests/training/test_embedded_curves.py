import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from footwork.training.embedded.curves import ease, hump, keyed, lower_envelope, quintic, smoothed

VALUES = arrays.arrays(np.float64, st.integers(30, 120), elements=st.floats(-2.0, 2.0))


@settings(max_examples=50, deadline=None)
@given(VALUES, st.floats(0.05, 0.6))
def test_a_lower_envelope_is_never_above(values, seconds):
    assert (lower_envelope(values, seconds, 30.0) <= values + 1e-12).all()


def test_a_lower_envelope_keeps_a_level_curve():
    np.testing.assert_allclose(lower_envelope(np.full(40, 0.9), 0.2, 30.0), 0.9)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=8))
def test_keys_are_met_and_never_overshot(values):
    keys = list(enumerate(values))
    curve = keyed(keys, np.linspace(-1.0, len(values), 400))
    assert curve.min() >= min(values) - 1e-12
    assert curve.max() <= max(values) + 1e-12
    np.testing.assert_allclose(keyed(keys, np.arange(len(values), dtype=float)), values, atol=1e-12)


def test_smoothing_keeps_the_sum_of_what_lies_inside():
    values = np.zeros(61)
    values[20:40] = 1.0
    np.testing.assert_allclose(smoothed(values, 0.4, 30.0).sum(), values.sum())


def test_a_quintic_with_gravity_at_both_ends_is_the_parabola():
    times = np.linspace(0.0, 0.4, 9)
    curve = quintic((0.0, 1.0, 0.5 * 9.81 * 0.4, -9.81), (0.4, 1.0, -0.5 * 9.81 * 0.4, -9.81), times)
    np.testing.assert_allclose(curve, 1.0 + 0.5 * 9.81 * times * (0.4 - times), atol=1e-12)


def test_easing_and_humps_start_and_end_level():
    share = np.array([-1.0, 0.0, 0.5, 1.0, 2.0])
    np.testing.assert_allclose(ease(share), [0.0, 0.0, 0.5, 1.0, 1.0])
    np.testing.assert_allclose(hump(share, 2.0, 2.0), [0.0, 0.0, 1.0, 0.0, 0.0])
    np.testing.assert_allclose(hump(np.array([0.4]), 2.0, 3.0), 1.0)
