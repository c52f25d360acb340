"""The poses that are shown, with their feet held: what foot locks add, and no foot under the floor.

Legs are bent by two-bone inverse kinematics; where one would have to be straighter than its motion has it, the hips
come down. The state of the locks is ``foot_lock``'s.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.runtime.foot_lock import RELEASE_HALFLIFE
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.leg_kernels import bent_knee, conjugate, dot, less, plus
from footwork.runtime.moving import within_half_turn
from footwork.runtime.rotation_kernels import multiply, planar, rotate, turned

_STRAIGHTEST = 0.995
"""The share of its length that a held leg may span, or what its motion spans where that is more."""
_FULLY = 0.9995  # the share that any leg may span
DEEPEST = 0.06
"""How far the hips come down at most, metres."""


@numba.njit(cache=True, nogil=True)
def hold_feet(
    active: NDArray,
    fraction: float,
    legs: NDArray,
    bones: NDArray,
    floor: float,
    locked: NDArray,
    anchor: NDArray,
    slip: NDArray,
    shown_root: NDArray,
    shown_rotations: NDArray,
) -> None:
    """Bring the feet of all shown poses to where they are held, in place.

    Args:
        active: which rows are characters.  # (C,)
        fraction: how much of the tick has passed, 0..1.
        legs: ``foot_lock.legs_of`` the body.  # (feet, 4)
        bones: its rest offsets.  # (J, 3)
        floor: no ball goes lower, metres.
        locked: which feet stay where they are.  # (C, feet)
        anchor: where: ball x, z and yaw in the world.  # (C, feet, 3)
        slip: of feet not locked, offset and its velocity, as the tick begins.  # (C, feet, 2, 3)
        shown_root: joint 0 in the world, m.  # (C, 3) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (C, J, 4) float32
    """
    a, b, _, _ = decay_weights(fraction * TICK, RELEASE_HALFLIFE)
    goals, turns = np.empty((legs.shape[0], 3)), np.empty(legs.shape[0])
    for who in range(active.shape[0]):
        if not active[who]:
            continue
        root, rotations = shown_root[who], shown_rotations[who]
        moved, drop = False, 0.0
        for foot in range(legs.shape[0]):
            own, rest = anchor[who, foot], slip[who, foot]
            pose = _leg_pose(legs[foot], bones, root, rotations)
            x, z, yaw, up = _correction(pose, locked[who, foot], own, rest, a, b, floor)
            moved |= x != 0.0 or z != 0.0 or yaw != 0.0 or up != 0.0
            goal = _ankle_goal(pose, x, z, yaw, up)
            drop = max(drop, _needed_drop(pose, goal, _longest(bones, legs[foot], pose)))
            turns[foot] = yaw
            goals[foot, 0], goals[foot, 1], goals[foot, 2] = goal
        if moved:
            _bend_legs(legs, bones, goals, turns, min(drop, DEEPEST), root, rotations)


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
def _correction(pose, is_locked, anchor, slip, a, b, floor):
    """How far the ball shall move (x, z), the foot turn, and the ball rise."""
    ankle, ball = pose[2], pose[3]
    up = max(floor - ball[1], 0.0)
    if is_locked:
        yaw = math.atan2(ball[0] - ankle[0], ball[2] - ankle[2])
        return anchor[0] - ball[0], anchor[1] - ball[2], within_half_turn(anchor[2] - yaw), up
    x, z, yaw = a * slip[0, 0] + b * slip[1, 0], a * slip[0, 1] + b * slip[1, 1], a * slip[0, 2] + b * slip[1, 2]
    return x, z, yaw, up


@numba.njit(cache=True, nogil=True)
def _ankle_goal(pose, x, z, yaw, up):
    """Where the ankle goes when the ball is moved and the foot turned about it."""
    ball = pose[3]
    reach = turned(math.cos(yaw), math.sin(yaw), less(pose[2], ball))
    return ball[0] + x + reach[0], ball[1] + up + reach[1], ball[2] + z + reach[2]


@numba.njit(cache=True, nogil=True)
def _longest(bones, leg, pose):
    """How far from its hip the ankle of a held leg may be."""
    shank, foot = _bone(bones, leg[1]), _bone(bones, leg[2])
    whole = math.sqrt(dot(shank, shank)) + math.sqrt(dot(foot, foot))
    way = less(pose[2], pose[0])
    return min(max(_STRAIGHTEST * whole, math.sqrt(dot(way, way))), _FULLY * whole)


@numba.njit(cache=True, nogil=True)
def _needed_drop(pose, goal, longest):
    """How far the hip must come down for the ankle to reach its goal; DEEPEST where that does not help."""
    x, y, z = less(pose[0], goal)
    left = longest * longest - x * x - z * z
    return max(y - math.sqrt(left), 0.0) if left > 0.0 else DEEPEST


@numba.njit(cache=True, nogil=True)
def _bend_legs(legs, bones, goals, turns, drop, root, rotations):
    """Lower the hips and bring every ankle to its goal, its foot turned, in place."""
    root[1] -= drop
    pelvis = _quaternion(rotations, 0)
    for foot in range(legs.shape[0]):
        leg = legs[foot]
        hip, knee, ankle, ball, thigh, shank, sole = _leg_pose(leg, bones, root, rotations)
        goal = goals[foot, 0], goals[foot, 1], goals[foot, 2]
        longest = _longest(bones, leg, (hip, knee, ankle, ball, thigh, shank, sole))
        before_thigh, before_shank = bent_knee(hip, knee, ankle, thigh, goal, longest)
        thigh, new_shank = multiply(before_thigh, thigh), multiply(before_shank, shank)
        sole = planar(sole, math.cos(0.5 * turns[foot]), math.sin(0.5 * turns[foot]))
        _put(rotations, leg[0], multiply(conjugate(pelvis), thigh))
        _put(rotations, leg[1], multiply(conjugate(thigh), new_shank))
        _put(rotations, leg[2], multiply(conjugate(new_shank), sole))


@numba.njit(cache=True, nogil=True)
def _put(rotations, joint, q):
    for k in range(4):
        rotations[joint, k] = q[k]
