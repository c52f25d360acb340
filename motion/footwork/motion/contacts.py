"""Which feet stand on the ground at which frame, from heights and speeds with hysteresis.

Source: conventions.md 3 (convention). A foot has two points, ankle and ball, and stands while either of them does: the
heel lands before the ball and leaves before it, and neither common source of capture has a heel joint.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import median_filter

from footwork.motion.clip import Clip
from footwork.motion.kinematics import central_velocity, clip_places

GROUND_PERCENTILE = 2.0
ON_HEIGHT, OFF_HEIGHT = 0.025, 0.04  # metres above the ground
ON_SPEED, OFF_SPEED = 0.20, 0.35  # metres a second
MEDIAN_SECONDS = 0.1
SHORTEST_RUN = 3  # frames


def detect_contacts(clip: Clip) -> NDArray[np.bool_]:
    """Which feet of ``clip`` stand on the ground.  # (F, feet)

    The ground is the 2nd percentile of each point's height over the clip, so that the floor of the capture need
    not be known. A skeleton without feet gives (F, 0).
    """
    points = clip_places(clip)[0][:, clip.skeleton.feet]  # (F, feet, 2, 3)
    return drop_short_runs(point_contacts(points, clip.fps).any(axis=-1), SHORTEST_RUN)


def point_contacts(points: ArrayLike, fps: float) -> NDArray[np.bool_]:
    """Which points touch the ground, each one by itself, after the median filter.  # (F, ..., 3) -> (F, ...)"""
    points = np.asarray(points, dtype=np.float64)
    heights = points[..., 1] - np.percentile(points[..., 1], GROUND_PERCENTILE, axis=0)
    speeds = np.linalg.norm(central_velocity(points, fps), axis=-1)
    on = (heights < ON_HEIGHT) & (speeds < ON_SPEED)
    off = (heights > OFF_HEIGHT) | (speeds > OFF_SPEED)
    window = round(MEDIAN_SECONDS * fps) | 1  # odd, so that the filter shifts nothing
    size = (window,) + (1,) * (on.ndim - 1)
    return median_filter(_latched(on, off).astype(np.uint8), size=size, mode="nearest").astype(bool)


def _latched(on: NDArray[np.bool_], off: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """True from each ``on`` to the next ``off``; off before the first of either.  # (F, ...)"""
    frames = np.arange(len(on)).reshape((-1,) + (1,) * (on.ndim - 1))
    last = np.maximum.accumulate(np.where(on | off, frames, 0), axis=0)
    return np.take_along_axis(on, last, axis=0)


def drop_short_runs(contacts: ArrayLike, shortest: int) -> NDArray[np.bool_]:
    """``contacts`` (F, feet) without the runs of contact shorter than ``shortest`` frames."""
    kept = np.array(contacts, dtype=bool)
    for foot in range(kept.shape[1]):
        edges = np.flatnonzero(np.diff(kept[:, foot], prepend=False, append=False))
        for start, end in edges.reshape(-1, 2):
            if end - start < shortest:
                kept[start:end, foot] = False
    return kept
