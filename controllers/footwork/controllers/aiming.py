"""Aiming: small turns and shifts that face a fighter to its opponent, and carry a strike to its target.

Captured strikes end where the person struck who was captured. What is missing to the target is spread over the ticks
that are left until contact, within the bounds of the fighter's style; feet that stand stay where they are
(conventions.md 13).
"""

import math

import numba
from numpy.typing import NDArray

from footwork.controllers.activity import ATTACK, SHADOW
from footwork.controllers.fight_map import FightMap, place_of
from footwork.controllers.fighters import NO_GOAL
from footwork.controllers.prediction import FURTHEST, Paths, predict
from footwork.controllers.strike_distance import FIRST_TARGET, strike_distance
from footwork.motion.angle import wrapped_angle
from footwork.motion.fighting_points import RADII
from footwork.motion.planar import after, between, put, seen, triple

_SHARE = 0.2  # of the error in facing that a tick takes away
_DEPTH = 0.5 * min(RADII)  # metres: how deep a strike is to end in its target


@numba.njit(cache=True, nogil=True)
def aim(world: FightMap, fighters: NDArray, styles: NDArray, who: int, paths: Paths, target: int, there):
    """What to add to a step: (x, z) in the world, metres, and how far to turn, radians.

    Args:
        world: the map.
        fighters: both, with what they decided.  # (2,) FIGHTER
        styles: of both.  # (2,) STYLE
        who: steps.
        paths: of both, begun from now.
        target: the node that the step leads to.
        there: the place that it leads to.
    """
    fighter, node = fighters[who], world.nodes[target]
    begun = fighter.goal == NO_GOAL or node.segment == fighter.goal
    struck = fighter.activity == ATTACK and begun and node.to_contact < 0
    if fighter.activity == SHADOW or struck:
        return 0.0, 0.0, _facing(styles[who], there, triple(paths.place[1 - who], 0))
    if fighter.activity != ATTACK or not begun or node.to_contact >= FURTHEST:
        return 0.0, 0.0, 0.0
    activity = fighters[1 - who].activity
    return _to_target(world, styles[who], who, paths, activity, target, there)


@numba.njit(cache=True, nogil=True)
def _facing(style, there, opponent):
    """A share of the turn that would face the opponent."""
    x, z = seen(there, opponent[0], opponent[1])
    return _clipped(_SHARE * math.atan2(x, z), style.turn)


@numba.njit(cache=True, nogil=True)
def _to_target(world, style, who, paths, activity, target, there):
    """This tick's part of what brings the next strike to the nearest target of an opponent in an activity."""
    left = world.nodes[target].to_contact + 1
    contact, other = target + left - 1, 1 - who
    predict(world, activity, left, paths, other)
    struck, opponent = paths.node[other, left], triple(paths.place[other], left)
    mine = after(there, between(place_of(world.nodes[target]), place_of(world.nodes[contact])))
    _, which = strike_distance(world, contact, mine, struck, opponent)
    if which < 0:
        return 0.0, 0.0, 0.0
    limb = world.points[contact, world.nodes[contact].limb]
    centre = world.points[struck, FIRST_TARGET + which]
    limb_x, limb_z = put(mine, limb[0], limb[2])
    centre_x, centre_z = put(opponent, centre[0], centre[2])
    ahead = math.atan2(limb_x - mine[0], limb_z - mine[1])
    wanted = math.atan2(centre_x - mine[0], centre_z - mine[1])
    short = math.hypot(centre_x - mine[0], centre_z - mine[1]) - _DEPTH
    short -= math.hypot(limb_x - mine[0], limb_z - mine[1])
    step = _clipped(short / left, style.lunge)
    yaw = _clipped(wrapped_angle(wanted - ahead) / left, style.turn)
    return step * math.sin(wanted), step * math.cos(wanted), yaw


@numba.njit(cache=True, nogil=True)
def _clipped(value, most):
    return min(max(value, -most), most)
