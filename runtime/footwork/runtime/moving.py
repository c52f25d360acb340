"""How characters are carried from place to place: moves are checked, made, and spread over their tick."""

import math

import numba
from numpy.typing import NDArray

from footwork.motion.angle import wrapped_angle
from footwork.motion.moves import LEAP
from footwork.runtime.rotation_kernels import turned

_SMALL = 1e-4  # rad: below it series are good to float64


@numba.njit(cache=True, nogil=True)
def first_wrong_move(
    slots: NDArray,
    node: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    edge_start: NDArray,
    graph_target: NDArray,
) -> int:
    """The first of the rows ``slots`` whose move cannot be made, -1 for none; the rest is of Moves and the graph."""
    for who in slots:
        if not 0 <= target[who] < edge_start.shape[0] - 1:
            return who
        taken = edge[who]
        if taken != LEAP and not edge_start[node[who]] <= taken < edge_start[node[who] + 1]:
            return who
        if taken != LEAP and graph_target[taken] != target[who]:
            return who
        for k in range(3):
            if not math.isfinite(displacement[who, k] + adjustment[who, k]):
                return who
    return -1


@numba.njit(cache=True, nogil=True)
def make_moves(
    slots: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    node: NDArray,
    place: NDArray,
    glide: NDArray,
) -> None:
    """Make the moves of characters, in place; yaw is kept within -pi..pi.

    Args:
        slots: which rows.  # (n,)
        target: of the moves.  # (C,)
        displacement: of the moves.  # (C, 3)
        adjustment: of the moves.  # (C, 3)
        node: where each is.  # (C,)
        place: planar places (x, z, yaw).  # (C, 3)
        glide: the even planar motion that makes up the adjustment over the tick, m and rad a tick.  # (C, 3)
    """
    for who in slots:
        _carry(place[who], displacement[who])
        _carry(place[who], adjustment[who])
        glide[who, 0], glide[who, 1], glide[who, 2] = glide_of(adjustment[who])
        node[who] = target[who]


@numba.njit(cache=True, nogil=True, forceinline=True)
def _carry(place: NDArray, transform: NDArray) -> None:
    """Take a planar place (3,) through a planar transform (3,), in place; yaw is kept within -pi..pi."""
    yaw = place[2]
    x, _, z = turned(math.cos(yaw), math.sin(yaw), (transform[0], 0.0, transform[1]))
    place[0] += x
    place[1] += z
    place[2] = wrapped_angle(yaw + transform[2])


@numba.njit(cache=True, nogil=True, forceinline=True)
def glide_of(transform):
    """The even planar motion that makes up a transform (x, z, yaw) in one tick: the logarithm in the plane.

    With u = x + iz a turn by w takes u to u e^(-iw), so that an even motion g with the turn w ends at
    g (1 - e^(-iw)) / (iw). A turn about a point stays a turn about that point all the way.
    """
    x, z, yaw = transform[0], transform[1], transform[2]
    half = 0.5 * yaw
    along = 1.0 - half * half / 3.0 if abs(half) < _SMALL else half / math.tan(half)
    return along * x - half * z, along * z + half * x, yaw


@numba.njit(cache=True, nogil=True, forceinline=True)
def glided(place, glide, ticks):
    """A place (x, z, yaw) after so many ticks of an even planar motion; negative ones go back."""
    if ticks == 0.0 or (glide[0] == 0.0 and glide[1] == 0.0 and glide[2] == 0.0):
        return place[0], place[1], place[2]
    angle = ticks * glide[2]
    near = abs(angle) < _SMALL
    sine = 1.0 - angle * angle / 6.0 if near else math.sin(angle) / angle
    versine = 0.5 * angle if near else (1.0 - math.cos(angle)) / angle
    x = ticks * (sine * glide[0] + versine * glide[1])
    z = ticks * (sine * glide[1] - versine * glide[0])
    x, _, z = turned(math.cos(place[2]), math.sin(place[2]), (x, 0.0, z))
    return place[0] + x, place[1] + z, place[2] + angle
