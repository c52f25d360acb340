"""Where the feet are at every frame: still while they stand, rolling from heel to toe, swinging in between."""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.skeleton import Skeleton
from footwork.training.embedded.curves import ease, hump, keyed
from footwork.training.embedded.footsteps import Contact, Plan

SOLE = 0.02  # height of the ball's joint above the ground while the foot stands, metres
_HEEL = 0.05  # distance of the heel behind the ankle, metres
_ROLL = 0.10  # time from heel strike to flat foot, seconds


@dataclass(frozen=True, eq=False)
class Feet:
    """Both feet at every frame.

    Args:
        ankles: places of the ankles, metres.  # (F, 2, 3)
        turns: world rotations of the feet.  # (F, 2, 4)
        toes: local rotations of the toes.  # (F, 2, 4)
    """

    ankles: NDArray[np.float64]
    turns: NDArray[np.float64]
    toes: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FootTouches:
    """What a gesture adds to one foot: swivel about its ball, heel lift, and a way off its plan while it swings.

    Args:
        swivel: added yaw, radians.  # (F,)
        pitch: added pitch, toes up positive, radians.  # (F,)
        offset: added place in the heading's directions (left, up, ahead), metres.  # (F, 3)
    """

    swivel: NDArray[np.float64]
    pitch: NDArray[np.float64]
    offset: NDArray[np.float64]


def feet_of(plan: Plan, body: Skeleton, touches: tuple[FootTouches, FootTouches]) -> Feet:
    """The feet of a plan on ``body``."""
    sides = [_foot(plan, body, foot, touches[foot]) for foot in (0, 1)]
    ankles, turns, toes = (np.stack(parts, axis=1) for parts in zip(*sides, strict=True))
    return Feet(ankles, turns, toes)


def _foot(plan: Plan, body: Skeleton, foot: int, touch: FootTouches) -> tuple[NDArray, NDArray, NDArray]:
    contacts, times = plan.contacts[foot], plan.times
    pitch = keyed(_pitch_keys(contacts), times) + touch.pitch
    place, height, on_heel, toe_share = _flat(contacts, times, pitch)
    yaw = quaternion.from_yaw(place[:, 2] + touch.swivel)
    turn = quaternion.multiply(yaw, _pitched(pitch))

    ball = body.offsets[body.feet[foot, 1]]
    ankle_height = SOLE - ball[1]
    from_ball = quaternion.rotate(turn, -ball)
    heel = np.array([0.0, -SOLE, -ball[2] - _HEEL])
    from_heel = quaternion.rotate(yaw, heel) + quaternion.rotate(turn, np.array([0.0, ankle_height, _HEEL]))
    ground = np.stack([place[:, 0], SOLE + height, place[:, 1]], axis=-1)
    ankle = (
        ground
        + from_ball
        + on_heel[:, None] * (from_heel - from_ball)
        + quaternion.rotate(quaternion.from_yaw(plan.heading), touch.offset)
    )
    toes = _pitched(-np.minimum(pitch, 0.0) * toe_share)
    return ankle, turn, toes


def _pitched(pitch: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rotations that lift the toes by ``pitch``: about -x."""
    return quaternion.from_rotation_vector(pitch[:, None] * np.array([-1.0, 0.0, 0.0]))


def _pitch_keys(contacts: tuple[Contact, ...]) -> list[tuple[float, float]]:
    keys = _standing_keys(contacts[0])
    for before, after in itertools.pairwise(contacts):
        keys += _swinging_keys(before, after) + _standing_keys(after)
    return keys


def _standing_keys(contact: Contact) -> list[tuple[float, float]]:
    """From the strike to flat, and from flat to the push, about the ball."""
    length = contact.end - contact.start
    roll, peel = min(_ROLL, 0.3 * length), min(contact.next_gait.peel, 0.6 * length)
    flat = [(contact.start + roll, 0.0), (contact.end - peel, 0.0)]
    return [(contact.start, contact.strike), *flat, (contact.end, contact.push)]


def _swinging_keys(before: Contact, after: Contact) -> list[tuple[float, float]]:
    swing, gait = after.start - before.end, before.next_gait
    scale = before.push / gait.push if gait.push else 0.0
    shares = [(0.18, gait.trail * scale), (0.5, gait.middle * scale), (0.82, 0.85 * after.strike)]
    return [(before.end + share * swing, pitch) for share, pitch in shares]


def _flat(
    contacts: tuple[Contact, ...], times: NDArray[np.float64], pitch: NDArray[np.float64]
) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """The foot as if flat: x, z, yaw (F, 3), height (F,), share that turns about the heel (F,), toes' share (F,)."""
    place = np.tile([contacts[0].x, contacts[0].z, contacts[0].yaw], (len(times), 1))
    height, toe_share = np.zeros(len(times)), np.ones(len(times))
    on_heel = (pitch > 0.0).astype(np.float64)
    for before, after in itertools.pairwise(contacts):
        swing = (times > before.end) & (times < after.start)
        share = (times[swing] - before.end) / (after.start - before.end)
        start, end = np.array([before.x, before.z, before.yaw]), np.array([after.x, after.z, after.yaw])
        place[times > before.end] = end
        place[swing] = start + _advance(share, before.next_gait.arrive)[:, None] * (end - start)
        height[swing] = before.next_gait.rise * hump(share, *before.next_gait.arc)
        on_heel[swing] = ease(pitch[swing] / after.strike) if after.strike > 0.0 else 0.0
        toe_share[swing] = 1.0 - ease(2.0 * share)
    return place, height, on_heel, toe_share


def _advance(share: NDArray[np.float64], arrive: float) -> NDArray[np.float64]:
    """The share of the way that a swinging foot has made: from rest to ``arrive`` times its mean speed."""
    return share * share * ((3.0 - arrive) + (arrive - 2.0) * share)
