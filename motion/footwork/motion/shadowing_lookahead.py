"""Looking ahead over one segment on interpolated values: what a hop costs, and which one costs least.

Solver and controller share these kernels, so that the policy that was solved for is the one that is played.
"""

import math
from typing import NamedTuple

import numba
from numpy.typing import NDArray

from footwork.motion.hops import Hops
from footwork.motion.lookahead import bins_around
from footwork.motion.planar import seen
from footwork.motion.shadowing_task import ShadowingTask


class ShadowingRules(NamedTuple):
    """What of a ShadowingTask the kernels need besides its bins."""

    distance: float
    distance_scale: float
    facing_scale: float
    discount: float
    farthest: float


def rules_of_shadowing(task: ShadowingTask) -> ShadowingRules:
    """The scalars of a task."""
    return ShadowingRules(task.distance, task.distance_scale, task.facing_scale, task.discount, task.farthest)


@numba.njit(cache=True, nogil=True)
def shadowing_cost(rules: ShadowingRules, x: float, z: float) -> float:
    """What a tick costs that ends with the opponent at x, z in one's own planar frame (ShadowingTask)."""
    apart = abs(math.hypot(x, z) - rules.distance) / rules.distance_scale
    return apart + abs(math.atan2(x, z)) / rules.facing_scale


@numba.njit(cache=True, nogil=True)
def cell_around(farthest: float, distances: int, bearings: int, x: float, z: float) -> tuple[int, int, float, float]:
    """The lower distance and bearing that a point lies between, and its shares of the way to the next ones."""
    place = min(math.hypot(x, z) / farthest, 1.0) * (distances - 1)
    near = min(int(place), distances - 2)
    low, _, share = bins_around(math.atan2(x, z), bearings)
    return near, low, place - near, share


@numba.njit(cache=True, nogil=True)
def cost_to_come(rules: ShadowingRules, values: NDArray, row: int, x: float, z: float) -> float:
    """The interpolated value of a segment's end, of which the opponent is seen at x, z.  # values (R, D, P)"""
    distances, bearings = values.shape[1], values.shape[2]
    near, low, outward, around = cell_around(rules.farthest, distances, bearings, x, z)
    high = low + 1 if low + 1 < bearings else 0
    inner = values[row, near, low] * (1.0 - around) + values[row, near, high] * around
    outer = values[row, near + 1, low] * (1.0 - around) + values[row, near + 1, high] * around
    return inner * (1.0 - outward) + outer * outward


@numba.njit(cache=True, nogil=True)
def along_hop(
    rules: ShadowingRules, step: NDArray, tick: NDArray, begin: int, end: int, x: float, z: float
) -> tuple[float, float, float, float]:
    """The discounted cost of a hop's ticks, where the opponent is seen at its end, and the discount after it.

    Args:
        rules: of the task.
        step: the planar place of the first node there, seen from the end here.  # (3,)
        tick: planar places of the nodes there, seen from the first; rows begin..end-1.  # (T, 3)
        begin: the first of them.
        end: the one after the last.
        x: where the opponent is seen at the end of the segment before it, metres.
        z: likewise.
    """
    x, z = seen(step, x, z)
    cost, worth, x_then, z_then = 0.0, 1.0, x, z
    for at in range(begin, end):
        x_then, z_then = seen(tick[at], x, z)
        cost += worth * shadowing_cost(rules, x_then, z_then)
        worth *= rules.discount
    return cost, x_then, z_then, worth


@numba.njit(cache=True, nogil=True)
def best_hop(rules: ShadowingRules, hops: Hops, values: NDArray, row: int, x: float, z: float) -> tuple[float, int]:
    """The least cost to come of a row's hops, and the first hop that has it.

    Args:
        rules: of the task.
        hops: of the state.
        values: of the ends of its segments.  # (R, D, P)
        row: the segment at whose end one is.
        x: where the opponent is seen from there, metres.
        z: likewise.
    """
    _, start, _, onto, step, tick_start, tick = hops
    least, best = math.inf, -1
    for hop in range(start[row], start[row + 1]):
        there = int(onto[hop])
        begin, end = int(tick_start[there]), int(tick_start[there + 1])
        cost, x_then, z_then, worth = along_hop(rules, step[hop], tick, begin, end, x, z)
        cost += worth * cost_to_come(rules, values, there, x_then, z_then)
        if cost < least:
            least, best = cost, hop
    return least, best
