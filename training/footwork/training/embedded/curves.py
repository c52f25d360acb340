"""Smooth curves of time that the generator is made of: keys, smoothing windows, envelopes."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import BPoly, PchipInterpolator
from scipy.ndimage import convolve1d, minimum_filter1d

Keys = Sequence[tuple[float, float]]


def ease(share: ArrayLike) -> NDArray[np.float64]:
    """0 to 1 with a level start and end, for ``share`` from 0 to 1 (clipped)."""
    u = np.clip(np.asarray(share, dtype=np.float64), 0.0, 1.0)
    return u * u * (3.0 - 2.0 * u)


def hump(share: ArrayLike, rise: float, fall: float) -> NDArray[np.float64]:
    """A hump of height 1 over shares 0..1: u^rise (1-u)^fall, so its top lies at rise / (rise + fall)."""
    u = np.clip(np.asarray(share, dtype=np.float64), 0.0, 1.0)
    top = rise / (rise + fall)
    return (u / top) ** rise * ((1.0 - u) / (1.0 - top)) ** fall


def keyed(keys: Keys, at: NDArray[np.float64]) -> NDArray[np.float64]:
    """A curve through (time, value) keys that never overshoots one, level before the first and after the last."""
    times = np.array([time for time, _ in keys])
    values = np.array([value for _, value in keys])
    if len(keys) == 1:
        return np.full_like(at, values[0])
    return PchipInterpolator(times, values)(np.clip(at, times[0], times[-1]))


def smoothed(values: NDArray[np.float64], seconds: float, rate: float) -> NDArray[np.float64]:
    """Moving average along the first axis under a raised cosine that is ``seconds`` wide."""
    return convolve1d(values, _window(seconds, rate), axis=0, mode="nearest")


def lower_envelope(values: NDArray[np.float64], seconds: float, rate: float) -> NDArray[np.float64]:
    """A smooth curve that lies on or below ``values`` (F,) everywhere.

    Each sample is the average of minima over windows that all hold it, so it cannot exceed it.
    """
    eroded = minimum_filter1d(values, len(_window(seconds, rate)), mode="nearest")
    return smoothed(eroded, seconds, rate)


def quintic(
    start: tuple[float, float, float, float], end: tuple[float, float, float, float], at: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The fifth-degree curve from (time, value, speed, acceleration) ``start`` to ``end``."""
    return BPoly.from_derivatives([start[0], end[0]], [list(start[1:]), list(end[1:])])(at)


def _window(seconds: float, rate: float) -> NDArray[np.float64]:
    half = max(1, round(0.5 * seconds * rate))
    window = 0.5 + 0.5 * np.cos(np.pi * np.arange(-half, half + 1) / (half + 1))
    return window / window.sum()
