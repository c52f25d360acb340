"""Value iteration's arrays, and sweeps over them on all processors."""

from collections.abc import Callable
from concurrent.futures import Executor
from itertools import pairwise
from typing import Any

import numba
import numpy as np
from numpy.typing import DTypeLike, NDArray

from footwork.errors import InputError
from footwork.motion.actions import Actions, onward_actions
from footwork.motion.arrays import require_finite, require_shape
from footwork.motion.player_model import PlayerModel, persistent_player
from footwork.motion.requests import holding_speed
from footwork.motion.task import SteeringTask
from footwork.training.policy_values import WORKING_BYTES, settle
from footwork.training.room import require_room
from footwork.training.sweeps import evaluate, heading_qualities, improve, no_policy, speed_qualities

EVALUATIONS = 20

SPANS = 8
"""A fixed number, as results depend on it: they must not on how many processors there are."""


def spans_of(edge_start: NDArray[np.int32]) -> list[tuple[int, int]]:
    """Stretches of nodes, as (begin, end), with about as many edges each."""
    cuts = np.searchsorted(edge_start, np.linspace(0, edge_start[-1], SPANS + 1)[1:-1])
    edges = np.unique([0, *cuts.tolist(), len(edge_start) - 1]).tolist()
    return list(pairwise(edges))


class Sweeper:
    """Sweeps over the values of a task: greedy ones, and ones that follow the policy found last.

    With N Q H states, numbers of z bytes and R = 1 where a decision holds for one tick, else 2, it takes about
    N Q H ((1 + R) z + R (2 z + 4)) bytes: 20 a state in float32, 36 in float64; 36 and 64 where R is 2. Where cycles
    are settled it is at most 56 a state more.

    Args:
        actions: of the graph and the task.
        onward: ``actions.onward_edges``.  # (N,)
        task: what the values are of.
        player: how commands change; None where they never do.
        kind: float32 or float64.
        pool: runs the sweeps.

    Attributes:
        sweeps: how many were made.

    Raises:
        InputError: for more states than memory has room for.
    """

    def __init__(
        self,
        actions: Actions,
        onward: NDArray[np.int32],
        task: SteeringTask,
        player: PlayerModel | None,
        kind: DTypeLike,
        pool: Executor,
    ) -> None:
        requests = task.requests
        nodes, asked, headings = len(actions.behaviour), len(requests.behaviour), task.heading_bins
        states, copies = nodes * asked * headings, 1 + min(task.segment_ticks, 2)
        self._settles = player is None and task.segment_ticks == 1
        self.bytes = _bytes_needed(states, np.dtype(kind).itemsize, copies) + self._settles * WORKING_BYTES * states
        if copies * nodes * (headings + 1) * asked > np.iinfo(np.int32).max:
            raise InputError(f"{states} states, expected fewer: places in their values are 32 bits wide", "task")
        require_room(self.bytes, f"{states} states", "fewer frames or heading bins", "task")
        change = holding_speed(player or persistent_player(task.behaviours, headings), requests).change
        self._player = change.astype(kind), player is None
        self._actions = actions
        self._rewards = requests.behaviour, speed_qualities(actions.speed, task, kind), heading_qualities(task, kind)
        self._discount = np.asarray(task.discount, kind)[()]
        self._pool, self._spans = pool, spans_of(actions.edge_start)
        self._policy, self._ticks = no_policy(states, kind), task.segment_ticks
        self._copies = np.zeros((copies, nodes, headings + 1, asked), kind)
        self._now, self._spare, self.sweeps = 0, list(range(1, copies)), 0
        if self._ticks > 1:
            self._onward = no_policy(states, kind)
            self._spare.append(self._sweep(improve, self._onward, onward_actions(actions, onward), *self._rewards))

    @property
    def values(self) -> NDArray:
        """The current values.  # (N, Q, H)"""
        return self._copies[self._now, :, :-1].transpose(0, 2, 1)

    def start_from(self, values: NDArray) -> None:
        """Put values in the place of the current ones.  # (N, Q, H)

        Raises:
            InputError: for another shape or values that are not finite.
        """
        require_shape(values, self.values.shape, "values to start from", "task")
        require_finite(values, "values to start from", "task")
        now = self._copies[self._now]
        now[:, :-1] = values.transpose(0, 2, 1)
        now[:, -1] = now[:, 0]

    def improve(self) -> float:
        """Make a greedy sweep, and add what it shows all values of a request to lack alike.

        A sweep that changes values by least to most leaves the true ones between discount / (1 - discount) of the
        least and of the most above them (MacQueen 1966), for each request by itself if commands never change. The
        middle is added where that halves the largest error that can be: elsewhere it could lead away, as sweeps in
        place spread what is alike unevenly.

        Returns:
            A residual: the true values are within discount / (1 - discount) times as much.
        """
        old = self._now
        self._now = self._held(self._sweep(improve, self._policy, self._actions, *self._rewards))
        self._spare.append(old)
        jobs = [self._pool.submit(_change, self._copies[old], self._copies[self._now], *span) for span in self._spans]
        bounds = np.array([job.result() for job in jobs])
        least, most = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
        if not self._player[1]:
            least, most = least.min(), most.max()
        middle, half = 0.5 * (least + most), 0.5 * (most - least)
        alike = half < 0.5 * np.abs(middle)
        discount = float(self._discount) ** self._ticks
        lack = np.where(alike, middle * discount / (1.0 - discount), 0.0).astype(self._copies.dtype)
        if lack.any():
            self._copies[self._now] += lack
        return float(np.max(np.where(alike, half, np.abs(middle) + half)))

    def follow(self, tolerance: float, most: int) -> None:
        """Come closer to what the policy of the last greedy sweep is worth, by ``most`` sweeps or fewer.

        Where commands never change and a decision holds for one tick, one sweep goes as far as the policy leads, with
        its cycles settled to ``tolerance``.
        """
        if self._settles and most:
            settled = self._policy, self._discount
            limits = tolerance, EVALUATIONS, self._copies, self._now
            self._run([(settle, *settled, wanted, *limits) for wanted in range(self._copies.shape[3])])
            return
        for _ in range(min(EVALUATIONS, most)):
            old = self._now
            self._now = self._held(self._sweep(evaluate, self._policy, self._discount, self._ticks == 1))
            self._spare.append(old)

    def _held(self, copy: int) -> int:
        """The values at the tick of a decision from those after its last tick: it holds in between."""
        for _ in range(self._ticks - 1):
            before = self._sweep(evaluate, self._onward, self._discount, False, old=copy)
            self._spare.append(copy)
            copy = before
        return copy

    def _sweep(self, kernel: Callable, *what: Any, old: int | None = None) -> int:
        """Run a kernel over all nodes, from one copy of the values to a spare one, which it returns."""
        old, new = self._now if old is None else old, self._spare.pop()
        self._run([(kernel, *what, *self._player, *span, self._copies, old, new) for span in self._spans])
        return new

    def _run(self, calls: list[tuple[Any, ...]]) -> None:
        """Make a sweep of calls that do not hang on one another, each (kernel, *arguments)."""
        for job in [self._pool.submit(*call) for call in calls]:
            job.result()
        self.sweeps += 1


@numba.njit(cache=True, nogil=True)
def _change(before: NDArray, after: NDArray, begin: int, end: int) -> NDArray:
    """The least and the greatest change of each request in the nodes begin..end-1.  # (2, Q)"""
    bounds = np.empty((2, before.shape[2]))
    bounds[0], bounds[1] = np.inf, -np.inf
    for node in range(begin, end):
        for h in range(before.shape[1]):
            for wanted in range(before.shape[2]):
                change = after[node, h, wanted] - before[node, h, wanted]
                bounds[0, wanted] = min(bounds[0, wanted], change)
                bounds[1, wanted] = max(bounds[1, wanted], change)
    return bounds


def _bytes_needed(states: int, number: int, copies: int) -> int:
    """Copies of the values, and for each but one a policy."""
    return states * (copies * number + (copies - 1) * (2 * number + 4))
