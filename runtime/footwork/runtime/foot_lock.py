"""Foot locks: a foot that stands stays where it was shown when it came to stand, while the body goes on over it.

While the graph has a foot in contact at both ends of a tick, and it is shown low, the ball of the foot keeps its place
on the ground and the foot its yaw; heights, pitch and roll are the motion's. When contact ends, what the lock had added
dies away like an offset of inertialisation (conventions.md 10). A lock that has come to be too far from its motion ends
in a step: the foot is lifted, what was added dies away, and it is locked anew where it comes down; one foot steps at a
time. Locks change at ticks only, so what is shown between changes nothing.

An offset is (x, z, yaw): how far the ball shown is from the motion's, in the world, and how far the foot is turned.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.alignment import turn as rotated
from footwork.motion.graph import MotionGraph
from footwork.motion.skeleton import Skeleton
from footwork.motion.tick import TICK
from footwork.runtime.foot_places import between_yaws
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.tick_feet import FOOT, HEIGHT, ROOM, SOLE, feet_at_tick
from footwork.runtime.tiles import TILE

RELEASE_HALFLIFE = 0.05
"""Half-life of what a lock leaves when it ends, s: a twelfth is left after 0.15 s."""
FURTHEST, MOST_TURNED = 0.25, math.radians(45.0)
"""A lock further than this from its motion, metres and radians, ends in a step."""
STEP_TICKS = 5
"""How long such a step takes."""
LOW = 0.04
"""A foot is locked once its ball is no higher than this above the floor, metres."""
_FAR_TOO_FAR = 2.0  # times those limits: a foot that does not wait for the other's step
_SETTLED = 1e-6  # metres and radians: what is left is dropped


def legs_of(skeleton: Skeleton) -> NDArray[np.int32]:
    """Thigh, shank, foot and ball of each foot's leg.  # (feet, 4)

    A body whose legs do not hang from joint 0 has none, and its feet are not locked.
    """
    parents = skeleton.parents
    foot, ball = skeleton.feet.T
    shank = parents[foot]
    thigh = parents[shank]
    whole = (parents[ball] == foot) & (shank >= 0) & (thigh > 0) & (parents[thigh] == 0)
    return np.stack([thigh, shank, foot, ball], axis=-1) if whole.all() else np.zeros((0, 4), np.int32)


def lowest_balls(graph: MotionGraph, legs: NDArray[np.int32]) -> float:
    """The least height of a ball in any frame of a graph, metres: the floor that no transition goes under."""
    balls = graph.joint_places[:, legs[:, 3], 1]
    return float(balls.min()) if balls.size else -math.inf


def move_locks(anchors: NDArray, slips: NDArray, old: NDArray, new: tuple[float, float, float]) -> None:
    """Take one character's locks with it from a planar place (x, z, yaw) to another, in place.

    Args:
        anchors: its rows of ``anchor``.  # (feet, 4)
        slips: its rows of ``slip``.  # (feet, 2, 3)
        old: where it was.  # (3,)
        new: where it is put.
    """
    turn = new[2] - old[2]
    ahead = np.column_stack(rotated(anchors[:, 0] - old[0], anchors[:, 1] - old[1], turn))
    anchors[:, :2] = ahead + new[:2]
    anchors[:, 2:] = np.column_stack(rotated(anchors[:, 2], anchors[:, 3], turn))
    slips[..., 0], slips[..., 1] = rotated(slips[..., 0], slips[..., 1], turn)


@numba.njit(cache=True, nogil=True)
def update_locks(
    slots: NDArray,
    node: NDArray,
    target: NDArray,
    place: NDArray,
    contacts: NDArray,
    halflife: float,
    root_position: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    roots: NDArray,
    legs: NDArray,
    bones: NDArray,
    floor: float,
    locked: NDArray,
    anchor: NDArray,
    slip: NDArray,
    stride: NDArray,
) -> None:
    """What becomes of the locks of characters as one tick ends and the next begins, in place.

    Args:
        slots: which rows.  # (n,)
        node: where each is as the tick ends.  # (C,)
        target: the node it goes to next.  # (C,)
        place: planar places as the tick ends.  # (C, 3)
        contacts: of the graph.  # (N, feet)
        halflife: of inertialisation, s.
        root_position: of the graph.  # (N, 3)
        nodes: ``motion_rows.node_rows`` of the graph.  # (N, 7, padded J)
        offsets: ``motion_rows.offset_rows`` as the tick began.  # (C, 6, padded J)
        roots: offset and its velocity of the root, as the tick began.  # (C, 2, 3)
        legs: ``legs_of`` the body.  # (feet, 4)
        bones: its rest offsets.  # (J, 3)
        floor: height of the lowest balls, metres.
        locked: which feet stay where they are.  # (C, feet)
        anchor: where: ball x and z in the world, sine and cosine of the foot's yaw.  # (C, feet, 4)
        slip: of feet not locked, offset and its velocity, as the tick begins.  # (C, feet, 2, 3)
        stride: how many ticks are left of each foot's step.  # (C, feet)
    """
    a, b, _, _ = decay_weights(TICK, halflife)
    room, feet = np.empty(ROOM), np.empty((legs.shape[0], FOOT))
    for first in range(0, slots.shape[0], TILE):
        some = slots[first : first + TILE]
        feet_at_tick(some, node, place, (a, b), root_position, nodes, offsets, roots, legs, bones, room, feet)
        _update(some, node, target, contacts, floor, feet, locked, anchor, slip, stride)


@numba.njit(cache=True, nogil=True)
def _update(slots, node, target, contacts, floor, feet, locked, anchor, slip, stride):
    """``update_locks`` of up to TILE characters whose feet are where ``feet_at_tick`` has them."""
    dying = decay_weights(TICK, RELEASE_HALFLIFE)
    # nothing is cut out of an array: each cut counts references, which takes longer than what is done with it
    for k in range(slots.shape[0]):
        who = slots[k]
        for foot in range(feet.shape[0]):
            if not locked[who, foot]:
                _die_away(slip, who, foot, dying)
            stride[who, foot] = max(stride[who, foot] - 1, 0)
            stays = contacts[node[who], foot] and contacts[target[who], foot]
            x, z = feet[foot, SOLE + k], feet[foot, SOLE + TILE + k]
            sole = x, z, feet[foot, SOLE + 2 * TILE + k], feet[foot, SOLE + 3 * TILE + k]
            if locked[who, foot]:
                _leave(sole, anchor, slip, who, foot)
                locked[who, foot] = stays
            elif stays and stride[who, foot] == 0 and feet[foot, HEIGHT + k] <= floor + LOW:
                _settle(sole, anchor, slip, who, foot)
                locked[who, foot] = True
        _take_step(locked, slip, stride, who)


@numba.njit(cache=True, nogil=True, forceinline=True)
def _die_away(slip, who, foot, weights):
    """A tick of the spring for one foot's offset, in place."""
    a, b, c, d = weights
    largest = 0.0
    for k in range(3):
        x, v = slip[who, foot, 0, k], slip[who, foot, 1, k]
        x, v = a * x + b * v, c * x + d * v
        slip[who, foot, 0, k], slip[who, foot, 1, k] = x, v
        largest = max(largest, abs(x), abs(v) * RELEASE_HALFLIFE)
    if largest < _SETTLED:
        _put_slip(slip, who, foot, 0.0, 0.0, 0.0)


@numba.njit(cache=True, nogil=True, forceinline=True)
def _put_slip(slip, who, foot, x, z, yaw):
    """An offset that does not change."""
    slip[who, foot, 0, 0], slip[who, foot, 0, 1], slip[who, foot, 0, 2] = x, z, yaw
    slip[who, foot, 1, 0] = slip[who, foot, 1, 1] = slip[who, foot, 1, 2] = 0.0


@numba.njit(cache=True, nogil=True, forceinline=True)
def _leave(sole, anchor, slip, who, foot):
    """What a foot's offset is, in place, if its lock ends here."""
    sine, cosine = between_yaws(anchor[who, foot, 2], anchor[who, foot, 3], sole[2], sole[3])
    x, z = anchor[who, foot, 0] - sole[0], anchor[who, foot, 1] - sole[1]
    _put_slip(slip, who, foot, x, z, math.atan2(sine, cosine))


@numba.njit(cache=True, nogil=True, forceinline=True)
def _settle(sole, anchor, slip, who, foot):
    """Anchor a foot where it is shown, in place."""
    x, z, yaw = slip[who, foot, 0, 0], slip[who, foot, 0, 1], slip[who, foot, 0, 2]
    sine, cosine = math.sin(yaw), math.cos(yaw)
    anchor[who, foot, 0], anchor[who, foot, 1] = sole[0] + x, sole[1] + z
    anchor[who, foot, 2], anchor[who, foot, 3] = sole[2] * cosine + sole[3] * sine, sole[3] * cosine - sole[2] * sine
    _put_slip(slip, who, foot, 0.0, 0.0, 0.0)


@numba.njit(cache=True, nogil=True, forceinline=True)
def _take_step(locked, slip, stride, who):
    """Let the locked foot that is furthest from its motion step, if it is too far, in place."""
    worst, furthest, stepping = -1, 1.0, False
    for foot in range(locked.shape[1]):
        stepping |= stride[who, foot] > 0
        away = math.sqrt(slip[who, foot, 0, 0] ** 2 + slip[who, foot, 0, 1] ** 2) / FURTHEST
        error = max(away, abs(slip[who, foot, 0, 2]) / MOST_TURNED)
        if locked[who, foot] and error > furthest:
            worst, furthest = foot, error
    if worst >= 0 and (not stepping or furthest > _FAR_TOO_FAR):
        locked[who, worst], stride[who, worst] = False, STEP_TICKS
