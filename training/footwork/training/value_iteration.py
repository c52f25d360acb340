"""Value iteration: the reward every frame promises under every command (conventions.md 5).

Modified policy iteration (Puterman and Shin 1978): a greedy sweep finds the best action of every state, then cheap
sweeps follow those actions alone, or one that goes to their ends where commands never change (``policy_values``).
Results do not depend on the number of threads.
"""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import DTypeLike, NDArray

from footwork.errors import InputError
from footwork.motion.actions import Actions, actions_of, onward_edges
from footwork.motion.coded_values import exact
from footwork.motion.graph import MotionGraph
from footwork.motion.player_model import PlayerModel
from footwork.motion.table import PolicyTable, require_axes, shortlisted
from footwork.motion.task import SteeringTask
from footwork.motion.threads import THREADS
from footwork.motion.turn_warp import turn_warp
from footwork.training.residual import backed_up
from footwork.training.sweeper import Sweeper, spans_of

TOLERANCE = 1e-3
MAX_SWEEPS = 5000
SETTLED = 1e-3
"""The part of the residual to which a policy's cycles are settled, so that what is left does not mislead the next."""
_ROUNDINGS = 16.0


@dataclass(frozen=True, eq=False)
class Solution:
    """The values that value iteration came to.

    Args:
        values: of commands expected at the next tick, in the precision that they were found in.  # (N, Q, H)
        residual: the largest change of any value in the last greedy sweep, whose result they are.
        sweeps: how many sweeps were made, of both kinds.
        improvements: how many of them were greedy.
        bytes: what the solver's arrays took.
    """

    values: NDArray
    residual: float
    sweeps: int
    improvements: int
    bytes: int


def solve(
    graph: MotionGraph,
    task: SteeringTask,
    *,
    player: PlayerModel | None = None,
    start: NDArray | None = None,
    tolerance: float = TOLERANCE,
    max_sweeps: int = MAX_SWEEPS,
    progress: Callable[[float], None] | None = None,
) -> PolicyTable:
    """The table of W = P V, where V(n, q, h) = max over actions of the action's ``lookahead.arrival_value``.

    The table's residual is that of its float32 values, found in float64 by the lookahead that controllers use.

    Args:
        graph: every node has an edge.
        task: axes, reward, actions and discount.
        player: how commands change from tick to tick; None where they never do.
        start: values to begin with, such as those of a player who is much alike; zeros where not given.  # (N, Q, H)
        tolerance: the table is converged where its residual is under this (but for the rounding to float32).
        max_sweeps: stop after so many; the table then says that it is not converged.
        progress: told the share of the work done after each greedy sweep.

    Raises:
        InputError: for other behaviours than the graph's, a node without edges, a player model or a start of other
            axes, a reward that is the same whatever is done, or more states than memory has room for.
    """
    actions, onward = _checked_actions(graph, task), onward_edges(graph)
    if player is not None:
        require_axes(player, task)
    how = {"tolerance": 0.5 * tolerance, "max_sweeps": max_sweeps, "progress": progress}
    solution = fixed_point(actions, onward, task, player=player, start=start, **how)
    values = solution.values.astype(np.float32)
    residual, best = backed_up(values, actions, onward, task, player, spans_of(actions.edge_start))
    rounding = 2.0 * float(np.spacing(np.abs(values).max()))
    converged = residual < tolerance + rounding
    return PolicyTable(task, exact(values), residual, solution.sweeps, converged, player, shortlisted(best))


def fixed_point(
    actions: Actions,
    onward: NDArray[np.int32],
    task: SteeringTask,
    *,
    player: PlayerModel | None = None,
    start: NDArray | None = None,
    tolerance: float = TOLERANCE,
    max_sweeps: int = MAX_SWEEPS,
    progress: Callable[[float], None] | None = None,
) -> Solution:
    """The values that a greedy sweep changed by less than ``tolerance``.

    They are within tolerance discount / (1 - discount) of the true ones. Sweeps are in float32 where that is fine
    enough for the tolerance, in float64 otherwise.

    Raises:
        InputError: for more states than memory has room for, and a start of another shape.
    """
    with ThreadPoolExecutor(THREADS) as pool:
        sweeper = Sweeper(actions, onward, task, player, _precision(task, tolerance), pool)
        if start is not None:
            sweeper.start_from(start)
        residual, improvements, first, done = math.inf, 0, 0.0, 0.0
        while residual >= tolerance and sweeper.sweeps < max_sweeps:
            if improvements:
                sweeper.follow(SETTLED * residual, max_sweeps - sweeper.sweeps - 1)
            residual = sweeper.improve()
            improvements, first = improvements + 1, first or residual
            done = max(done, share_done(residual, first, tolerance))  # residuals may rise on their way down
            if progress is not None:
                progress(done)
    return Solution(sweeper.values, residual, sweeper.sweeps, improvements, sweeper.bytes)


def _checked_actions(graph: MotionGraph, task: SteeringTask) -> Actions:
    if graph.behaviours != task.behaviours:
        problem = f"behaviours {', '.join(task.behaviours)}, the graph has {', '.join(graph.behaviours)}"
        raise InputError(problem, "task")
    graph.require_no_dead_ends()
    actions = actions_of(graph, task, turn_warp(graph) if task.warp > 0.0 else None)
    # the price of transitions alone is nothing that a character could be asked for
    if not _reward_varies(actions._replace(smoothness=graph.smoothness), len(task.behaviours)):
        shown = [name for index, name in enumerate(graph.behaviours) if (graph.behaviour == index).any()]
        problem = "the reward is the same whatever is done, expected a graph of several behaviours or a headed one; it "
        problem += f"shows {', '.join(shown) or 'none'} of {', '.join(graph.behaviours)}"
        raise InputError(problem, "task")
    return actions


def _reward_varies(actions: Actions, behaviours: int) -> bool:
    """Whether the reward of some command depends on the heading or on the action."""
    shown = actions.behaviour[actions.target]
    if actions.headed[np.unique(shown[shown >= 0])].any():
        return True
    if (actions.turn_smoothness[actions.target] < 1.0).any():
        return True
    for wanted in range(behaviours):
        matches = shown == wanted
        if matches.any() != matches.all():
            return True
        earns = matches.any() or actions.rules.additive
        if earns and actions.smoothness.min() < actions.smoothness.max():
            return True
    return False


def _precision(task: SteeringTask, tolerance: float) -> DTypeLike:
    """float32 where a residual of ``tolerance`` stands well above its rounding."""
    largest = (1.0 + (task.weight if task.additive else 0.0)) / (1.0 - task.discount)
    return np.float32 if tolerance > _ROUNDINGS * np.finfo(np.float32).eps * largest else np.float64


def share_done(residual: float, first: float, tolerance: float) -> float:
    """How far the residual has come on its way, which is straight in the logarithm."""
    if residual < tolerance or first <= tolerance:
        return 1.0
    return max(0.0, math.log(first / residual) / math.log(first / tolerance))
