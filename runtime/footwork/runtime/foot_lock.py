"""Foot locks: a foot that stands stays where it was shown when it came to stand, while the body goes on over it.

While the graph has a foot in contact at both ends of a tick, the ball of the foot keeps its place on the ground and the
foot its yaw; heights, pitch and roll are the motion's. When contact ends, what the lock had added dies away like an
offset of inertialisation (conventions.md 10), and so it does when a lock has come to be too far from its motion: that
one is taken anew once it has come near. Locks change at ticks only, so what is shown between changes nothing.

An offset is (x, z, yaw): how far the ball shown is from the motion's, in the world, and how far the foot is turned.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import forward
from footwork.motion.skeleton import Skeleton
from footwork.motion.tick import TICK
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.leg_kernels import plus
from footwork.runtime.motion_rows import VELOCITY
from footwork.runtime.moving import within_half_turn
from footwork.runtime.rotation_kernels import along, column3, column4, exp, multiply, planar, rotate, turned

RELEASE_HALFLIFE = 0.05
"""Half-life of what a lock leaves when it ends, s: a twelfth is left after 0.15 s."""
FURTHEST, MOST_TURNED = 0.3, math.radians(60.0)
"""A lock further than this from its motion, metres and radians, is released."""
_NEAR = 0.5
"""A share of those, within which a standing foot is locked (again)."""
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
    balls = forward(graph.skeleton, graph.root_position, graph.rotations)[0][:, legs[:, 3], 1]
    return float(balls.min()) if balls.size else -math.inf


@numba.njit(cache=True, nogil=True)
def _shown_turn(node, offset, joint, weights):
    """A joint's local rotation as shown at its node's own moment."""
    a, b = weights
    x, y, z = along((0.0, 0.0, 0.0), a, column3(offset, 0, joint), b, column3(offset, VELOCITY, joint))
    return multiply(exp(x, y, z), column4(node, 0, joint))


@numba.njit(cache=True, nogil=True)
def foot_at_tick(leg, bones, node, place, root_position, offset, root, weights):
    """Ball (x, z) and yaw of a foot as its motion with inertialisation has it at the node's own moment.

    Args:
        leg: thigh, shank, foot and ball.  # (4,)
        bones: rest offsets of the body.  # (J, 3)
        node: ``motion_rows.node_rows`` of the node.  # (7, padded J)
        place: planar place of the character.  # (3,)
        root_position: of the node.  # (3,)
        offset: ``motion_rows.offset_rows`` of the character.  # (6, padded J)
        root: offset and velocity of its root.  # (2, 3)
        weights: the first two of ``decay_weights`` over the tick.
    """
    a, b = weights
    motion = planar(column4(node, 0, 0), math.cos(0.5 * place[2]), math.sin(0.5 * place[2]))
    x, y, z = along((0.0, 0.0, 0.0), a, column3(offset, 0, 0), b, column3(offset, VELOCITY, 0))
    turn = multiply(exp(x, y, z), motion)
    at = plus(turned(math.cos(place[2]), math.sin(place[2]), root_position), (place[0], 0.0, place[1]))
    at = along(at, a, root[0], b, root[1])
    for k in range(3):
        at = plus(at, rotate(turn, bones[leg[k]]))
        turn = multiply(turn, _shown_turn(node, offset, leg[k], weights))
    sole = rotate(turn, bones[leg[3]])
    return at[0] + sole[0], at[2] + sole[2], math.atan2(sole[0], sole[2])


@numba.njit(cache=True, nogil=True)
def update_locks(
    active: NDArray,
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
    locked: NDArray,
    anchor: NDArray,
    slip: NDArray,
) -> None:
    """What becomes of the locks of all active characters as one tick ends and the next begins, in place.

    Args:
        active: which rows are characters.  # (C,)
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
        locked: which feet stay where they are.  # (C, feet)
        anchor: where: ball x, z and yaw in the world.  # (C, feet, 3)
        slip: of feet not locked, offset and its velocity, as the tick begins.  # (C, feet, 2, 3)
    """
    a, b, _, _ = decay_weights(TICK, halflife)
    dying = decay_weights(TICK, RELEASE_HALFLIFE)
    for who in range(active.shape[0]):
        if not active[who]:
            continue
        here = node[who]
        for foot in range(legs.shape[0]):
            own, rest = anchor[who, foot], slip[who, foot]
            stays = contacts[here, foot] and contacts[target[who], foot]
            if not locked[who, foot]:
                _die_away(rest, dying)
            if not (stays or locked[who, foot]):
                continue
            at = foot_at_tick(
                legs[foot], bones, nodes[here], place[who], root_position[here], offsets[who], roots[who], (a, b)
            )
            _renew(stays, at, who, foot, locked, own, rest)


@numba.njit(cache=True, nogil=True)
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


@numba.njit(cache=True, nogil=True)
def _renew(stays, at, who, foot, locked, anchor, slip):
    """Keep, take or release the lock of one foot whose motion is at (x, z, yaw)."""
    if locked[who, foot]:
        slip[0, 0], slip[0, 1] = anchor[0] - at[0], anchor[1] - at[1]
        slip[0, 2] = within_half_turn(anchor[2] - at[2])
        slip[1] = 0.0
        locked[who, foot] = stays and _within(slip[0], 1.0)
    elif stays and _within(slip[0], _NEAR):
        for k in range(3):
            anchor[k] = at[k] + slip[0, k]
        locked[who, foot] = True


@numba.njit(cache=True, nogil=True)
def _within(offset, share):
    """Whether an offset is within a share of the limits."""
    away = math.sqrt(offset[0] * offset[0] + offset[1] * offset[1])
    return away <= share * FURTHEST and abs(offset[2]) <= share * MOST_TURNED
