"""Where feet are at their nodes' own moment as motion and inertialisation have them, many characters at once."""

import math

import numba
from numpy.typing import NDArray

from footwork.runtime.foot_places import sole_of
from footwork.runtime.leg_kernels import plus
from footwork.runtime.motion_rows import VELOCITY
from footwork.runtime.rotation_kernels import along, exp, multiply, planar, rotate, turned
from footwork.runtime.tiles import TILE, load3, load4, store3, store4

# of a joint: its node's rotation, then its offset with its velocity
_OFFSET, _RATE, _JOINT = 4 * TILE, 7 * TILE, 10 * TILE
# of the hips: place and rotation in the world, and sine and cosine of half the yaw
_HIPS, _HALF_YAW = _JOINT, _JOINT + 7 * TILE
# how far down a leg one has come: place and rotation in the world
_PLACE, _TURN = _JOINT + 9 * TILE, _JOINT + 12 * TILE
ROOM = _JOINT + 16 * TILE
"""Numbers to work in."""
HEIGHT, SOLE, FOOT = 0, TILE, 5 * TILE
"""In the tile of a foot: the height of its ball, then ``sole_of`` it; and how many numbers that is."""


@numba.njit(cache=True, nogil=True)
def feet_at_tick(
    slots: NDArray,
    node: NDArray,
    place: NDArray,
    weights: tuple[float, float],
    root_position: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    roots: NDArray,
    legs: NDArray,
    bones: NDArray,
    room: NDArray,
    feet: NDArray,
) -> None:
    """Write the places of the feet of up to TILE characters.

    Args:
        slots: which.  # (n,)
        node: where each is.  # (C,)
        place: planar places there.  # (C, 3)
        weights: the first two of ``decay_weights`` over the tick.
        root_position: of the graph.  # (N, 3)
        nodes: ``motion_rows.node_rows`` of the graph.  # (N, 7, padded J)
        offsets: ``motion_rows.offset_rows`` as the tick began.  # (C, 6, padded J)
        roots: offset and its velocity of the root, as the tick began.  # (C, 2, 3)
        legs: ``legs_of`` the body.  # (feet, 4)
        bones: its rest offsets.  # (J, 3)
        room: to work in.  # (ROOM,)
        feet: written: height and sole of each, a tile a foot.  # (feet, FOOT)
    """
    count = slots.shape[0]
    _gather_hips(slots, node, place, weights, root_position, roots, room)
    _gather_joint(slots, node, 0, nodes, offsets, room)
    _turn_hips(count, weights, room)
    for foot in range(legs.shape[0]):
        for k in range(count):
            store3(room, _PLACE, k, load3(room, _HIPS, k))
            store4(room, _TURN, k, load4(room, _HIPS + 3 * TILE, k))
        for part in range(3):
            joint = legs[foot, part]
            _gather_joint(slots, node, joint, nodes, offsets, room)
            _go_down(count, (bones[joint, 0], bones[joint, 1], bones[joint, 2]), weights, room)
        ball = legs[foot, 3]
        _put_down(count, (bones[ball, 0], bones[ball, 1], bones[ball, 2]), room, feet[foot])


@numba.njit(cache=True, nogil=True)
def _gather_hips(slots, node, place, weights, root_position, roots, room):
    a, b = weights
    for k in range(slots.shape[0]):
        who = slots[k]
        here = node[who]
        sine, cosine = math.sin(0.5 * place[who, 2]), math.cos(0.5 * place[who, 2])
        room[_HALF_YAW + k], room[_HALF_YAW + TILE + k] = sine, cosine
        at = root_position[here, 0], root_position[here, 1], root_position[here, 2]
        x, y, z = turned(1.0 - 2.0 * sine * sine, 2.0 * sine * cosine, at)
        room[_HIPS + k] = place[who, 0] + x + a * roots[who, 0, 0] + b * roots[who, 1, 0]
        room[_HIPS + TILE + k] = y + a * roots[who, 0, 1] + b * roots[who, 1, 1]
        room[_HIPS + 2 * TILE + k] = place[who, 1] + z + a * roots[who, 0, 2] + b * roots[who, 1, 2]


@numba.njit(cache=True, nogil=True)
def _gather_joint(slots, node, joint, nodes, offsets, room):
    for k in range(slots.shape[0]):
        who = slots[k]
        here = node[who]
        for i in range(4):
            room[i * TILE + k] = nodes[here, i, joint]
        for i in range(3):
            room[_OFFSET + i * TILE + k] = offsets[who, i, joint]
            room[_RATE + i * TILE + k] = offsets[who, i + VELOCITY, joint]


@numba.njit(cache=True, nogil=True, forceinline=True)
def _offset_turn(room, weights, k):
    """What inertialisation adds to the joint."""
    x, y, z = along((0.0, 0.0, 0.0), weights[0], load3(room, _OFFSET, k), weights[1], load3(room, _RATE, k))
    return exp(x, y, z)


@numba.njit(cache=True, nogil=True)
def _turn_hips(count, weights, room):
    for k in range(min(count, TILE)):
        motion = planar(load4(room, 0, k), room[_HALF_YAW + TILE + k], room[_HALF_YAW + k])
        store4(room, _HIPS + 3 * TILE, k, multiply(_offset_turn(room, weights, k), motion))


@numba.njit(cache=True, nogil=True)
def _go_down(count, bone, weights, room):
    """Go on to the joint at the end of a bone."""
    for k in range(min(count, TILE)):
        turn = load4(room, _TURN, k)
        store3(room, _PLACE, k, plus(load3(room, _PLACE, k), rotate(turn, bone)))
        store4(room, _TURN, k, multiply(turn, multiply(_offset_turn(room, weights, k), load4(room, 0, k))))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _put_down(count, bone, room, foot):
    for k in range(min(count, TILE)):
        ankle = load3(room, _PLACE, k)
        ball = plus(ankle, rotate(load4(room, _TURN, k), bone))
        foot[HEIGHT + k] = ball[1]
        store4(foot, SOLE, k, sole_of(ankle, ball))
