"""Straight lines through points, and slopes between logarithms: how things grow."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Line:
    """A least-squares line: its slope, its height at 0 and the share of the variance that it explains."""

    slope: float
    offset: float
    r2: float


def fitted(x: ArrayLike, y: ArrayLike) -> Line:
    """The least-squares line through points (at least two different x)."""
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    slope, offset = np.polyfit(x, y, 1)
    left = y - (slope * x + offset)
    spread = float(((y - y.mean()) ** 2).sum())
    return Line(float(slope), float(offset), 1.0 - float(left @ left) / spread if spread else 1.0)


def growth(x: ArrayLike, y: ArrayLike) -> float:
    """The exponent of y ~ x^p: the slope between the logarithms of positive numbers."""
    return fitted(np.log(np.asarray(x, dtype=np.float64)), np.log(np.asarray(y, dtype=np.float64))).slope
