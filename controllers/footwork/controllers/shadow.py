"""Shadowing: footwork that keeps a distance and faces the opponent, by a rule or by a table of costs to come."""

import math
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.fight_map import FightMap
from footwork.controllers.fighters import draw
from footwork.controllers.prediction import FURTHEST, Paths, predict
from footwork.motion.hops import Hops
from footwork.motion.planar import after, seen, triple
from footwork.motion.shadowing_lookahead import ShadowingRules, best_hop

RESTLESS = 40
"""Decisions without an action after which a fighter roams twice as much, and begins to press."""
PRESSING = 120
"""Decisions in which one who presses comes as near as it does, and in which it backs off again."""
NEAREST = 0.75
"""Metres to which it does."""
OVERREACH = 0.35
"""Metres that one who presses strikes further at most."""
NO_TABLE = np.zeros((0, 2, 4), dtype=np.float32)
"""In place of a table's values: shadow by the rule."""
NO_TABLE.flags.writeable = False


class Shadowing(NamedTuple):
    """What fighters shadow by.

    Args:
        hops: of the state in which they do.
        rules: of the table.
        values: of the table, NO_TABLE for the rule.  # (R, D, P)

    To a table the opponent is where it would be if the distance of the fighter's style were the table's own.
    """

    hops: Hops
    rules: ShadowingRules
    values: NDArray[np.float32]


@numba.njit(cache=True, nogil=True)
def shadow_edge(
    world: FightMap, shadowing: Shadowing, fighters: NDArray, styles: NDArray, who: int, paths: Paths
) -> int:
    """The edge to take at the end of a segment.

    Args:
        world: the map.
        shadowing: what to shadow by.
        fighters: both.  # (2,) FIGHTER
        styles: of both.  # (2,) STYLE
        who: decides.
        paths: of both, begun from now.
    """
    hops, rules, values = shadowing
    segment = world.nodes[paths.node[who, 0]].segment
    row = int(hops.row[segment])
    if row < 0:
        return world.segments[segment].onward
    if draw(fighters[who]) < styles[who].roam * (1.0 + min(fighters[who].calm / RESTLESS, 1.0)):
        first, end = int(hops.start[row]), int(hops.start[row + 1])
        return int(hops.edge[first + int((end - first) * draw(fighters[who]))])
    if values.shape[0] == 0:
        return _best_by_rule(world, hops, fighters, styles, who, paths, row)
    other = triple(paths.place[1 - who], 0)
    x, z = seen(triple(paths.place[who], 0), other[0], other[1])
    x, z = _as_far(x, z, rules.distance - kept_distance(styles[who], fighters[who].calm))
    return int(hops.edge[best_hop(rules, hops, values, row, x, z)[1]])


@numba.njit(cache=True, nogil=True)
def _best_by_rule(world, hops, fighters, styles, who, paths, row):
    """The hop with the least error of distance and facing at its end, both fighters advanced to it."""
    here, other, fighter, style = triple(paths.place[who], 0), 1 - who, fighters[who], styles[who]
    distance, least, best = kept_distance(style, fighter.calm), math.inf, -1
    for hop in range(hops.start[row], hops.start[row + 1]):
        there = hops.there[hop]
        first, end = hops.tick_start[there], hops.tick_start[there + 1]
        ticks = min(end - first, FURTHEST)
        if paths.known[other] < ticks:
            predict(world, fighters[other].activity, ticks, paths, other)
        mine = after(after(here, triple(hops.step, hop)), triple(hops.tick, end - 1))
        error = shadowing_error(style, distance, mine, triple(paths.place[other], ticks))
        error += style.variety * draw(fighter)
        if error < least:
            least, best = error, hops.edge[hop]
    return best


@numba.njit(cache=True, nogil=True)
def _as_far(x, z, further):
    """A point moved away along its bearing: so a table for one distance keeps another."""
    apart = math.hypot(x, z)
    share = max(apart + further, 0.0) / apart if apart > 0.0 else 0.0
    return x * share, z * share


@numba.njit(cache=True, nogil=True)
def kept_distance(style, calm):
    """What a fighter keeps to its opponent after so many decisions without an action, metres.

    The style's distance; later ever nearer and back again, for strikes reach their target from some distances only.
    """
    phase = max(calm - RESTLESS, 0) / PRESSING % 2.0
    return style.distance - min(phase, 2.0 - phase) * max(style.distance - NEAREST, 0.0)


@numba.njit(cache=True, nogil=True)
def overreach(calm):
    """How much further from a target than its style says a fighter strikes after so many decisions, metres."""
    return OVERREACH * min(max(calm - RESTLESS, 0) / PRESSING, 1.0)


@numba.njit(cache=True, nogil=True)
def shadowing_error(style, distance, mine, theirs):
    """The weighted error of distance and facing (Chiu, Zordan and Wu 2007; weights are conventions.md 13)."""
    x, z = seen(mine, theirs[0], theirs[1])
    apart = abs(math.hypot(x, z) - distance) / style.distance_scale
    return apart + abs(math.atan2(x, z)) / style.facing_scale
