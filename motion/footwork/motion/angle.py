"""Angles that mean the same."""

import math

import numba
import numpy as np
from numpy.typing import ArrayLike, NDArray


def wrapped(angle: ArrayLike) -> NDArray[np.float64]:
    """The same angles, radians, within -pi..pi.  # (...)"""
    return (np.asarray(angle) + np.pi) % (2.0 * np.pi) - np.pi


@numba.njit(cache=True, nogil=True)
def wrapped_angle(angle: float) -> float:
    """``wrapped`` for one angle in compiled loops; angles already there stay as they are to the last bit."""
    return angle - 2.0 * math.pi * math.floor(angle / (2.0 * math.pi) + 0.5)
