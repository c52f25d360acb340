"""Inertialisation: what is left of the old motion after a jump in the graph, dying away over the new motion.

At a transition the pose jumps. The difference between the pose last shown and the new motion becomes an offset with
a velocity of its own, and both decay like a critically damped spring of half-life h (conventions.md 10)::

    y = 2 ln 2 / h    j = v + x y    x <- exp(-y t) (x + j t)    v <- exp(-y t) (v - j y t)

The pose shown is the new motion plus the offset. A root offset is a vector in the world. A joint's offset is a
rotation vector in its parent's frame (joint 0: in the world) put before the joint's own rotation, ``exp(x) q``.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.runtime.motion_rows import SPIN, VELOCITY
from footwork.runtime.moving import glided
from footwork.runtime.rotation_kernels import (
    along,
    before,
    exp,
    log,
    multiply,
    planar,
    rate,
    rotate,
    spin,
    turned,
)
from footwork.runtime.tiles import TILE, load3, load4, store3, store4

_OLD, _NEW, _OFFSET, _ROOM = 0, 7 * TILE, 14 * TILE, 20 * TILE  # of a tile of joints

_NEGLIGIBLE = 1e-6
_LARGE = 10.0
_TOO_FAST = 100.0
"""Offset velocities are held under this, rad/s: so an offset stays under a whole turn, where the series hold."""


@numba.njit(cache=True, nogil=True)
def decay_weights(seconds: float, halflife: float) -> tuple[float, float, float, float]:
    """The spring as weights (a, b, c, d): after ``seconds``, x is ``a x + b v`` and v is ``c x + d v``."""
    y = 2.0 * math.log(2.0) / halflife
    e = math.exp(-y * seconds)
    return e * (1.0 + y * seconds), e * seconds, -e * y * y * seconds, e * (1.0 - y * seconds)


def ticks_to_settle(halflife: float) -> int:
    """After how many ticks any offset of a body (10 m, 10 rad) is under a micrometre and a microradian.

    Offsets are dropped then: left alone they would end as denormal numbers, which never reach zero and are slow.
    """
    ticks = 1
    while np.dot(decay_weights(ticks * TICK, halflife)[:2], [_LARGE, _TOO_FAST]) > _NEGLIGIBLE:
        ticks += 1
    return ticks


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _capped(v, limit):
    size = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    scale = 1.0 if size <= limit else limit / size
    return v[0] * scale, v[1] * scale, v[2] * scale


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _joint_offset(offset, velocity, old, old_spin, new, new_spin):
    """Offset and offset velocity of one joint over its new motion, such that the pose shown goes on smoothly.

    The velocity of the pose shown is that of the offset, ``spin(x, v)``, plus that of the motion below it turned by
    the offset, ``exp(x) w``. Keeping their sum is exact for offsets of any size; to first order it is the rule
    of conventions.md 10, offset velocity = velocity of the source - velocity of the target.

    Args:
        offset: over the old motion.
        velocity: of that offset.
        old: the old motion's local rotation.
        old_spin: its angular velocity.
        new: the new motion's local rotation at the same time.
        new_spin: its angular velocity.
    """
    turn = exp(offset[0], offset[1], offset[2])
    left_turn = multiply(multiply(turn, old), (-new[0], -new[1], -new[2], new[3]))
    left = log(left_turn)
    goes = along(spin(offset, turn, velocity), 1.0, rotate(turn, old_spin), -1.0, rotate(left_turn, new_spin))
    return left, _capped(rate(left, left_turn, goes), _TOO_FAST)


@numba.njit(cache=True, nogil=True)
def decay(
    slots: NDArray, ticks_left: NDArray, offsets: NDArray, roots: NDArray, seconds: float, halflife: float
) -> None:
    """Let the offsets of those characters that have any decay by ``seconds``, in place.

    Args:
        slots: rows of the characters.  # (n,)
        ticks_left: after how many more calls the offsets are dropped, 0 where there are none.  # (C,)
        offsets: ``motion_rows.offset_rows`` of the joints, rad and rad/s.  # (C, 6, padded J)
        roots: offset (m) and its velocity (m/s) of the root.  # (C, 2, 3)
        seconds: how long.
        halflife: of the spring, s.
    """
    a, b, c, d = decay_weights(seconds, halflife)
    narrow = np.float32(a), np.float32(b), np.float32(c), np.float32(d)
    for who in slots:
        if ticks_left[who] == 0:
            continue
        ticks_left[who] -= 1
        if ticks_left[who] == 0:
            offsets[who] = 0.0
            roots[who] = 0.0
            continue
        _decay_row(roots[who, 0], roots[who, 1], (a, b, c, d))
        for k in range(3):
            _decay_row(offsets[who, k], offsets[who, k + VELOCITY], narrow)


@numba.njit(cache=True, nogil=True, forceinline=True)
def _decay_row(offset, velocity, weights):
    """The spring's step for a row of numbers and their velocities, in place."""
    a, b, c, d = weights
    for place in range(offset.shape[0]):
        x, v = offset[place], velocity[place]
        offset[place] = a * x + b * v
        velocity[place] = c * x + d * v


@numba.njit(cache=True, nogil=True, forceinline=True)
def _jump_root(root, position, velocity, place, cosine, sine, sign):
    """Add ``sign`` times the root's place and velocity in the world to its offset (2, 3)."""
    x, y, z = turned(cosine, sine, position)
    root[0, 0] += sign * (place[0] + x)
    root[0, 1] += sign * y
    root[0, 2] += sign * (place[1] + z)
    x, y, z = turned(cosine, sine, velocity)
    root[1, 0] += sign * x
    root[1, 1] += sign * y
    root[1, 2] += sign * z


@numba.njit(cache=True, nogil=True)
def _jump_joints(offsets, old, new, old_yaw, new_yaw, room):
    """Offset rows (6, padded J) of one character over the new node's motion instead of the old one's, in place.

    ``room`` is a tile of _ROOM numbers to work in: joints are worked on side by side.
    """
    for first in range(0, offsets.shape[1], TILE):
        count = min(TILE, offsets.shape[1] - first)
        _load(old, first, count, room, _OLD)
        _load(new, first, count, room, _NEW)
        _load(offsets, first, count, room, _OFFSET)
        if first == 0:
            _from_planar(room, _OLD, old_yaw)
            _from_planar(room, _NEW, new_yaw)
        _jump_side_by_side(count, room)
        for row in range(offsets.shape[0]):
            for k in range(count):
                offsets[row, first + k] = room[_OFFSET + row * TILE + k]


@numba.njit(cache=True, nogil=True, forceinline=True)
def _load(rows, first, count, room, at):
    for row in range(rows.shape[0]):
        for k in range(count):
            room[at + row * TILE + k] = rows[row, first + k]


@numba.njit(cache=True, nogil=True, forceinline=True)
def _from_planar(room, at, yaw):
    """Turn joint 0 and its angular velocity, of a tile's rows from ``at`` on, into the world, in place."""
    spin_at = at + SPIN * TILE
    store4(room, at, 0, planar(load4(room, at, 0), math.cos(0.5 * yaw), math.sin(0.5 * yaw)))
    store3(room, spin_at, 0, turned(math.cos(yaw), math.sin(yaw), load3(room, spin_at, 0)))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _jump_side_by_side(count, room):
    """``_joint_offset`` of so many joints of a tile, in place."""
    for k in range(min(count, TILE)):
        new_spin = load3(room, _NEW + SPIN * TILE, k)
        left, goes = _joint_offset(
            load3(room, _OFFSET, k),
            load3(room, _OFFSET + VELOCITY * TILE, k),
            load4(room, _OLD, k),
            load3(room, _OLD + SPIN * TILE, k),
            before(new_spin, load4(room, _NEW, k), TICK),
            new_spin,
        )
        store3(room, _OFFSET, k, left)
        store3(room, _OFFSET + VELOCITY * TILE, k, goes)


@numba.njit(cache=True, nogil=True)
def jump(
    who: int,
    old_node: int,
    old_place: NDArray,
    new_node: int,
    new_place: tuple[float, float, float],
    root_position: NDArray,
    root_velocity: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    roots: NDArray,
    room: NDArray,
) -> None:
    """Take a transition's jump into a character's offsets, in place.

    The jump goes from the old node to the frame before the new one, which the new node's backward velocities give.

    Args:
        who: the character's row.
        old_node: where it was.
        old_place: its planar place there, (x, z, yaw).  # (3,)
        new_node: where the edge led.
        new_place: its planar place there, as the tick begins.
        root_position: of the graph.  # (N, 3)
        root_velocity: of the graph.  # (N, 3)
        nodes: ``motion_rows.node_rows`` of the graph.  # (N, 7, padded J)
        offsets: ``motion_rows.offset_rows`` of the joints at the end of the last tick, rad and rad/s.
        roots: offset (m) and its velocity (m/s) of the root.  # (C, 2, 3)
        room: a tile to work in.  # (_ROOM,)
    """
    cosine, sine = math.cos(old_place[2]), math.sin(old_place[2])
    root = roots[who]
    _jump_root(root, root_position[old_node], root_velocity[old_node], old_place, cosine, sine, 1.0)
    cosine, sine = math.cos(new_place[2]), math.sin(new_place[2])
    _jump_root(root, root_position[new_node], root_velocity[new_node], new_place, cosine, sine, -1.0)
    x, y, z = turned(cosine, sine, root_velocity[new_node])
    root[0, 0] += TICK * x
    root[0, 1] += TICK * y
    root[0, 2] += TICK * z
    _jump_joints(offsets[who], nodes[old_node], nodes[new_node], old_place[2], new_place[2], room)


@numba.njit(cache=True, nogil=True)
def take_jumps(
    slots: NDArray,
    settle_ticks: int,
    ticks_left: NDArray,
    natural: NDArray,
    old_node: NDArray,
    old_place: NDArray,
    node: NDArray,
    place: NDArray,
    glide: NDArray,
    root_position: NDArray,
    root_velocity: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    roots: NDArray,
) -> None:
    """``jump`` for the characters ``slots`` (n,) whose move is not natural, from where their tick begins; see there.

    ``old_node`` (n,) and ``old_place`` (n, 3) are theirs row for row. ``glide`` is what ``moving.make_moves`` gives
    (C, 3); ``ticks_left`` is set to ``settle_ticks`` for those that jump.
    """
    room = np.empty(_ROOM)
    for row in range(slots.shape[0]):
        who = int(slots[row])
        if not natural[who]:
            ticks_left[who] = settle_ticks
            jump(
                who,
                old_node[row],
                old_place[row],
                node[who],
                glided(place[who], glide[who], -1.0),
                root_position,
                root_velocity,
                nodes,
                offsets,
                roots,
                room,
            )
