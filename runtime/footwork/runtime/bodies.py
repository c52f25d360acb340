"""Bodies that do not walk through one another: those that come too near are pushed apart, a little each tick."""

import math

import numba
from numpy.typing import NDArray

from footwork.motion.angle import wrapped_angle


@numba.njit(cache=True, nogil=True)
def push_apart(there: NDArray, apart: float, most: float, pushes: NDArray) -> None:
    """How two bodies are pushed away from each other, half of what is missing each.

    Bodies in one place are pushed along x.

    Args:
        there: where their hips come to stand, x and z first, metres.  # (2, 3)
        apart: how far they are to be from each other, metres.
        most: of one push, metres.
        pushes: written: x and z in the world.  # (2, 2)
    """
    x, z = there[1, 0] - there[0, 0], there[1, 1] - there[0, 1]
    away = math.hypot(x, z)
    push = min(max(0.5 * (apart - away), 0.0), most)
    along_x, along_z = (x / away, z / away) if away > 0.0 else (1.0, 0.0)
    pushes[0, 0], pushes[0, 1] = -push * along_x, -push * along_z
    pushes[1, 0], pushes[1, 1] = push * along_x, push * along_z


@numba.njit(cache=True, nogil=True)
def adjustment_for(yaw, push_x, push_z, pivot_x, pivot_z, turn):
    """The planar transform that turns a body about a point of its planar frame and shifts it over the world.

    Args:
        yaw: of that planar frame, radians.
        push_x: the shift, metres.
        push_z: likewise.
        pivot_x: the point, metres.
        pivot_z: likewise.
        turn: radians.
    """
    cosine, sine = math.cos(yaw), math.sin(yaw)
    less_cosine, turn_sine = 2.0 * math.sin(0.5 * turn) ** 2, math.sin(turn)
    x = pivot_x * less_cosine - pivot_z * turn_sine + push_x * cosine - push_z * sine
    z = pivot_x * turn_sine + pivot_z * less_cosine + push_x * sine + push_z * cosine
    return x, z, wrapped_angle(turn)
