"""Angles that mean the same."""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def wrapped(angle: ArrayLike) -> NDArray[np.float64]:
    """The same angles, radians, within -pi..pi.  # (...)"""
    return (np.asarray(angle) + np.pi) % (2.0 * np.pi) - np.pi
