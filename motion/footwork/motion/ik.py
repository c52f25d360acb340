"""Two-bone limb inverse kinematics in closed form: put a foot or a hand at a place by turning two bones.

The triangle of upper bone, lower bone and reach fixes the bend by the law of cosines; the pole fixes its plane.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion
from footwork.motion.kinematics import forward, local_rotations
from footwork.motion.skeleton import Skeleton

# A limb bent less than this share of its length has no plane of its own: measured knees flicker about straight.
_STRAIGHT = 0.01


class Limb(NamedTuple):
    """Joint indices of a limb, and where its middle joint points when it bends from straight.

    ``bend`` is a direction in the upper joint's frame: it decides only where the current bend cannot.
    """

    upper: int
    lower: int
    tip: int
    bend: tuple[float, float, float] = (0.0, 0.0, 1.0)


def leg(skeleton: Skeleton, side: str) -> Limb:
    """The leg of the common body on ``side``, left or right: its knee bends forward."""
    thigh, shank, foot = skeleton.indices([f"{side}_thigh", f"{side}_shank", f"{side}_foot"]).tolist()
    return Limb(thigh, shank, foot, (0.0, 0.0, 1.0))


def arm(skeleton: Skeleton, side: str) -> Limb:
    """The arm of the common body on ``side``, left or right: its elbow bends back."""
    upper, lower, hand = skeleton.indices([f"{side}_upper_arm", f"{side}_forearm", f"{side}_hand"]).tolist()
    return Limb(upper, lower, hand, (0.0, 0.0, -1.0))


def reach(
    places: ArrayLike,
    turns: ArrayLike,
    limb: Limb,
    target: ArrayLike,
    pole: ArrayLike | None = None,
    softness: float = 0.0,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """World rotations (..., 4) of the upper and lower bone that bring the limb's tip to ``target``.

    Bones keep their lengths and their twist about the bending plane. A target out of reach is approached along
    its own direction. Source: convention (law of cosines).

    Args:
        places: world places of all joints, metres.  # (..., J, 3)
        turns: world rotations of all joints.  # (..., J, 4)
        limb: the limb.
        target: where its tip shall be, metres.  # (..., 3)
        pole: direction in which the middle joint shall point, None to keep the present bending plane.  # (..., 3)
        softness: share of the limb's length, below full extension, over which the reach slows so that the knee
            straightens smoothly; targets nearer than that are met exactly. 0 clamps hard.
    """
    places, turns = np.asarray(places, dtype=np.float64), np.asarray(turns, dtype=np.float64)
    root, middle, tip = (places[..., joint, :] for joint in limb[:3])
    upper_turn, lower_turn = turns[..., limb.upper, :], turns[..., limb.lower, :]
    along = _direction(tip - root, middle - root)
    own = _own_pole(middle - root, along, quaternion.rotate(upper_turn, limb.bend))
    goal = np.asarray(target, dtype=np.float64) - root
    new_along = _direction(goal, along)
    new_pole = own if pole is None else np.broadcast_to(np.asarray(pole, dtype=np.float64), own.shape)
    normal, new_normal = _normal(along, own), _normal(new_along, new_pole, spare=own)

    upper, lower = _length(middle - root), _length(tip - middle)
    distance = _reachable(_length(goal), upper, lower, softness)
    new_middle = _elbow(upper, lower, distance, new_along, np.cross(new_normal, new_along))
    turned_upper = quaternion.multiply(_between_frames(middle - root, normal, new_middle, new_normal), upper_turn)
    new_lower = distance * new_along - new_middle
    turned_lower = quaternion.multiply(_between_frames(tip - middle, normal, new_lower, new_normal), lower_turn)
    return turned_upper, turned_lower


def place_limb(
    skeleton: Skeleton,
    root_position: ArrayLike,
    rotations: ArrayLike,
    limb: Limb,
    target: ArrayLike,
    pole: ArrayLike | None = None,
    softness: float = 0.0,
) -> NDArray[np.float64]:
    """Local rotations (..., J, 4) with the limb's tip at ``target``; the tip keeps its rotation in the world.

    Args:
        skeleton: the body.
        root_position: place of joint 0 in the world, metres.  # (..., 3)
        rotations: local rotations.  # (..., J, 4)
        limb: the limb.
        target: where its tip shall be, metres.  # (..., 3)
        pole: as in ``reach``.  # (..., 3)
        softness: as in ``reach``.
    """
    places, turns = forward(skeleton, root_position, rotations)
    turns[..., limb.upper, :], turns[..., limb.lower, :] = reach(places, turns, limb, target, pole, softness)
    placed = np.array(rotations, dtype=np.float64)
    local = local_rotations(skeleton, turns)
    joints = list(limb[:3])
    placed[..., joints, :] = local[..., joints, :]
    return placed


def _length(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.linalg.norm(vector, axis=-1, keepdims=True)


def _direction(vector: NDArray[np.float64], spare: NDArray[np.float64]) -> NDArray[np.float64]:
    """``vector`` at length one, or ``spare`` at length one where it is zero."""
    return quaternion.normalise(np.where(_length(vector) > 1e-12, vector, spare))


def _across(vector: NDArray[np.float64], along: NDArray[np.float64]) -> NDArray[np.float64]:
    """The part of ``vector`` across the unit vector ``along``."""
    return vector - np.sum(vector * along, axis=-1, keepdims=True) * along


def _own_pole(
    middle: NDArray[np.float64], along: NDArray[np.float64], bend: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Where the middle joint points now, leaning to ``bend`` as the limb comes to be straight."""
    offset = _across(middle, along)
    straight = _STRAIGHT * _length(middle)
    return offset + np.clip(straight - _length(offset), 0.0, None) * bend


def _normal(
    along: NDArray[np.float64], pole: NDArray[np.float64], spare: NDArray[np.float64] | None = None
) -> NDArray[np.float64]:
    """The unit normal of the bending plane, about which the limb folds.

    A pole that lies along the limb gives no plane: then ``spare`` serves, then any direction across.
    """
    normal = np.cross(along, pole)
    anything = np.where(np.abs(along[..., :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    backup = np.cross(along, anything)
    if spare is not None:
        second = np.cross(along, spare)
        backup = np.where(_length(second) > 1e-9, second, backup)
    return quaternion.normalise(np.where(_length(normal) > 1e-9 * _length(pole), normal, backup))


def _reachable(
    distance: NDArray[np.float64], upper: NDArray[np.float64], lower: NDArray[np.float64], softness: float
) -> NDArray[np.float64]:
    """``distance`` brought within what the two bones can span."""
    span = upper + lower
    if softness > 0.0:
        room = softness * span
        over = np.clip(distance - (span - room), 0.0, None)
        # value and slope agree with the identity where the slowing begins
        distance = np.where(over > 0.0, span - room * np.exp(-over / room), distance)
    return np.clip(distance, np.abs(upper - lower), span)


def _elbow(
    upper: NDArray[np.float64],
    lower: NDArray[np.float64],
    distance: NDArray[np.float64],
    along: NDArray[np.float64],
    outward: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The middle joint from the root: the corner of the triangle, on the side of ``outward``."""
    safe = np.maximum(distance, 1e-12)
    foot_point = (upper**2 - lower**2 + distance**2) / (2.0 * safe)
    foot_point = np.clip(foot_point, -upper, upper)
    return foot_point * along + np.sqrt(upper**2 - foot_point**2) * outward


def _between_frames(
    bone: NDArray[np.float64],
    normal: NDArray[np.float64],
    new_bone: NDArray[np.float64],
    new_normal: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The rotation that takes ``bone`` to ``new_bone`` and the bending plane's normal with it."""
    swing = quaternion.between(bone, new_bone)
    axis = quaternion.normalise(new_bone)
    start = _across(quaternion.rotate(swing, normal), axis)
    sine = np.sum(np.cross(start, new_normal) * axis, axis=-1, keepdims=True)
    cosine = np.sum(start * new_normal, axis=-1, keepdims=True)
    twist = quaternion.from_rotation_vector(np.arctan2(sine, cosine) * axis)
    return quaternion.multiply(twist, swing)
