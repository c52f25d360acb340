"""Stepping: footwork of a fighter whom a player sends somewhere, with its face to the opponent (conventions.md 13).

Wishes are to stand, or a direction seen from the fighter. What each segment of footwork is worth for each wish is
found by value iteration over the hops between them: a tick gains by what it goes in the direction, and loses by a
quarter of what it goes aside, by all that it goes where standing is wished, and a little by its turn: aiming undoes it.
"""

import math

import numba
import numpy as np

from footwork.motion.hops import Hops
from footwork.motion.planar import between, triple

DIRECTIONS = 8
STAND = 0
"""The wish to stand; wish 1 + d is to go d eighths of a turn to the left of straight ahead."""
_TURN_SCALE = 20.0  # radians of turn that cost as much as a metre
_ASIDE = 0.25
_DISCOUNT = 0.97  # a tick
_CONVERGED = 1e-4
_MOST_SWEEPS = 1000


def wish_towards(direction: float) -> int:
    """The wish to go nearest to a direction, radians, positive left."""
    return 1 + round(direction * DIRECTIONS / (2.0 * math.pi)) % DIRECTIONS


@numba.njit(cache=True, nogil=True)
def _tick_cost(step, wish):
    """What a tick costs that takes a step (x, z, yaw), metres."""
    turn = abs(step[2]) / _TURN_SCALE
    if wish == STAND:
        return math.hypot(step[0], step[1]) + turn
    angle = (wish - 1) * 2.0 * math.pi / DIRECTIONS
    gone = step[0] * math.sin(angle) + step[1] * math.cos(angle)
    aside = step[0] * math.cos(angle) - step[1] * math.sin(angle)
    return turn + _ASIDE * abs(aside) - gone


@numba.njit(cache=True, nogil=True)
def _costs_within(hops, discount):
    """What segments cost from their first node to their last, and the discount of all that follows.  # (R, W), (R,)"""
    rows = hops.tick_start.shape[0] - 1
    costs, later = np.zeros((rows, 1 + DIRECTIONS)), np.ones(rows)
    for row in range(rows):
        for tick in range(hops.tick_start[row], hops.tick_start[row + 1] - 1):
            step = between(triple(hops.tick, tick), triple(hops.tick, tick + 1))
            for wish in range(1 + DIRECTIONS):
                costs[row, wish] += later[row] * _tick_cost(step, wish)
            later[row] *= discount
    return costs, later


@numba.njit(cache=True, nogil=True)
def _best(hops, discount, within, later, values, row, wish):
    """The least cost to come from the end of a row's segment, and the hop that has it."""
    least, best = math.inf, -1
    for hop in range(hops.start[row], hops.start[row + 1]):
        there = hops.there[hop]
        cost = _tick_cost(triple(hops.step, hop), wish)
        cost += discount * (within[there, wish] + later[there] * values[there, wish])
        if cost < least:
            least, best = cost, hop
    return least, best


@numba.njit(cache=True, nogil=True)
def _solved(hops, discount, converged, most_sweeps):
    """The best hop for each row and wish, by value iteration in place.  # (R, W)"""
    within, later = _costs_within(hops, discount)
    values, chosen = np.zeros(within.shape), np.zeros(within.shape, np.int32)
    for _ in range(most_sweeps):
        change = 0.0
        for row in range(within.shape[0]):
            for wish in range(1 + DIRECTIONS):
                least, chosen[row, wish] = _best(hops, discount, within, later, values, row, wish)
                change = max(change, abs(least - values[row, wish]))
                values[row, wish] = least
        if change < converged:
            break
    return chosen


class Stepping:
    """The footwork of players on one graph.

    Args:
        hops: between the segments of footwork.
    """

    def __init__(self, hops: Hops) -> None:
        self._hops = hops
        self._chosen = _solved(hops, _DISCOUNT, _CONVERGED, _MOST_SWEEPS)

    def edge(self, segment: int, wish: int) -> int:
        """The edge to take at the end of a segment for a wish, -1 at that of one that is no footwork."""
        row = int(self._hops.row[segment])
        return -1 if row < 0 else int(self._hops.edge[self._chosen[row, wish]])
