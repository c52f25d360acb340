"""Value iteration for shadowing: the cost to come of every segment's end (conventions.md 11).

A semi-Markov decision process (Howard 1971): a hop lasts as many ticks as the segment it leads to, whose costs are
discounted one by one. Solved by modified policy iteration (Puterman and Shin 1978) in sweeps from one copy of the
values to another, so that results do not depend on the number of threads.
"""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.annotation import Annotation
from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.hops import Hops, hops_within
from footwork.motion.shadowing_lookahead import ShadowingRules, along_hop, best_hop, cell_around, rules_of_shadowing
from footwork.motion.shadowing_table import ShadowingTable
from footwork.motion.shadowing_task import ShadowingTask
from footwork.motion.threads import THREADS
from footwork.training.room import require_room
from footwork.training.value_iteration import share_done

TOLERANCE = 1e-2
"""Costs to come are about 1 / (1 - discount) times those of a tick, which are of the size of 1."""
MAX_SWEEPS = 5000
EVALUATIONS = 20
_HOP_BYTES = 8 + 4 + 4 + 4  # in each cell: its cost, the cell it comes to and its two shares
_VALUE_BYTES = 8 + 8 + 4 + 4  # both copies, the choice, and the result


def solve_shadowing(
    graph: MotionGraph,
    annotation: Annotation,
    state: int,
    task: ShadowingTask,
    *,
    tolerance: float = TOLERANCE,
    max_sweeps: int = MAX_SWEEPS,
    progress: Callable[[float], None] | None = None,
) -> ShadowingTable:
    """The table of V(g, d, phi) = min over hops of their ticks' discounted costs and the discounted V at their end.

    The table's residual is that of its float32 values, found in float64 by the lookahead that controllers use.

    Args:
        graph: the graph.
        annotation: its segments.
        state: the number of the state whose transitions are chosen among.
        task: cost and axes.
        tolerance: the table is converged where its residual is under this (but for the rounding to float32).
        max_sweeps: stop after so many; the table then says that it is not converged.
        progress: told the share of the work done after each greedy sweep.

    Raises:
        InputError: for a segment that none of the state leads on from, and more states than memory has room for.
    """
    hops = hops_within(graph, annotation, state)
    segments, cells = len(hops.start) - 1, task.distance_bins * task.bearing_bins
    needed = (len(hops.edge) * _HOP_BYTES + segments * _VALUE_BYTES) * cells
    require_room(needed, f"{len(hops.edge)} hops", "a lower threshold", annotation.machine.place(state))
    with ThreadPoolExecutor(THREADS) as pool:
        sweeper = _Sweeper(hops, task, pool)
        residual, first = math.inf, 0.0
        while residual >= 0.5 * tolerance and sweeper.sweeps < max_sweeps:
            if first:
                sweeper.follow(min(EVALUATIONS, max_sweeps - sweeper.sweeps - 1))
            residual = sweeper.improve()
            first = first or residual
            if progress is not None:
                progress(share_done(residual, first, 0.5 * tolerance))
        values = frozen(sweeper.values, np.float32)
        residual = sweeper.residual_of(values)
    rounding = 2.0 * float(np.spacing(np.abs(values).max()))
    return ShadowingTable(task, state, values, residual, sweeper.sweeps, residual < tolerance + rounding)


class _Sweeper:
    """The values and what every hop from every state costs and leads to; H hops, S = D P cells a segment."""

    def __init__(self, hops: Hops, task: ShadowingTask, pool: ThreadPoolExecutor) -> None:
        rows, hop_count, cells = len(hops.start) - 1, len(hops.edge), task.distance_bins * task.bearing_bins
        self._hops, self._rules, self._pool = hops, rules_of_shadowing(task), pool
        self._axes = _cell_places(task)
        self._shape = rows, task.distance_bins, task.bearing_bins
        cuts = np.searchsorted(hops.start, np.linspace(0, hop_count, 2 * THREADS + 1)[1:-1])
        self._spans = list(pairwise(np.unique([0, *cuts.tolist(), rows]).tolist()))
        self._cost, self._worth = np.empty((hop_count, cells)), np.empty(hop_count)
        self._cell = np.empty((hop_count, cells), dtype=np.int32)
        self._share = np.empty((2, hop_count, cells), dtype=np.float32)
        self._choice = np.zeros((rows, cells), dtype=np.int32)
        # bearings wrap: the first comes again after the last, so that the next one always lies beside
        self._copies = np.zeros((2, rows, task.distance_bins, task.bearing_bins + 1))
        self.sweeps = 0
        self._run(_lay_out, self._rules, hops, *self._axes, *self._shape[1:], *self._model)

    @property
    def _model(self) -> tuple[NDArray, ...]:
        return self._cost, self._worth, self._cell, self._share

    @property
    def values(self) -> NDArray[np.float64]:
        """The current values.  # (R, D, P)"""
        return self._copies[0, :, :, :-1]

    def improve(self) -> float:
        """Make a greedy sweep; the largest change of a value."""
        self._sweep(_improve, self._hops.start, *self._model, self._choice)
        return float(np.abs(self._copies[0] - self._copies[1]).max())

    def follow(self, sweeps: int) -> None:
        """Make sweeps that follow the hops of the last greedy one."""
        for _ in range(sweeps):
            self._sweep(_follow, *self._model, self._choice)

    def residual_of(self, values: NDArray[np.float32]) -> float:
        """The largest change of any of these values by one more backup."""
        backed = np.empty(self._shape)
        self._run(_back_up, self._rules, self._hops, *self._axes, values, backed)
        return float(np.abs(backed - values).max())

    def _sweep(self, kernel: Callable, *what: object) -> None:
        self._run(kernel, *what, *self._copies)
        self._copies = self._copies[::-1]
        self.sweeps += 1

    def _run(self, kernel: Callable, *what: object) -> None:
        for job in [self._pool.submit(kernel, *span, *what) for span in self._spans]:
            job.result()


def _cell_places(task: ShadowingTask) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where the opponent is in each cell of the axes, x and z.  # (D P,) each"""
    distance = np.linspace(0.0, task.farthest, task.distance_bins)[:, None]
    bearing = -np.pi + 2.0 * np.pi * np.arange(task.bearing_bins) / task.bearing_bins
    return (distance * np.sin(bearing)).ravel(), (distance * np.cos(bearing)).ravel()


@numba.njit(cache=True, nogil=True)
def _lay_out(
    begin: int,
    end: int,
    rules: ShadowingRules,
    hops: Hops,
    x: NDArray,
    z: NDArray,
    distances: int,
    bearings: int,
    cost: NDArray,
    worth: NDArray,
    cell: NDArray,
    share: NDArray,
) -> None:
    """Write what the hops from rows begin..end-1 cost from every cell, and where among the values they come to."""
    _, start, _, onto, step, tick_start, tick = hops
    for hop in range(start[begin], start[end]):
        there = int(onto[hop])
        base, first, last = there * distances, int(tick_start[there]), int(tick_start[there + 1])
        for at in range(x.shape[0]):
            paid, x_then, z_then, left = along_hop(rules, step[hop], tick, first, last, x[at], z[at])
            near, low, outward, around = cell_around(rules.farthest, distances, bearings, x_then, z_then)
            cost[hop, at], worth[hop] = paid, left
            cell[hop, at] = (base + near) * (bearings + 1) + low
            share[0, hop, at], share[1, hop, at] = outward, around


@numba.njit(cache=True, nogil=True)
def _worth_at(flat: NDArray, place: int, stride: int, outward: float, around: float) -> float:
    """The value between four cells that begin at a place; the next distance lies a stride further."""
    inner = flat[place] + around * (flat[place + 1] - flat[place])
    beyond = place + stride
    outer = flat[beyond] + around * (flat[beyond + 1] - flat[beyond])
    return inner + outward * (outer - inner)


@numba.njit(cache=True, nogil=True)
def _improve(
    begin: int,
    end: int,
    start: NDArray,
    cost: NDArray,
    worth: NDArray,
    cell: NDArray,
    share: NDArray,
    choice: NDArray,
    old: NDArray,
    new: NDArray,
) -> None:
    """Write the least cost to come of rows begin..end-1 into the new copy, and the first hop that has it."""
    flat, stride, bearings = old.reshape(-1), old.shape[2], old.shape[2] - 1
    for row in range(begin, end):
        for at in range(cost.shape[1]):
            least = np.inf
            for hop in range(start[row], start[row + 1]):
                there = _worth_at(flat, cell[hop, at], stride, share[0, hop, at], share[1, hop, at])
                value = cost[hop, at] + worth[hop] * there
                if value < least:
                    least, choice[row, at] = value, hop
            _put(new, row, at // bearings, at % bearings, least)


@numba.njit(cache=True, nogil=True)
def _follow(
    begin: int,
    end: int,
    cost: NDArray,
    worth: NDArray,
    cell: NDArray,
    share: NDArray,
    choice: NDArray,
    old: NDArray,
    new: NDArray,
) -> None:
    """Write what the chosen hops cost of rows begin..end-1 into the new copy."""
    flat, stride, bearings = old.reshape(-1), old.shape[2], old.shape[2] - 1
    for row in range(begin, end):
        for at in range(cost.shape[1]):
            hop = choice[row, at]
            there = _worth_at(flat, cell[hop, at], stride, share[0, hop, at], share[1, hop, at])
            _put(new, row, at // bearings, at % bearings, cost[hop, at] + worth[hop] * there)


@numba.njit(cache=True, nogil=True)
def _put(values: NDArray, row: int, distance: int, bearing: int, value: float) -> None:
    """Write a value, that of the first bearing also after the last."""
    values[row, distance, bearing] = value
    if bearing == 0:
        values[row, distance, values.shape[2] - 1] = value


@numba.njit(cache=True, nogil=True)
def _back_up(
    begin: int,
    end: int,
    rules: ShadowingRules,
    hops: Hops,
    x: NDArray,
    z: NDArray,
    values: NDArray,
    backed: NDArray,
) -> None:
    """Write the least cost to come of rows begin..end-1 by the lookahead that controllers use."""
    bearings = values.shape[2]
    for row in range(begin, end):
        for at in range(x.shape[0]):
            backed[row, at // bearings, at % bearings] = best_hop(rules, hops, values, row, x[at], z[at])[0]
