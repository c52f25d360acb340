"""Changing a clip's frame rate."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.clip import Clip

COMMON_RATE = 30.0
MAX_FRAMES = 10_000_000


def resample(clip: Clip, fps: float = COMMON_RATE) -> Clip:
    """The clip at the times k / fps that are not after its last frame.

    Rotations go the shorter way round between neighbouring frames at even speed (slerp); root and translations go
    straight. A label is that of the frame at or before the time, contacts those of the nearest frame. Where a time
    falls on a frame, as all do when the rates have a whole ratio, that frame is taken as it is.

    Raises:
        InputError: for a rate that is not positive, or that would give more than ``MAX_FRAMES`` frames.
    """
    if clip.fps == fps:
        return clip
    if not (math.isfinite(fps) and fps > 0):
        raise InputError(f"{fps} frames a second, expected a positive number", clip.name)
    if clip.seconds * fps >= MAX_FRAMES:
        raise InputError(f"more than {MAX_FRAMES} frames at {fps:g} frames a second", clip.name)
    before, share = _places_between(clip.frame_count, clip.fps / fps)
    return replace(
        clip,
        fps=float(fps),
        root_position=_straight(clip.root_position, before, share),
        rotations=_slerp(clip.rotations, before, share),
        contacts=clip.contacts[before + (share >= 0.5)],
        labels=clip.labels[before],
        translations=None if clip.translations is None else _straight(clip.translations, before, share),
    )


def _places_between(frames: int, step: float) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """For each new frame, the source frame at or before it and the share of the way to the next, 0 <= share < 1."""
    # Rates such as 0.1 are not exact in binary: times this near to a frame are meant to be on it.
    nearly = 1e-9
    count = math.floor((frames - 1) / step + nearly) + 1
    times = np.arange(count) * step
    before = np.floor(times + nearly * frames).astype(np.intp).clip(max=frames - 1)
    share = times - before
    return before, np.where(share <= nearly * frames, 0.0, share)


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
