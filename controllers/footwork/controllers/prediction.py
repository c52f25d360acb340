"""Where fighters will be: advanced along their queued ways, then as the capture goes on (conventions.md 13)."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ATTACK
from footwork.controllers.fight_map import FightMap, place_of
from footwork.controllers.fighters import NO_GOAL
from footwork.motion.planar import after, triple

FURTHEST = 90
"""Ticks that are looked ahead."""


class Paths(NamedTuple):
    """Room for the predicted paths of two fighters: where each is after 0, 1, 2 ... ticks.

    Args:
        node: of each.  # (2, FURTHEST + 1) int64
        place: of each.  # (2, FURTHEST + 1, 3) float64
        known: up to which tick.  # (2,) int64
        goal: what the queued way leads to that is still ahead then, NO_GOAL for none.  # (2,) int64
    """

    node: NDArray[np.int64]
    place: NDArray[np.float64]
    known: NDArray[np.int64]
    goal: NDArray[np.int64]


def no_paths() -> Paths:
    """Room for two paths."""
    ticks = FURTHEST + 1
    return Paths(np.zeros((2, ticks), np.int64), np.zeros((2, ticks, 3)), np.zeros(2, np.int64), np.zeros(2, np.int64))


@numba.njit(cache=True, nogil=True)
def next_edge(world: FightMap, node: int, goal: int, activity: int) -> int:
    """The edge that a fighter takes next who chooses nothing: along its way, or else onward.

    Args:
        world: the map.
        node: where it is.
        goal: the segment that its way leads to, NO_GOAL for none or where it is there already.
        activity: which it is on the way to.
    """
    at = world.nodes[node]
    if not at.ends:
        return at.edge_start
    segment = world.segments[at.segment]
    if goal == NO_GOAL:
        return segment.onward
    if activity == ATTACK:
        return world.attacks[segment.attack_row, world.segments[goal].attack_column].edge
    return world.evades[segment.evade_row, world.segments[goal].evade_column].edge


@numba.njit(cache=True, nogil=True)
def begin_paths(fighters: NDArray, node: NDArray, place: NDArray, paths: Paths) -> None:
    """Forget what was predicted, and begin from where two fighters are.  # FIGHTER (2,), (2,), (2, 3)"""
    for who in range(2):
        paths.node[who, 0] = node[who]
        for k in range(3):
            paths.place[who, 0, k] = place[who, k]
        paths.known[who], paths.goal[who] = 0, fighters[who].goal


@numba.njit(cache=True, nogil=True)
def predict(world: FightMap, activity: int, ticks: int, paths: Paths, who: int) -> None:
    """Make a fighter's path known up to a tick, FURTHEST at most.

    Args:
        world: the map.
        activity: of the fighter.
        ticks: up to which.
        paths: begun from now.
        who: which of them.
    """
    nodes, places, goal = paths.node[who], paths.place[who], paths.goal[who]
    last = min(ticks, FURTHEST)
    for tick in range(paths.known[who], last):
        edge = world.edges[next_edge(world, nodes[tick], goal, activity)]
        x, z, yaw = after(triple(places, tick), place_of(edge))
        nodes[tick + 1] = edge.target
        places[tick + 1, 0], places[tick + 1, 1], places[tick + 1, 2] = x, z, yaw
        if goal != NO_GOAL and world.nodes[edge.target].segment == goal:
            goal = NO_GOAL
    paths.known[who], paths.goal[who] = max(paths.known[who], last), goal
