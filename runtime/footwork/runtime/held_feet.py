"""The poses that are shown, with their feet held: what foot locks add, and no foot under the floor.

Legs are bent by two-bone inverse kinematics; where one would have to be straighter than its motion has it, the hips
come down. The state of the locks is ``foot_lock``'s.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.runtime.foot_lock import RELEASE_HALFLIFE, STEP_TICKS, between_yaws, sole_of
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.leg_kernels import bent_knee, conjugate, dot, less, plus
from footwork.runtime.rotation_kernels import multiply, planar, rotate, turned

_STRAIGHTEST = 0.995
"""The share of its length that a held leg may span, or what its motion spans where that is more."""
_FULLY = 0.9995  # the share that any leg may span
STEP_HEIGHT = 0.11
"""How far a foot is lifted half-way through a step, metres: above ``foot_lock.LOW`` but for its first and last tick."""
DEEPEST = 0.06
"""How far the hips come down at most, metres."""


@numba.njit(cache=True, nogil=True)
def hold_feet(
    slots: NDArray,
    fraction: float,
    legs: NDArray,
    bones: NDArray,
    spans: NDArray,
    floor: float,
    locked: NDArray,
    anchor: NDArray,
    slip: NDArray,
    stride: NDArray,
    shown_root: NDArray,
    shown_rotations: NDArray,
) -> None:
    """Bring the feet of shown poses to where they are held, in place.

    Args:
        slots: which rows.  # (n,)
        fraction: how much of the tick has passed, 0..1.
        legs: ``foot_lock.legs_of`` the body.  # (feet, 4)
        bones: its rest offsets.  # (J, 3)
        spans: lengths of thigh and shank.  # (feet, 2)
        floor: no ball goes lower, metres.
        locked: which feet stay where they are.  # (C, feet)
        anchor: where: ball x and z in the world, sine and cosine of the foot's yaw.  # (C, feet, 4)
        slip: of feet not locked, offset and its velocity, as the tick begins.  # (C, feet, 2, 3)
        stride: how many ticks are left of each foot's step, as the tick begins.  # (C, feet)
        shown_root: joint 0 in the world, m.  # (C, 3) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (C, J, 4) float32
    """
    a, b, _, _ = decay_weights(fraction * TICK, RELEASE_HALFLIFE)
    goals, moved = np.empty((legs.shape[0], 5)), np.empty(legs.shape[0], dtype=np.bool_)
    for who in slots:
        root, rotations, drop = shown_root[who], shown_rotations[who], 0.0
        for foot in range(legs.shape[0]):
            pose = _leg_pose(legs[foot], bones, root, rotations)
            lift = _lift(stride[who, foot], fraction)
            up = max(floor - pose[3][1], 0.0) + lift
            change = _correction(pose, locked[who, foot], anchor[who, foot], slip[who, foot], a, b, up)
            x, z, sine, cosine, up = change
            moved[foot] = x != 0.0 or z != 0.0 or sine != 0.0 or up != 0.0
            if moved[foot]:
                ankle = _ankle_goal(pose, change)
                # as if it were not lifted: the hips rise as the foot comes nearer, not at once
                level = ankle[0], ankle[1] - lift, ankle[2]
                drop = max(drop, _needed_drop(pose, level, _longest(spans[foot], pose)))
                _put(goals, foot, (ankle[0], ankle[1], ankle[2], sine, cosine))
            else:
                _put(goals, foot, (pose[2][0], pose[2][1], pose[2][2], 0.0, 1.0))
        drop = min(drop, DEEPEST)
        root[1] -= drop
        for foot in range(legs.shape[0]):
            if moved[foot] or drop > 0.0:
                _bend_leg(legs[foot], bones, spans[foot], goals[foot], root, rotations)


@numba.njit(cache=True, nogil=True)
def _quaternion(rotations, joint):
    return (
        float(rotations[joint, 0]),
        float(rotations[joint, 1]),
        float(rotations[joint, 2]),
        float(rotations[joint, 3]),
    )


@numba.njit(cache=True, nogil=True)
def _bone(bones, joint):
    return bones[joint, 0], bones[joint, 1], bones[joint, 2]


@numba.njit(cache=True, nogil=True)
def _leg_pose(leg, bones, root, rotations):
    """Places of hip, knee, ankle and ball and rotations of thigh, shank and foot, all in the world."""
    turn = _quaternion(rotations, 0)
    hip = plus((float(root[0]), float(root[1]), float(root[2])), rotate(turn, _bone(bones, leg[0])))
    thigh = multiply(turn, _quaternion(rotations, leg[0]))
    knee = plus(hip, rotate(thigh, _bone(bones, leg[1])))
    shank = multiply(thigh, _quaternion(rotations, leg[1]))
    ankle = plus(knee, rotate(shank, _bone(bones, leg[2])))
    foot = multiply(shank, _quaternion(rotations, leg[2]))
    return hip, knee, ankle, plus(ankle, rotate(foot, _bone(bones, leg[3]))), thigh, shank, foot


@numba.njit(cache=True, nogil=True)
def _lift(ticks_left, fraction):
    """How far a foot is lifted in its step."""
    if ticks_left == 0:
        return 0.0
    done = (STEP_TICKS - ticks_left + fraction) / STEP_TICKS
    return 16.0 * STEP_HEIGHT * (done * (1.0 - done)) ** 2


@numba.njit(cache=True, nogil=True)
def _correction(pose, is_locked, anchor, slip, a, b, up):
    """How far the ball shall move (x, z), the foot turn (sine, cosine), and the ball rise."""
    if is_locked:
        x, z, sine, cosine = sole_of(pose[2], pose[3])
        sine, cosine = between_yaws(anchor[2], anchor[3], sine, cosine)
        return anchor[0] - x, anchor[1] - z, sine, cosine, up
    yaw = a * slip[0, 2] + b * slip[1, 2]
    sine, cosine = (math.sin(yaw), math.cos(yaw)) if yaw != 0.0 else (0.0, 1.0)
    return a * slip[0, 0] + b * slip[1, 0], a * slip[0, 1] + b * slip[1, 1], sine, cosine, up


@numba.njit(cache=True, nogil=True)
def _ankle_goal(pose, change):
    """Where the ankle goes when the ball is moved and the foot turned about it."""
    x, z, sine, cosine, up = change
    reach = turned(cosine, sine, less(pose[2], pose[3]))
    return plus(plus(pose[3], (x, up, z)), reach)


@numba.njit(cache=True, nogil=True)
def _longest(span, pose):
    """How far from its hip the ankle of a held leg may be."""
    whole, way = span[0] + span[1], less(pose[2], pose[0])
    return min(max(_STRAIGHTEST * whole, math.sqrt(dot(way, way))), _FULLY * whole)


@numba.njit(cache=True, nogil=True)
def _needed_drop(pose, goal, longest):
    """How far the hip must come down for the ankle to reach its goal; DEEPEST where that does not help."""
    x, y, z = less(pose[0], goal)
    left = longest * longest - x * x - z * z
    return max(y - math.sqrt(left), 0.0) if left > 0.0 else DEEPEST


@numba.njit(cache=True, nogil=True)
def _bend_leg(leg, bones, span, goal, root, rotations):
    """Bring an ankle to its goal (x, y, z) and turn its foot (sine, cosine), in place."""
    pose = _leg_pose(leg, bones, root, rotations)
    hip, knee, ankle, _, thigh, shank, sole = pose
    target = goal[0], goal[1], goal[2]
    before_thigh, before_shank = bent_knee(hip, knee, ankle, thigh, target, span, _longest(span, pose))
    thigh, shank = multiply(before_thigh, thigh), multiply(before_shank, shank)
    half = 1.0 / math.sqrt(goal[3] * goal[3] + (1.0 + goal[4]) * (1.0 + goal[4]))
    sole = planar(sole, (1.0 + goal[4]) * half, goal[3] * half)
    _put(rotations, leg[0], multiply(conjugate(_quaternion(rotations, 0)), thigh))
    _put(rotations, leg[1], multiply(conjugate(thigh), shank))
    _put(rotations, leg[2], multiply(conjugate(shank), sole))


@numba.njit(cache=True, nogil=True)
def _put(rows, row, numbers):
    # one by one: the message that Numba has ready for rows of another length takes seconds to compile
    for k in range(len(numbers)):
        rows[row, k] = numbers[k]
