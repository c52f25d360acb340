"""The attack: the strike that is predicted to end nearest to the opponent, if it ends near enough and soon enough."""

import math

import numba
from numpy.typing import NDArray

from footwork.controllers.fight_map import FightMap
from footwork.controllers.fighters import draw
from footwork.controllers.prediction import FURTHEST, Paths, predict
from footwork.controllers.strike_distance import surface_distance
from footwork.motion.planar import put, triple

CLOSEST = 0.65
"""Metres between the fighters' hips at contact: a strike that would bring them closer is not thrown."""


@numba.njit(cache=True, nogil=True)
def best_attack(world: FightMap, fighters: NDArray, styles: NDArray, who: int, paths: Paths):
    """The attack whose contact is predicted to be nearest to a target, and how near, metres; -1 where there is none.

    Both fighters are advanced to the contact of each attack: this one along the way to it, the opponent along its
    queued way. A random part of ``variety`` is added to each distance.

    Args:
        world: the map.
        fighters: both.  # (2,) FIGHTER
        styles: of both.  # (2,) STYLE
        who: decides, at the end of a segment.
        paths: of both, begun from now.
    """
    other, fighter, style = 1 - who, fighters[who], styles[who]
    here, node, place = triple(paths.place[who], 0), paths.node[other], paths.place[other]
    row = world.segments[world.nodes[paths.node[who, 0]].segment].attack_row
    least, best = math.inf, -1
    if row < 0:
        return least, best
    ways, horizon = world.attacks[row], min(style.horizon, FURTHEST)
    for column in range(ways.shape[0]):
        way = ways[column]
        ticks = way.when
        if ticks < 0 or ticks > horizon:
            continue
        if paths.known[other] < ticks:
            predict(world, fighters[other].activity, ticks, paths, other)
        x, z = put(here, way.limb_x, way.limb_z)
        hips_x, hips_z = put(here, way.hips_x, way.hips_z)
        if math.hypot(hips_x - place[ticks, 0], hips_z - place[ticks, 1]) < CLOSEST:
            continue
        distance, _ = surface_distance(world.points, node[ticks], triple(place, ticks), x, way.limb_y, z)
        if distance < math.inf:
            distance += style.variety * draw(fighter)
        if distance < least:
            least, best = distance, column
    return least, world.attack_goals[best] if best >= 0 else -1
