"""Segments: the longest stretches of a clip over which the same feet carry the body."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion.angle import wrapped
from footwork.motion.clip import Clip
from footwork.motion.contacts import GROUND_PERCENTILE, OFF_HEIGHT, SHORTEST_RUN
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.training.centre_of_mass import centre_of_mass
from footwork.training.nodes import FPS

GRAVITY = 9.81  # m/s^2
GRAVITY_TOLERANCE = 2.0  # m/s^2: a flight this near to g counts as ballistic
AIRBORNE = 0  # the signature of no foot
NO_SIGNATURE = -1


@dataclass(frozen=True, eq=False)
class Segments:
    """S segments, clip by clip in the order of time.

    Args:
        clip: the clip each is cut from.  # (S,)
        start: its first frame there.  # (S,)
        end: the frame after its last.  # (S,)
        signature: the feet that carry the body, bit f for foot f.  # (S,)
        ballistic: whether it is a flight whose centre of mass falls as gravity lets it.  # (S,)
        yaw_change: how far the body turns from its first to its last frame, radians.  # (S,)
    """

    clip: NDArray[np.intp]
    start: NDArray[np.intp]
    end: NDArray[np.intp]
    signature: NDArray[np.intp]
    ballistic: NDArray[np.bool_]
    yaw_change: NDArray[np.float64]

    @property
    def count(self) -> int:
        """The number of segments S."""
        return len(self.clip)

    @property
    def frames(self) -> NDArray[np.intp]:
        """Frames of each segment.  # (S,)"""
        return self.end - self.start

    @property
    def airborne(self) -> NDArray[np.bool_]:
        """Whether no foot carries the body.  # (S,)"""
        return self.signature == AIRBORNE

    def neighbour(self, step: int) -> NDArray[np.intp]:
        """Signature of the segment before (step -1) or after (1) each in its clip, NO_SIGNATURE at an end.  # (S,)"""
        at = np.arange(self.count) + step
        inside = np.clip(at, 0, max(self.count - 1, 0))
        there = (at == inside) & (self.clip[inside] == self.clip)
        return np.where(there, self.signature[inside], NO_SIGNATURE)


def segments_of(clips: Sequence[Clip]) -> Segments:
    """The segments of clips, maximal runs of one signature. Every frame lies in one."""
    parts = [_segments_of_clip(number, clip) for number, clip in enumerate(clips)]
    return Segments(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _segments_of_clip(number: int, clip: Clip) -> tuple[NDArray, ...]:
    places, turns = clip_places(clip)
    signature = settled(support_signature(clip.contacts, places[:, clip.skeleton.feet, 1]))
    cuts = np.flatnonzero(np.diff(signature)) + 1
    start, end = np.append(0, cuts), np.append(cuts, clip.frame_count)
    height = centre_of_mass(clip.skeleton, places, turns)[:, 1]
    falls = np.array([is_fall(height[a:b]) for a, b in zip(start, end, strict=True)])
    yaw = facing_yaw(clip.skeleton, places)
    own = signature[start]
    return np.full(len(start), number), start, end, own, falls & (own == AIRBORNE), wrapped(yaw[end - 1] - yaw[start])


def support_signature(contacts: ArrayLike, heights: ArrayLike) -> NDArray[np.intp]:
    """Which feet carry the body at each frame, bit f for foot f.  # (F, feet), (F, feet, points) -> (F,)

    Those in contact. At a frame without any, those with a point within OFF_HEIGHT of the ground: a running foot
    rolls on too fast for a contact (conventions.md 3), and the body is no projectile yet. The ground is that of the
    contacts, the 2nd percentile of each point's height. Source: convention.
    """
    contacts, heights = np.asarray(contacts, dtype=bool), np.asarray(heights, dtype=np.float64)
    ground = np.percentile(heights, GROUND_PERCENTILE, axis=0)
    low = (heights - ground < OFF_HEIGHT).any(axis=-1)
    carrying = np.where(contacts.any(axis=1, keepdims=True), contacts, low)
    return carrying @ (1 << np.arange(contacts.shape[1]))


def settled(signature: NDArray[np.intp]) -> NDArray[np.intp]:
    """``signature`` without runs under SHORTEST_RUN frames: the runs on either side share their frames.  # (F,) -> (F,)

    A walker's weight passes from foot to foot within a frame or two, which now shows as both feet, now as none, now
    not at all; as segments of their own such moments would keep two walks from being matched stride by stride.
    Source: convention.
    """
    cuts = np.flatnonzero(np.diff(signature)) + 1
    start, end = np.append(0, cuts), np.append(cuts, len(signature))
    long = end - start >= SHORTEST_RUN
    if not long.any():
        return signature
    start, end, own = start[long], end[long], signature[start[long]]
    # the halves of what lies between one long run's end and the next one's start
    middles = (end[:-1] + start[1:] + 1) // 2
    return np.repeat(own, np.diff(np.concatenate([[0], middles, [len(signature)]])))


def is_fall(height: NDArray[np.float64]) -> bool:
    """Whether heights at 30 Hz accelerate downwards at g within GRAVITY_TOLERANCE; False for under three."""
    if len(height) < 3:
        return False
    return abs(accelerations(height, np.array([len(height)]))[0] + GRAVITY) <= GRAVITY_TOLERANCE


def accelerations(values: NDArray[np.float64], counts: NDArray) -> NDArray[np.float64]:
    """Accelerations of stretches at 30 Hz laid end to end, each that of the parabola which fits it best.  # (C,)

    Args:
        values: of all stretches.  # (sum(counts),)
        counts: values of each; under three give NaN.  # (C,)
    """
    place = np.arange(len(values)) - np.repeat(np.cumsum(counts) - counts, counts)
    n = np.repeat(counts, counts)
    bow = (place - 0.5 * (n - 1)) ** 2 - (n * n - 1) / 12.0
    starts = np.cumsum(counts) - counts
    with np.errstate(invalid="ignore", divide="ignore"):
        curve = np.add.reduceat(bow * values, starts) / np.add.reduceat(bow * bow, starts)
    return np.where(counts >= 3, 2.0 * FPS**2 * curve, np.nan)
