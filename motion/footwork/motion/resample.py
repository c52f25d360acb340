"""Changing a clip's frame rate."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.clip import Clip

COMMON_RATE = 30.0
MAX_FRAMES = 1_000_000  # nine hours at 30 Hz
# Ratios of rates are not exact in binary: a time this near to a frame is meant to be on it.
_NEARLY = 1e-9


def resample(clip: Clip, fps: float = COMMON_RATE, through: int = 0) -> Clip:
    """The clip at even times that meet the source frame ``through``, none before its first frame or after its last.

    Rotations go the shorter way round between neighbouring frames at even speed (slerp); root and translations go
    straight. A label is that of the frame at or before the time, contacts those of the nearest frame. Where a time
    falls on a frame, as all do when the rates have a whole ratio, that frame is taken as it is.

    Args:
        clip: the motion.
        fps: the new rate.
        through: a source frame that is kept; it becomes frame ``whole_steps(through, clip.fps, fps)``.

    Raises:
        InputError: for a rate that is not positive, or that would give more than ``MAX_FRAMES`` frames.
    """
    if clip.fps == fps:
        return clip
    if not (math.isfinite(fps) and fps > 0):
        raise InputError(f"{fps} frames a second, expected a positive number", clip.name)
    if clip.seconds * fps >= MAX_FRAMES:
        raise InputError(f"more than {MAX_FRAMES} frames at {fps:g} frames a second", clip.name)
    before, share = _places_between(clip, fps, through)
    return replace(
        clip,
        fps=float(fps),
        root_position=_straight(clip.root_position, before, share),
        rotations=_slerp(clip.rotations, before, share),
        contacts=clip.contacts[before + (share >= 0.5)],
        labels=clip.labels[before],
        translations=None if clip.translations is None else _straight(clip.translations, before, share),
    )


def whole_steps(frames: int, from_fps: float, to_fps: float) -> int:
    """How many whole frames at ``to_fps`` fit into ``frames`` frames at ``from_fps``."""
    return math.floor(frames * to_fps / from_fps + _NEARLY)


def _places_between(clip: Clip, fps: float, through: int) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """For each new frame, the source frame at or before it and the share of the way to the next, 0 <= share < 1."""
    last = clip.frame_count - 1
    steps = np.arange(-whole_steps(through, clip.fps, fps), whole_steps(last - through, clip.fps, fps) + 1)
    times = through + steps * (clip.fps / fps)
    near = np.rint(times)
    on_frame = np.abs(times - near) < _NEARLY * (1 + np.abs(steps))
    before = np.where(on_frame, near, np.floor(times)).astype(np.intp)
    return before, np.where(on_frame, 0.0, times - before)


def _straight(values: NDArray[np.float64], before: NDArray[np.intp], share: NDArray[np.float64]) -> NDArray[np.float64]:
    after = np.minimum(before + 1, len(values) - 1)
    weight = share.reshape(-1, *[1] * (values.ndim - 1))
    return values[before] + weight * (values[after] - values[before])


def _slerp(values: NDArray[np.float64], before: NDArray[np.intp], share: NDArray[np.float64]) -> NDArray[np.float64]:
    result = values[before]
    between = np.flatnonzero(share)
    if between.size:
        first = before[between]
        result[between] = quaternion.slerp(values[first], values[first + 1], share[between, None])
    return result
