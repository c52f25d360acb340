"""One-step lookahead on interpolated values: what an action is worth under a command, and which one is best.

The controller plays by these kernels, and the solver states its residual by them, so the policy that was solved for
is the policy that is played. Nearest-bin rounding would leave slow turns stuck in their bin (conventions.md 5), so
values are always interpolated.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.actions import Rules
from footwork.motion.angle import wrapped_angle


@numba.njit(cache=True, nogil=True)
def interpolate(codes: NDArray, lowest: NDArray, step: NDArray, node: int, wanted: int, heading: float) -> float:
    """The periodic linear interpolation, at ``heading``, of a row of CodedValues tabulated evenly from -pi on."""
    bins = codes.shape[2]
    turns = heading / (2.0 * math.pi) + 0.5
    place = (turns - math.floor(turns)) * bins
    low = min(int(place), bins - 1)
    high = low + 1 if low + 1 < bins else 0
    share = place - low
    code = codes[node, wanted, low] * (1.0 - share) + codes[node, wanted, high] * share
    return lowest[node, wanted] + step[node, wanted] * code


@numba.njit(cache=True, nogil=True)
def control_quality(delta: float, matches: bool, headed: bool, sigma: float) -> float:
    """SteeringTask.control_quality for one state."""
    if not matches:
        return 0.0
    if not headed:
        return 1.0
    return math.exp(-0.5 * (wrapped_angle(delta) / sigma) ** 2)


@numba.njit(cache=True, nogil=True)
def reward_of(control: float, smoothness: float, additive: bool, weight: float) -> float:
    """What a tick of control quality qc and transition quality qt earns (SteeringTask.reward)."""
    return control + weight * (smoothness - 1.0) if additive else control * smoothness


@numba.njit(cache=True, nogil=True)
def arrival_value(
    rules: Rules,
    codes: NDArray,
    lowest: NDArray,
    step: NDArray,
    there: int,
    wanted: int,
    heading: float,
    control: float,
    smoothness: float,
) -> float:
    """r + discount W of a tick that ends at a node, judged there (conventions.md 5).

    Args:
        rules: of the task.
        codes: of CodedValues, and so are ``lowest`` and ``step``.  # (N, B, H)
        there: the node arrived at.
        wanted: index of the behaviour asked for.
        heading: wanted heading less facing on arrival, radians.
        control: qc on arrival.
        smoothness: qt of the edge and the extra turn together.
    """
    reward = reward_of(control, smoothness, rules.additive, rules.weight)
    return reward + rules.discount * interpolate(codes, lowest, step, there, wanted, heading)


@numba.njit(cache=True, nogil=True)
def best_action(
    edge_start: NDArray,
    target: NDArray,
    yaw: NDArray,
    smoothness: NDArray,
    behaviour: NDArray,
    turn_limit: NDArray,
    price: NDArray,
    level: NDArray,
    turn_smoothness: NDArray,
    headed: NDArray,
    rules: Rules,
    codes: NDArray,
    lowest: NDArray,
    step: NDArray,
    node: int,
    wanted: int,
    heading: float,
    exact: bool,
) -> tuple[float, int, float]:
    """The worth, the edge and the extra turn of the best action; the first of equals wins.

    Args:
        edge_start: as of Actions, and so are the arrays up to ``rules``.
        codes: of CodedValues, and so are ``lowest`` and ``step``.  # (N, B, H)
        node: where the character is.
        wanted: index of the behaviour asked for.
        heading: wanted heading less facing, radians.
        exact: whether to look, besides the levels, at the turn that brings the facing right onto the heading.
    """
    highest, best, best_turn = -np.inf, -1, 0.0
    gaussian = bool(headed[wanted])
    for edge in range(edge_start[node], edge_start[node + 1]):
        there, left = target[edge], heading - yaw[edge]
        limit, matches = turn_limit[there], wanted == behaviour[there]
        for k in range(len(level) if limit > 0.0 else 1):
            turn = limit * level[k]
            control = control_quality(left - turn, matches, gaussian, rules.heading_sigma)
            quality = smoothness[edge] * turn_smoothness[there, k]
            value = arrival_value(rules, codes, lowest, step, there, wanted, left - turn, control, quality)
            if value > highest:
                highest, best, best_turn = value, edge, turn
        turn = wrapped_angle(left)
        if exact and abs(turn) < limit:
            quality = smoothness[edge] * math.exp(-4.0 * price[there] * math.sin(0.5 * turn) ** 2)
            value = arrival_value(rules, codes, lowest, step, there, wanted, 0.0, 1.0 if matches else 0.0, quality)
            if value > highest:
                highest, best, best_turn = value, edge, turn
    return highest, best, best_turn
