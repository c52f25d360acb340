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
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.leg_kernels import plus
from footwork.runtime.motion_rows import VELOCITY
from footwork.runtime.rotation_kernels import along, column3, column4, exp, multiply, planar, rotate, turned

RELEASE_HALFLIFE = 0.05
"""Half-life of what a lock leaves when it ends, s: a twelfth is left after 0.15 s."""
FURTHEST, MOST_TURNED = 0.25, math.radians(45.0)
"""A lock further than this from its motion, metres and radians, ends in a step."""
STEP_TICKS = 5
"""How long such a step takes."""
LOW = 0.04
"""A foot is locked once its ball is no higher than this above the floor, metres."""
_FAR_TOO_FAR = 2.0  # times those limits: a foot that does not wait for the other's step
_UPRIGHT = 1e-6  # metres from ankle to ball over the ground
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


@numba.njit(cache=True, nogil=True, forceinline=True)
def _shown_turn(node, offset, joint, weights):
    """A joint's local rotation as shown at its node's own moment."""
    a, b = weights
    x, y, z = along((0.0, 0.0, 0.0), a, column3(offset, 0, joint), b, column3(offset, VELOCITY, joint))
    return multiply(exp(x, y, z), column4(node, 0, joint))


@numba.njit(cache=True, nogil=True, forceinline=True)
def _pelvis_at_tick(node, place, root_position, offset, root, weights):
    """Place and rotation of joint 0 in the world as shown at its node's own moment; arguments as ``_foot_at_tick``."""
    a, b = weights
    motion = planar(column4(node, 0, 0), math.cos(0.5 * place[2]), math.sin(0.5 * place[2]))
    x, y, z = along((0.0, 0.0, 0.0), a, column3(offset, 0, 0), b, column3(offset, VELOCITY, 0))
    at = plus(turned(math.cos(place[2]), math.sin(place[2]), root_position), (place[0], 0.0, place[1]))
    return along(at, a, root[0], b, root[1]), multiply(exp(x, y, z), motion)


@numba.njit(cache=True, nogil=True, forceinline=True)
def _foot_at_tick(pelvis, leg, bones, node, offset, weights):
    """A foot as its motion with inertialisation has it at the node's own moment: its ball's height, and ``sole_of`` it.

    Args:
        pelvis: place and rotation of joint 0 in the world.
        leg: thigh, shank, foot and ball.  # (4,)
        bones: rest offsets of the body.  # (J, 3)
        node: ``motion_rows.node_rows`` of the node.  # (7, padded J)
        offset: ``motion_rows.offset_rows`` of the character.  # (6, padded J)
        weights: the first two of ``decay_weights`` over the tick.
    """
    at, turn = pelvis
    for k in range(3):
        at = plus(at, rotate(turn, bones[leg[k]]))
        turn = multiply(turn, _shown_turn(node, offset, leg[k], weights))
    ball = plus(at, rotate(turn, bones[leg[3]]))
    return ball[1], sole_of(at, ball)


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def sole_of(ankle, ball):
    """A foot over the ground: its ball's x and z, and sine and cosine of its yaw; 0 and 1 where it points nowhere."""
    x, z = ball[0] - ankle[0], ball[2] - ankle[2]
    length = math.sqrt(x * x + z * z)
    if length < _UPRIGHT:
        return ball[0], ball[2], 0.0, 1.0
    return ball[0], ball[2], x / length, z / length


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
    dying = decay_weights(TICK, RELEASE_HALFLIFE)
    for who in slots:
        here = node[who]
        pelvis = _pelvis_at_tick(nodes[here], place[who], root_position[here], offsets[who], roots[who], (a, b))
        for foot in range(legs.shape[0]):
            if not locked[who, foot]:
                _die_away(slip[who, foot], dying)
            stride[who, foot] = max(stride[who, foot] - 1, 0)
            stays = contacts[here, foot] and contacts[target[who], foot]
            if locked[who, foot] or (stays and stride[who, foot] == 0):
                height, sole = _foot_at_tick(pelvis, legs[foot], bones, nodes[here], offsets[who], (a, b))
                if locked[who, foot]:
                    _leave(sole, anchor[who, foot], slip[who, foot])
                    locked[who, foot] = stays
                elif height <= floor + LOW:
                    _settle(sole, anchor[who, foot], slip[who, foot])
                    locked[who, foot] = True
        _take_step(locked[who], slip[who], stride[who])


@numba.njit(cache=True, nogil=True, forceinline=True)
def _die_away(slip, weights):
    """A tick of the spring for one foot's offset, in place."""
    a, b, c, d = weights
    largest = 0.0
    for k in range(3):
        x, v = slip[0, k], slip[1, k]
        slip[0, k], slip[1, k] = a * x + b * v, c * x + d * v
        largest = max(largest, abs(slip[0, k]), abs(slip[1, k]) * RELEASE_HALFLIFE)
    if largest < _SETTLED:
        slip[:] = 0.0


@numba.njit(cache=True, nogil=True, forceinline=True)
def _leave(sole, anchor, slip):
    """What a foot's offset is, in place, if its lock ends here."""
    sine, cosine = between_yaws(anchor[2], anchor[3], sole[2], sole[3])
    slip[0, 0], slip[0, 1], slip[0, 2] = anchor[0] - sole[0], anchor[1] - sole[1], math.atan2(sine, cosine)
    slip[1] = 0.0


@numba.njit(cache=True, nogil=True, forceinline=True)
def _settle(sole, anchor, slip):
    """Anchor a foot where it is shown, in place."""
    sine, cosine = math.sin(slip[0, 2]), math.cos(slip[0, 2])
    anchor[0], anchor[1] = sole[0] + slip[0, 0], sole[1] + slip[0, 1]
    anchor[2], anchor[3] = sole[2] * cosine + sole[3] * sine, sole[3] * cosine - sole[2] * sine
    slip[:] = 0.0


@numba.njit(cache=True, nogil=True, forceinline=True)
def _take_step(locked, slip, stride):
    """Let the locked foot that is furthest from its motion step, if it is too far, in place."""
    worst, furthest, stepping = -1, 1.0, False
    for foot in range(locked.shape[0]):
        stepping |= stride[foot] > 0
        away = math.sqrt(slip[foot, 0, 0] ** 2 + slip[foot, 0, 1] ** 2) / FURTHEST
        error = max(away, abs(slip[foot, 0, 2]) / MOST_TURNED)
        if locked[foot] and error > furthest:
            worst, furthest = foot, error
    if worst >= 0 and (not stepping or furthest > _FAR_TOO_FAR):
        locked[worst], stride[worst] = False, STEP_TICKS


@numba.njit(cache=True, nogil=True)
def between_yaws(sine, cosine, from_sine, from_cosine):
    """Sine and cosine of one yaw less another."""
    return sine * from_cosine - cosine * from_sine, cosine * from_cosine + sine * from_sine
