import numpy as np

from footwork.motion.window import LENGTH, RADIUS, window_frames, window_weights


def test_weights_are_those_of_the_convention():
    half = [0.0385, 0.0699, 0.0944, 0.1119, 0.1224, 0.1259]
    np.testing.assert_allclose(window_weights(), half + half[-2::-1], atol=5e-5)
    assert np.isclose(window_weights().sum(), 1.0)


def test_windows_stay_inside_their_clip():
    windows = window_frames([30, 3, 1])
    assert windows.shape == (34, LENGTH)
    np.testing.assert_array_equal(windows[10], np.arange(5, 16))
    np.testing.assert_array_equal(windows[0], [0] * RADIUS + list(range(RADIUS + 1)))
    np.testing.assert_array_equal(windows[31], [30] * 5 + [31] + [32] * 5)
    np.testing.assert_array_equal(windows[33], [33] * LENGTH)
