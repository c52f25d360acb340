"""Planar places and transforms (x, z, yaw) in compiled loops: metres and radians, positive yaw turns left."""

import math

import numba
from numpy.typing import NDArray

from footwork.motion.angle import wrapped_angle


@numba.njit(cache=True, nogil=True)
def put(place, x, z):
    """A point (x, z) given in a place's frame, in the frame of that place."""
    cosine, sine = math.cos(place[2]), math.sin(place[2])
    return place[0] + x * cosine + z * sine, place[1] - x * sine + z * cosine


@numba.njit(cache=True, nogil=True)
def seen(place, x, z):
    """A point (x, z) in a place's own frame: the inverse of ``put``."""
    cosine, sine = math.cos(place[2]), math.sin(place[2])
    x, z = x - place[0], z - place[1]
    return x * cosine - z * sine, x * sine + z * cosine


@numba.njit(cache=True, nogil=True)
def after(place, step):
    """Where one comes who stands at a place and goes through a transform; yaw within -pi..pi."""
    x, z = put(place, step[0], step[1])
    return x, z, wrapped_angle(place[2] + step[2])


@numba.njit(cache=True, nogil=True)
def between(start, end):
    """The transform that leads from one place to another: ``after(start, between(start, end))`` is ``end``."""
    x, z = seen(start, end[0], end[1])
    return x, z, wrapped_angle(end[2] - start[2])


@numba.njit(cache=True, nogil=True)
def triple(rows: NDArray, row: int):
    """One row of an array (n, 3) as a place."""
    return float(rows[row, 0]), float(rows[row, 1]), float(rows[row, 2])
