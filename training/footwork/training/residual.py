"""The Bellman residual of a finished table, in float64 and by the very lookahead that controllers play by."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.actions import Actions, onward_actions
from footwork.motion.lookahead import best_action
from footwork.motion.player_model import PlayerModel
from footwork.motion.requests import Requests, asked_for, holding_speed
from footwork.motion.task import SteeringTask
from footwork.motion.threads import THREADS


def backed_up(
    values: NDArray,
    actions: Actions,
    onward: NDArray[np.int32],
    task: SteeringTask,
    player: PlayerModel | None,
    spans: Sequence[tuple[int, int]],
) -> tuple[float, NDArray[np.int32]]:
    """The largest difference between values and what one backup makes of them, and its best actions by number.

    Values that differ from the true ones anywhere by more than this over 1 - discount cannot be.

    Args:
        values: of commands expected at the next tick.  # (N, Q, H)
        actions: of the graph and the task.
        onward: ``actions.onward_edges``.  # (N,)
        task: what the values are of.
        player: how commands change; None where they never do.
        spans: stretches of nodes to share out to threads, as (begin, end).
    """
    following, headings = np.ascontiguousarray(values, dtype=np.float64), task.headings
    holding = None if player is None else holding_speed(player, task.requests)
    best, best_onward = np.zeros(values.shape, np.int32), np.zeros(values.shape, np.int32)
    with ThreadPoolExecutor(THREADS) as pool:
        for tick in range(task.segment_ticks):
            backed = np.empty(values.shape)
            choices = onward_actions(actions, onward) if tick else actions
            into = backed, best_onward if tick else best
            jobs = [pool.submit(_back_up, choices, task.requests, headings, *span, following, *into) for span in spans]
            for job in jobs:
                job.result()
            following = backed if holding is None else holding.expected(backed)
    return float(np.abs(following - values).max()), best


@numba.njit(cache=True, nogil=True)
def _back_up(
    actions: Actions,
    requests: Requests,
    headings: NDArray,
    begin: int,
    end: int,
    values: NDArray,
    backed: NDArray,
    best: NDArray,
) -> None:
    """Write the worth and the number of the best action at each heading of the nodes begin..end-1."""
    edge_start, target, yaw, smoothness, shown, turn_limit, price, level, turn_smoothness, headed, speed, rules = (
        actions
    )
    lowest, step = np.zeros(values.shape[:2]), np.ones(values.shape[:2])
    behaviours, speeds = requests
    for node in range(begin, end):
        for wanted in range(values.shape[1]):
            asked = asked_for(requests, behaviours[wanted], speeds[wanted])
            for h in range(values.shape[2]):
                found = best_action(
                    edge_start,
                    target,
                    yaw,
                    smoothness,
                    shown,
                    turn_limit,
                    price,
                    level,
                    turn_smoothness,
                    headed,
                    speed,
                    rules,
                    values,
                    lowest,
                    step,
                    node,
                    asked,
                    headings[h],
                    False,
                )
                backed[node, wanted, h], best[node, wanted, h] = found[0], found[3]
