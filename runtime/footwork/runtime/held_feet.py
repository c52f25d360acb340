"""The poses that are shown, with their feet held: what foot locks add, and no foot under the floor.

Legs are bent by two-bone inverse kinematics; where one would have to be straighter than its motion has it, the hips
come down. The state of the locks is ``foot_lock``'s.

Characters are worked on in tiles: what a leg needs is gathered one by one, then legs are bent side by side.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.runtime.foot_lock import RELEASE_HALFLIFE, STEP_TICKS
from footwork.runtime.foot_places import between_yaws, sole_of
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.leg_kernels import bent_knee, conjugate, dot, less, plus
from footwork.runtime.rotation_kernels import multiply, planar, rotate, turned
from footwork.runtime.tiles import TILE, load3, load4, store3, store4

_STRAIGHTEST = 0.995
"""The share of its length that a held leg may span, or what its motion spans where that is more."""
_FULLY = 0.9995  # the share that any leg may span
STEP_HEIGHT = 0.11
"""How far a foot is lifted half-way through a step, metres: above ``foot_lock.LOW`` but for its first and last tick."""
DEEPEST = 0.06
"""How far the hips come down at most, metres."""

# tiles of what is shown of bodies,
_ROOT, _PELVIS, _DROP, _BODY = 0, 3 * TILE, 7 * TILE, 8 * TILE
# of what is asked of legs: local rotations, whether a foot is locked, where to or else by how much, and how far up,
_THIGH, _SHANK, _SOLE, _LOCKED, _WHERE, _LIFT, _LEG = 0, 4 * TILE, 8 * TILE, 12 * TILE, 13 * TILE, 17 * TILE, 18 * TILE
# and of where legs are: bones and rotations in the world, where the ankle goes, the foot's turn, and whether it moves
_TO_HIP, _TO_KNEE, _TO_ANKLE, _TURNS, _GOAL, _YAW = 0, 3 * TILE, 6 * TILE, 9 * TILE, 21 * TILE, 24 * TILE
_MOVED, _POSE = 26 * TILE, 27 * TILE


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
    feet = legs.shape[0]
    body, asked = np.empty(_BODY), np.empty((feet, _LEG))
    posed = np.empty((feet, _POSE))
    for first in range(0, slots.shape[0], TILE):
        some = slots[first : first + TILE]
        count = some.shape[0]
        _gather_bodies(some, shown_root, shown_rotations, body)
        for foot in range(feet):
            _gather_legs(some, legs[foot], shown_rotations, asked[foot])
            _gather_locks(some, foot, fraction, locked, anchor, slip, stride, (a, b), asked[foot])
            _pose_legs(count, legs[foot], bones, spans[foot], floor, body, asked[foot], posed[foot])
        _drop(some, body, shown_root)
        for foot in range(feet):
            _bend_legs(count, spans[foot], body, posed[foot], asked[foot])
            _scatter_legs(some, legs[foot], body, posed[foot], asked[foot], shown_rotations)


@numba.njit(cache=True, nogil=True)
def _gather_bodies(slots, shown_root, shown_rotations, body):
    for k in range(slots.shape[0]):
        who = slots[k]
        for i in range(3):
            body[_ROOT + i * TILE + k] = shown_root[who, i]
        for i in range(4):
            body[_PELVIS + i * TILE + k] = shown_rotations[who, 0, i]
        body[_DROP + k] = 0.0


@numba.njit(cache=True, nogil=True)
def _gather_legs(slots, leg, shown_rotations, asked):
    thigh, shank, sole = leg[0], leg[1], leg[2]
    # whole rows are never cut out of an array here: each cut counts references, which takes longer than the copy
    for k in range(slots.shape[0]):
        who = slots[k]
        for i in range(4):
            asked[_THIGH + i * TILE + k] = shown_rotations[who, thigh, i]
            asked[_SHANK + i * TILE + k] = shown_rotations[who, shank, i]
            asked[_SOLE + i * TILE + k] = shown_rotations[who, sole, i]


@numba.njit(cache=True, nogil=True)
def _gather_locks(slots, foot, fraction, locked, anchor, slip, stride, weights, asked):
    for k in range(slots.shape[0]):
        who = slots[k]
        asked[_LIFT + k] = _lift(stride[who, foot], fraction)
        asked[_LOCKED + k] = 1.0 if locked[who, foot] else 0.0
        if locked[who, foot]:
            for i in range(4):
                asked[_WHERE + i * TILE + k] = anchor[who, foot, i]
        else:
            store4(asked, _WHERE, k, _slipped(slip, who, foot, weights))


@numba.njit(cache=True, nogil=True)
def _slipped(slip, who, foot, weights):
    """How far a foot that is not locked is off its motion: x, z, sine and cosine of the yaw."""
    a, b = weights
    x = a * slip[who, foot, 0, 0] + b * slip[who, foot, 1, 0]
    z = a * slip[who, foot, 0, 1] + b * slip[who, foot, 1, 1]
    yaw = a * slip[who, foot, 0, 2] + b * slip[who, foot, 1, 2]
    sine, cosine = (math.sin(yaw), math.cos(yaw)) if yaw != 0.0 else (0.0, 1.0)
    return x, z, sine, cosine


@numba.njit(cache=True, nogil=True)
def _lift(ticks_left, fraction):
    """How far a foot is lifted in its step."""
    if ticks_left == 0:
        return 0.0
    done = (STEP_TICKS - ticks_left + fraction) / STEP_TICKS
    return 16.0 * STEP_HEIGHT * (done * (1.0 - done)) ** 2


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _pose_legs(count, leg, bones, span, floor, body, asked, posed):
    """Where legs are and where they shall be; the hips' drop is raised to what they need."""
    to_hip, to_knee = _bone(bones, leg[0]), _bone(bones, leg[1])
    to_ankle, to_ball = _bone(bones, leg[2]), _bone(bones, leg[3])
    whole = span[0] + span[1]
    for k in range(min(count, TILE)):
        pelvis = load4(body, _PELVIS, k)
        hip_bone = rotate(pelvis, to_hip)
        thigh = multiply(pelvis, load4(asked, _THIGH, k))
        knee_bone = rotate(thigh, to_knee)
        shank = multiply(thigh, load4(asked, _SHANK, k))
        ankle_bone = rotate(shank, to_ankle)
        sole = multiply(shank, load4(asked, _SOLE, k))
        hip = plus(load3(body, _ROOT, k), hip_bone)
        ankle = plus(plus(hip, knee_bone), ankle_bone)
        ball = plus(ankle, rotate(sole, to_ball))
        lift = asked[_LIFT + k]
        up = max(floor - ball[1], 0.0) + lift
        where = load4(asked, _WHERE, k)
        x, z, sine, cosine = sole_of(ankle, ball)
        turn_sine, turn_cosine = between_yaws(where[2], where[3], sine, cosine)
        is_locked = asked[_LOCKED + k] != 0.0
        x = where[0] - x if is_locked else where[0]
        z = where[1] - z if is_locked else where[1]
        sine = turn_sine if is_locked else where[2]
        cosine = turn_cosine if is_locked else where[3]
        moved = (x != 0.0) | (z != 0.0) | (sine != 0.0) | (up != 0.0)
        goal = plus(plus(ball, (x, up, z)), turned(cosine, sine, less(ankle, ball)))
        # as if it were not lifted: the hips rise as the foot comes nearer, not at once
        level = goal[0], goal[1] - lift, goal[2]
        drop = _needed_drop(hip, level, _longest(whole, hip, ankle))
        body[_DROP + k] = max(body[_DROP + k], drop) if moved else body[_DROP + k]
        store3(posed, _TO_HIP, k, hip_bone)
        store3(posed, _TO_KNEE, k, knee_bone)
        store3(posed, _TO_ANKLE, k, ankle_bone)
        store4(posed, _TURNS, k, thigh)
        store4(posed, _TURNS + 4 * TILE, k, shank)
        store4(posed, _TURNS + 8 * TILE, k, sole)
        posed[_GOAL + k] = goal[0] if moved else ankle[0]
        posed[_GOAL + TILE + k] = goal[1] if moved else ankle[1]
        posed[_GOAL + 2 * TILE + k] = goal[2] if moved else ankle[2]
        posed[_YAW + k] = sine if moved else 0.0
        posed[_YAW + TILE + k] = cosine if moved else 1.0
        posed[_MOVED + k] = 1.0 if moved else 0.0


@numba.njit(cache=True, nogil=True)
def _bone(bones, joint):
    return bones[joint, 0], bones[joint, 1], bones[joint, 2]


@numba.njit(cache=True, nogil=True, forceinline=True)
def _longest(whole, hip, ankle):
    """How far from its hip the ankle of a held leg may be."""
    way = less(ankle, hip)
    return min(max(_STRAIGHTEST * whole, math.sqrt(dot(way, way))), _FULLY * whole)


@numba.njit(cache=True, nogil=True, forceinline=True)
def _needed_drop(hip, goal, longest):
    """How far the hip must come down for the ankle to reach its goal; DEEPEST where that does not help."""
    x, y, z = less(hip, goal)
    left = longest * longest - x * x - z * z
    down = max(y - math.sqrt(max(left, 0.0)), 0.0)
    return down if left > 0.0 else DEEPEST


@numba.njit(cache=True, nogil=True)
def _drop(slots, body, shown_root):
    """Let the hips come down, in what is shown."""
    for k in range(slots.shape[0]):
        drop = min(body[_DROP + k], DEEPEST)
        body[_DROP + k] = drop
        shown_root[slots[k], 1] -= drop
        body[_ROOT + TILE + k] = shown_root[slots[k], 1]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _bend_legs(count, span, body, posed, asked):
    """Bring ankles to their goals and turn the feet; the local rotations take the place of those that were given."""
    upper, lower = span[0], span[1]
    for k in range(min(count, TILE)):
        hip = plus(load3(body, _ROOT, k), load3(posed, _TO_HIP, k))
        knee = plus(hip, load3(posed, _TO_KNEE, k))
        ankle = plus(knee, load3(posed, _TO_ANKLE, k))
        thigh, shank = load4(posed, _TURNS, k), load4(posed, _TURNS + 4 * TILE, k)
        goal, longest = load3(posed, _GOAL, k), _longest(upper + lower, hip, ankle)
        before_thigh, before_shank = bent_knee(hip, knee, ankle, thigh, goal, (upper, lower), longest)
        thigh, shank = multiply(before_thigh, thigh), multiply(before_shank, shank)
        sine, cosine = posed[_YAW + k], posed[_YAW + TILE + k]
        half = 1.0 / math.sqrt(sine * sine + (1.0 + cosine) * (1.0 + cosine))
        sole = planar(load4(posed, _TURNS + 8 * TILE, k), (1.0 + cosine) * half, sine * half)
        store4(asked, _THIGH, k, multiply(conjugate(load4(body, _PELVIS, k)), thigh))
        store4(asked, _SHANK, k, multiply(conjugate(thigh), shank))
        store4(asked, _SOLE, k, multiply(conjugate(shank), sole))


@numba.njit(cache=True, nogil=True)
def _scatter_legs(slots, leg, body, posed, asked, shown_rotations):
    thigh, shank, sole = leg[0], leg[1], leg[2]
    for k in range(slots.shape[0]):
        if posed[_MOVED + k] != 0.0 or body[_DROP + k] > 0.0:
            who = slots[k]
            for i in range(4):
                shown_rotations[who, thigh, i] = asked[_THIGH + i * TILE + k]
                shown_rotations[who, shank, i] = asked[_SHANK + i * TILE + k]
                shown_rotations[who, sole, i] = asked[_SOLE + i * TILE + k]
