"""Feet over the ground, inside compiled loops: where a ball is and which way its foot points."""

import math

import numba

_UPRIGHT = 1e-6  # metres from ankle to ball over the ground


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def sole_of(ankle, ball):
    """A foot over the ground: its ball's x and z, and sine and cosine of its yaw; 0 and 1 where it points nowhere."""
    x, z = ball[0] - ankle[0], ball[2] - ankle[2]
    length = math.sqrt(x * x + z * z)
    if length < _UPRIGHT:
        return ball[0], ball[2], 0.0, 1.0
    return ball[0], ball[2], x / length, z / length


@numba.njit(cache=True, nogil=True)
def between_yaws(sine, cosine, from_sine, from_cosine):
    """Sine and cosine of one yaw less another."""
    return sine * from_cosine - cosine * from_sine, cosine * from_cosine + sine * from_sine
