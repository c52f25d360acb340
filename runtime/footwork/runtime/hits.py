"""Hits: whether the limb that strikes is shown within reach of a target, as spheres."""

import math
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.strike_distance import FIRST_TARGET, TARGET_COUNT
from footwork.motion.fighting_points import RADII
from footwork.runtime.rotation_kernels import rotate

_RADII = np.array(RADII)


class BodyPoints(NamedTuple):
    """The points of a body that count, and the tree that they hang from.

    Args:
        parents: of the joints.  # (J,)
        bones: rest offsets, metres.  # (J, 3)
        joints: ``fighting_points``: what each point hangs from.  # (7,)
        offsets: and where.  # (7, 3)
    """

    parents: NDArray[np.int32]
    bones: NDArray[np.float64]
    joints: NDArray[np.int32]
    offsets: NDArray[np.float64]


@numba.njit(cache=True, nogil=True)
def shown_point(root: NDArray, rotations: NDArray, body: BodyPoints, point: int):
    """Where a point of one shown body is in the world, metres.

    Args:
        root: of joint 0.  # (3,)
        rotations: local, xyzw.  # (J, 4)
        body: its points.
        point: which of them.
    """
    parents, bones, joints, offsets = body
    joint, offset = joints[point], offsets[point]
    at = offset[0], offset[1], offset[2]
    while joint > 0:
        x, y, z = _turned(rotations[joint], at)
        at = x + bones[joint, 0], y + bones[joint, 1], z + bones[joint, 2]
        joint = parents[joint]
    x, y, z = _turned(rotations[0], at)
    return x + root[0], y + root[1], z + root[2]


@numba.njit(cache=True, nogil=True)
def _turned(q, at):
    return rotate((q[0], q[1], q[2], q[3]), at)


@numba.njit(cache=True, nogil=True)
def shown_strike_distance(root: NDArray, rotations: NDArray, body: BodyPoints, limb: int, who: int):
    """From a shown limb to the nearest target's surface of the other, metres, and which target it is.

    Args:
        root: of joint 0 of both.  # (2, 3)
        rotations: of both.  # (2, J, 4)
        body: their points.
        limb: which strikes.
        who: strikes.
    """
    tip, other = shown_point(root[who], rotations[who], body, limb), 1 - who
    nearest, target = math.inf, -1
    for number in range(TARGET_COUNT):
        centre = shown_point(root[other], rotations[other], body, FIRST_TARGET + number)
        gap = (tip[0] - centre[0]) ** 2 + (tip[1] - centre[1]) ** 2 + (tip[2] - centre[2]) ** 2
        away = math.sqrt(gap) - _RADII[number]
        if away < nearest:
            nearest, target = away, number
    return nearest, target
