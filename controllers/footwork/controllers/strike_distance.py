"""How far a strike ends from its targets."""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.fight_map import FightMap
from footwork.motion.fighting_points import LIMBS, RADII, TARGETS
from footwork.motion.planar import put, seen

FIRST_TARGET, TARGET_COUNT = len(LIMBS), len(TARGETS)
_RADII = np.array(RADII)
_FAR = 1.2
"""Metres: no part of a body is further from its hips over the ground."""


@numba.njit(cache=True, nogil=True)
def strike_distance(world: FightMap, node: int, place, other_node: int, other_place):
    """From the limb that strikes at a node to the nearest target's surface, metres, below 0 inside; and which target.

    Infinite, and -1, where no limb strikes or the other is out of reach of all.

    Args:
        world: the map.
        node: of the one who strikes.
        place: where it stands, x, z, yaw.
        other_node: of the opponent.
        other_place: where it stands.
    """
    limb = world.nodes[node].limb
    if limb < 0:
        return math.inf, -1
    point = world.points[node, limb]
    x, z = put(place, point[0], point[2])
    return surface_distance(world.points, other_node, other_place, x, point[1], z)


@numba.njit(cache=True, nogil=True)
def surface_distance(points: NDArray, node: int, place, x: float, y: float, z: float):
    """From a point in the world to the nearest target's surface of a fighter, and which target, as ``strike_distance``.

    Args:
        points: of the map.  # (N, 7, 3)
        node: of the fighter.
        place: where it stands, x, z, yaw.
        x: of the point, metres, as are y and z.
        y: height.
        z: likewise.
    """
    nearest, target = math.inf, -1
    if (x - place[0]) ** 2 + (z - place[1]) ** 2 > _FAR * _FAR:
        return nearest, target
    x, z = seen(place, x, z)
    for number in range(TARGET_COUNT):
        centre = points[node, FIRST_TARGET + number]
        away = math.sqrt((x - centre[0]) ** 2 + (y - centre[1]) ** 2 + (z - centre[2]) ** 2) - _RADII[number]
        if away < nearest:
            nearest, target = away, number
    return nearest, target
