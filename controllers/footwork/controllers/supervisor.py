"""The supervisor: lets a fighter do the first thing that is reasonable, in the order evade, attack, shadow."""

from typing import NamedTuple

import numba
from numpy.typing import NDArray

from footwork.controllers.activity import ATTACK, EVADE, SHADOW
from footwork.controllers.attack import best_attack
from footwork.controllers.evade import NO_THREAT, best_evade, threat
from footwork.controllers.fight_map import FightMap
from footwork.controllers.fighters import BY_ITSELF, NO_GOAL, draw
from footwork.controllers.prediction import Paths, next_edge
from footwork.controllers.shadow import Shadowing, overreach, shadow_edge


class Minds(NamedTuple):
    """What both fighters decide by.

    Args:
        world: the map.
        styles: their numbers.  # (2,) STYLE
        shadowing: what they shadow by.
    """

    world: FightMap
    styles: NDArray
    shadowing: Shadowing


@numba.njit(cache=True, nogil=True)
def undecided(nodes: NDArray, fighter, node: int) -> bool:
    """Whether a fighter is at the end of a segment with nothing queued, and so decides now.

    Args:
        nodes: of the map.  # (N,) NODES
        fighter: FIGHTER.
        node: where it is.
    """
    if fighter.goal != NO_GOAL or not nodes[node].ends:
        return False
    return fighter.until == NO_GOAL or fighter.until == node


@numba.njit(cache=True, nogil=True)
def decide(minds: Minds, fighters: NDArray, who: int, paths: Paths):
    """What a fighter does next: the activity, the segment that its action begins with, and the edge that it takes now.

    For shadowing the segment is NO_GOAL.

    Args:
        minds: what it decides by.
        fighters: both, as they were before either decided.  # (2,) FIGHTER
        who: decides.
        paths: of both, begun from now.
    """
    world, styles, shadowing = minds
    node, fighter = paths.node[who, 0], fighters[who]
    edge = -1
    if fighter.chosen_goal != BY_ITSELF:
        activity, goal = _sent(world, node, fighter.chosen_goal)
        edge = _edge_to(world, node, fighter.chosen_goal)
    elif fighter.chosen_activity != BY_ITSELF:
        activity, goal = _wanted(world, fighters, styles, who, paths)
    else:
        activity, goal = _reasonable(world, fighters, styles, who, paths)
    if goal != NO_GOAL:
        edge = next_edge(world, node, goal, activity)
    elif edge < 0:
        edge = shadow_edge(world, shadowing, fighters, styles, who, paths)
    return activity, goal, edge


@numba.njit(cache=True, nogil=True)
def _reasonable(world, fighters, styles, who, paths):
    """The first reasonable action: the supervisor's own choice."""
    fighter, style = fighters[who], styles[who]
    struck, apart = threat(world, fighters, styles, who, paths), _apart(paths)
    further = overreach(fighter.calm)
    wary = fighter.stamina >= style.evade_cost and (struck != NO_THREAT or apart < style.near + further)
    if wary and draw(fighter) < style.readiness:
        away, goal = best_evade(world, fighters, styles, who, paths, struck)
        if goal >= 0 and (struck != NO_THREAT or away > apart):
            return EVADE, goal
    if fighter.rest <= 0 and fighter.stamina >= style.attack_cost and draw(fighter) < style.eagerness:
        away, goal = best_attack(world, fighters, styles, who, paths)
        if goal >= 0 and away <= style.reach + further:
            return ATTACK, goal
    return SHADOW, NO_GOAL


@numba.njit(cache=True, nogil=True)
def _wanted(world, fighters, styles, who, paths):
    """The best action of an activity that somebody else chose, whether it is reasonable or not."""
    fighter, style = fighters[who], styles[who]
    if fighter.chosen_activity == ATTACK and fighter.rest <= 0 and fighter.stamina >= style.attack_cost:
        goal = best_attack(world, fighters, styles, who, paths)[1]
        if goal >= 0:
            return ATTACK, goal
    if fighter.chosen_activity == EVADE and fighter.stamina >= style.evade_cost:
        goal = best_evade(world, fighters, styles, who, paths, NO_THREAT)[1]
        if goal >= 0:
            return EVADE, goal
    return SHADOW, NO_GOAL


@numba.njit(cache=True, nogil=True)
def _sent(world, node, goal):
    """The action that begins with a segment that somebody else chose, where there is a way to it."""
    here, there = world.segments[world.nodes[node].segment], world.segments[goal]
    if _is_way(world.attacks, here.attack_row, there.attack_column):
        return ATTACK, goal
    if _is_way(world.evades, here.evade_row, there.evade_column):
        return EVADE, goal
    return SHADOW, NO_GOAL


@numba.njit(cache=True, nogil=True)
def _is_way(ways, row, column):
    return row >= 0 and column >= 0 and ways[row, column].ticks >= 0


@numba.njit(cache=True, nogil=True)
def _edge_to(world, node, goal):
    """The edge from a node to the first of another segment of footwork, -1 for none."""
    if world.segments[goal].state == 0:
        for edge in range(world.nodes[node].edge_start, world.nodes[node].edge_end):
            if world.nodes[world.edges[edge].target].segment == goal:
                return edge
    return -1


@numba.njit(cache=True, nogil=True)
def _apart(paths):
    """Metres between the fighters now."""
    x = paths.place[0, 0, 0] - paths.place[1, 0, 0]
    z = paths.place[0, 0, 1] - paths.place[1, 0, 1]
    return (x * x + z * z) ** 0.5
