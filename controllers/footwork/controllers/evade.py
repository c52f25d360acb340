"""The evasion: what ends furthest from the opponent and is not struck on the way, where there is reason to evade."""

import math

import numba
from numpy.typing import NDArray

from footwork.controllers.activity import ATTACK
from footwork.controllers.fight_map import FightMap, place_of
from footwork.controllers.fighters import NO_GOAL, draw
from footwork.controllers.prediction import FURTHEST, Paths, predict
from footwork.controllers.strike_distance import strike_distance
from footwork.motion.planar import after, between, put, triple

NO_THREAT = 0


@numba.njit(cache=True, nogil=True)
def threat(world: FightMap, fighters: NDArray, styles: NDArray, who: int, paths: Paths) -> int:
    """In how many ticks the opponent's queued strike is predicted to land on one who goes on; NO_THREAT for none.

    Strikes are taken to land that end within the opponent's own reach, and within the warning of the one who decides.

    Args:
        world: the map.
        fighters: both.  # (2,) FIGHTER
        styles: of both.  # (2,) STYLE
        who: decides.
        paths: of both, begun from now.
    """
    other = 1 - who
    opponent = fighters[other]
    if opponent.activity != ATTACK or opponent.until == NO_GOAL:
        return NO_THREAT
    ticks = min(int(styles[who].warning), FURTHEST)
    predict(world, opponent.activity, ticks, paths, other)
    for tick in range(1, ticks + 1):
        node = paths.node[other, tick]
        if world.nodes[node].limb >= 0:
            predict(world, fighters[who].activity, tick, paths, who)
            mine, theirs = triple(paths.place[who], tick), triple(paths.place[other], tick)
            distance, _ = strike_distance(world, node, theirs, paths.node[who, tick], mine)
            return tick if distance <= styles[other].reach else NO_THREAT
        if node == opponent.until:
            break
    return NO_THREAT


@numba.njit(cache=True, nogil=True)
def best_evade(world: FightMap, fighters: NDArray, styles: NDArray, who: int, paths: Paths, struck: int):
    """The evasion that is predicted to end furthest from the opponent, and how far, metres; -1 where there is none.

    A random part of ``variety`` is added to each distance.

    Args:
        world: the map.
        fighters: both.  # (2,) FIGHTER
        styles: of both.  # (2,) STYLE
        who: decides, at the end of a segment.
        paths: of both, begun from now.
        struck: in how many ticks a strike is to be out of reach, NO_THREAT for none: evasions that have not begun by
            then, or are within reach of it, do not count.
    """
    other, fighter, variety = 1 - who, fighters[who], styles[who].variety
    here, place = triple(paths.place[who], 0), paths.place[other]
    row = world.segments[world.nodes[paths.node[who, 0]].segment].evade_row
    most, best = -math.inf, -1
    if row < 0:
        return most, best
    ways = world.evades[row]
    for column in range(ways.shape[0]):
        way = ways[column]
        end = way.when
        if end < 0 or end > FURTHEST:
            continue
        if paths.known[other] < end:
            predict(world, fighters[other].activity, end, paths, other)
        x, z = put(here, way.hips_x, way.hips_z)
        distance = math.hypot(x - place[end, 0], z - place[end, 1])
        # the dearer question is asked of the better ones only
        if distance + variety <= most:
            continue
        goal = world.evade_goals[column]
        if struck != NO_THREAT and not _gets_away(world, way, goal, who, paths, struck, styles[other].reach):
            continue
        distance += variety * draw(fighter)
        if distance > most:
            most, best = distance, goal
    return most, best


@numba.njit(cache=True, nogil=True)
def _gets_away(world, way, goal, who, paths, struck, reach):
    """Whether an evasion is under way, and out of a strike's reach, when the strike comes to its contact."""
    other, first = 1 - who, world.segments[goal].first
    then = first + struck - way.ticks
    if then < first or then > world.segments[goal].action_end:
        return False
    start = after(triple(paths.place[who], 0), place_of(way))
    mine = after(start, between(place_of(world.nodes[first]), place_of(world.nodes[then])))
    theirs = triple(paths.place[other], struck)
    return strike_distance(world, paths.node[other, struck], theirs, then, mine)[0] > reach
