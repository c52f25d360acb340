"""The pelvis: over the feet that carry it, as high as the legs allow, turned by the stride."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion import ik, quaternion
from footwork.motion.skeleton import Skeleton
from footwork.training.embedded.curves import lower_envelope, smoothed
from footwork.training.embedded.feet import Feet
from footwork.training.embedded.footsteps import FPS, Plan
from footwork.training.embedded.gesture import Gesture

_STRETCH = 0.993  # a leg on the ground is never straighter than this share of its length (14 degrees at the knee)
_BEFORE_LANDING = 1  # frames for which the same holds before a landing
_SWAY = 0.38  # share of the way to the carrying foot that the pelvis goes
_LIST = np.radians(3.5)  # the pelvis drops on the side of the swinging leg
_STRIDE_YAW = 0.14  # radians of pelvic rotation per metre between the feet
_BANK_ARM = 0.5  # metres by which the pelvis goes into a turn, for a bank of 45 degrees
_GRAVITY = 9.81


@dataclass(frozen=True, eq=False)
class Pelvis:
    """The pelvis at every frame, with what trunk and arms follow.

    Args:
        place: of joint 0, metres.  # (F, 3)
        turn: world rotation of joint 0.  # (F, 4)
        yaw: of the pelvis, radians.  # (F,)
        split: how far the left foot is before the right one, metres.  # (F,)
        list_: roll of the pelvis, left side up positive, radians.  # (F,)
        bank: lean of the whole body into a turn, left side up positive, radians.  # (F,)
    """

    place: NDArray[np.float64]
    turn: NDArray[np.float64]
    yaw: NDArray[np.float64]
    split: NDArray[np.float64]
    list_: NDArray[np.float64]
    bank: NDArray[np.float64]


def pelvis_of(plan: Plan, feet: Feet, body: Skeleton, gesture: Gesture) -> Pelvis:
    """The pelvis of a plan whose feet are known, before flights are made to obey gravity."""
    times = plan.times
    load = _load(plan)
    ahead, left = directions(plan.heading)
    split = smoothed(np.sum((feet.ankles[:, 0] - feet.ankles[:, 1]) * ahead, axis=-1), 0.1, FPS)
    turn_rate = np.gradient(plan.heading, 1.0 / FPS)
    bank = -0.6 * np.arctan(plan.speed[:, 0] * turn_rate / _GRAVITY)
    list_ = _LIST * (load[:, 0] - load[:, 1]) * np.clip(np.abs(plan.speed).sum(axis=-1), 0.0, 1.0)
    yaw = plan.heading - _STRIDE_YAW * split + gesture.at("pelvis_yaw", times)
    pitch = 0.04 + 0.09 * plan.run + gesture.at("pelvis_pitch", times)
    turn = turned(yaw, pitch, list_ + 0.5 * bank)

    support = np.einsum("fs,fsx->fx", load, feet.ankles)
    side = _SWAY * (1.0 - 0.6 * plan.run) * np.sum((support - _on_ground(plan.path)) * left, axis=-1)
    side = smoothed(side, 0.2, FPS) + _BANK_ARM * np.tan(-bank)
    place = _on_ground(plan.path) + (side + gesture.at("side", times))[:, None] * left
    place = place - gesture.at("back", times)[:, None] * ahead
    place[:, 1] = _height(plan, feet, body, place, turn, gesture.at("drop", times))
    return Pelvis(place, turn, yaw, split, list_, bank)


def directions(heading: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Unit vectors ahead and to the left of ``heading`` (F,), both (F, 3)."""
    turn = quaternion.from_yaw(heading)
    return quaternion.rotate(turn, np.array([0.0, 0.0, 1.0])), quaternion.rotate(turn, np.array([1.0, 0.0, 0.0]))


def turned(yaw: NDArray[np.float64], pitch: NDArray[np.float64], roll: NDArray[np.float64]) -> NDArray[np.float64]:
    """Yaw after pitch (forward positive) after roll (left side up positive).  # (F, 4)"""
    pitched = quaternion.from_rotation_vector(pitch[:, None] * np.array([1.0, 0.0, 0.0]))
    rolled = quaternion.from_rotation_vector(roll[:, None] * np.array([0.0, 0.0, 1.0]))
    return quaternion.multiply(quaternion.from_yaw(yaw), quaternion.multiply(pitched, rolled))


def _on_ground(path: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([path[:, 0], np.zeros(len(path)), path[:, 1]], axis=-1)


def _load(plan: Plan) -> NDArray[np.float64]:
    """The share of the weight on each foot, passing smoothly from one to the other.  # (F, 2)"""
    standing = plan.standing() + 1e-3
    return smoothed(standing / standing.sum(axis=-1, keepdims=True), 0.3, FPS)


def _height(
    plan: Plan,
    feet: Feet,
    body: Skeleton,
    place: NDArray[np.float64],
    turn: NDArray[np.float64],
    drop: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Height of joint 0: the highest smooth curve that keeps both legs within reach of their ankles."""
    bound = _bound(plan)
    highest = np.full((len(place), 2), np.inf)
    for foot, limb in enumerate((ik.leg(body, "left"), ik.leg(body, "right"))):
        hip = place + quaternion.rotate(turn, body.offsets[limb.upper])
        away = np.linalg.norm((hip - feet.ankles[:, foot])[:, [0, 2]], axis=-1)
        reach = np.sqrt(np.clip((_STRETCH * _length(body, limb)) ** 2 - away**2, 0.3**2, None))
        height = feet.ankles[:, foot, 1] + reach - (hip[:, 1] - place[:, 1])
        highest[:, foot] = np.where(bound[:, foot], height, np.inf)
    leg = ik.leg(body, "left")
    tall = _STRETCH * _length(body, leg) + feet.ankles[0, 0, 1] - body.offsets[leg.upper, 1]
    return lower_envelope(np.minimum(highest.min(axis=-1), tall - drop), 0.2, FPS)


def _length(body: Skeleton, limb: ik.Limb) -> float:
    return float(np.linalg.norm(body.offsets[[limb.lower, limb.tip]], axis=-1).sum())


def _bound(plan: Plan) -> NDArray[np.bool_]:
    """The feet that stand or are about to.  # (F, 2)"""
    bound = plan.standing()
    for frames in range(1, _BEFORE_LANDING + 1):
        bound[:-frames] |= plan.standing()[frames:]
    return bound
