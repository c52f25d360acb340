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
from footwork.motion.requests import Asked
from footwork.motion.task import SLOW


@numba.njit(cache=True, nogil=True)
def bins_around(heading: float, bins: int) -> tuple[int, int, float]:
    """The two of so many headings, evenly from -pi on, that one lies between, and its share of the way."""
    turns = heading / (2.0 * math.pi) + 0.5
    place = (turns - math.floor(turns)) * bins
    low = min(int(place), bins - 1)
    return low, low + 1 if low + 1 < bins else 0, place - low


@numba.njit(cache=True, nogil=True)
def interpolate(codes: NDArray, lowest: NDArray, step: NDArray, node: int, wanted: int, heading: float) -> float:
    """The periodic linear interpolation, at ``heading``, of a row of CodedValues tabulated evenly from -pi on."""
    low, high, share = bins_around(heading, codes.shape[2])
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
def speed_quality(speed: float, wanted: float, rules: Rules) -> float:
    """SteeringTask.speed_quality for one frame."""
    if math.isnan(wanted):
        return 1.0
    apart = (speed - wanted) / (rules.speed_sigma * max(wanted, SLOW))
    return 1.0 - rules.speed_weight + rules.speed_weight * math.exp(-0.5 * apart**2)


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
    asked: Asked,
    heading: float,
    control: float,
    smoothness: float,
) -> float:
    """r + discount W of a tick that ends at a node, judged there (conventions.md 5).

    Between two levels of speed W is interpolated.

    Args:
        rules: of the task.
        codes: of CodedValues, and so are ``lowest`` and ``step``.  # (N, Q, H)
        there: the node arrived at.
        asked: what is asked for.
        heading: wanted heading less facing on arrival, radians.
        control: qc on arrival.
        smoothness: qt of the edge and the extra turn together.
    """
    reward = reward_of(control, smoothness, rules.additive, rules.weight)
    request, weight, worth = asked.low, 1.0 - asked.share, 0.0
    # One call in a loop: with two the compiler no longer inlines this, and each action costs four times as much.
    while True:
        worth += weight * interpolate(codes, lowest, step, there, request, heading)
        if request == asked.high:
            return reward + rules.discount * worth
        request, weight = asked.high, asked.share


@numba.njit(cache=True, nogil=True)
def exact_value(
    rules: Rules,
    codes: NDArray,
    lowest: NDArray,
    step: NDArray,
    smoothness: NDArray,
    price: NDArray,
    edge: int,
    there: int,
    asked: Asked,
    most: float,
    turn: float,
) -> float:
    """``arrival_value`` of an extra turn, at its price, that brings the facing right onto the heading.

    ``most`` is qc there: what the behaviour and the speed leave of it.
    """
    quality = smoothness[edge] * math.exp(-4.0 * price[there] * math.sin(0.5 * turn) ** 2)
    return arrival_value(rules, codes, lowest, step, there, asked, 0.0, most, quality)


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
    speed: NDArray,
    rules: Rules,
    codes: NDArray,
    lowest: NDArray,
    step: NDArray,
    node: int,
    asked: Asked,
    heading: float,
    exact: bool,
) -> tuple[float, int, float, int]:
    """The worth, the edge, the extra turn and the number of the best action of all; the first of equals wins.

    Of L levels, an edge that is the i-th to leave its node makes actions i L to i L + L - 1, a level each. The turn
    right onto the heading goes by its edge's first number.

    Args:
        edge_start: as of Actions, and so are the arrays up to ``rules``.
        codes: of CodedValues, and so are ``lowest`` and ``step``.  # (N, Q, H)
        node: where the character is.
        asked: what is asked for.
        heading: wanted heading less facing, radians.
        exact: whether to look, besides the levels, at the turn that brings the facing right onto the heading.
    """
    highest, best, best_turn, number = -np.inf, -1, 0.0, 0
    gaussian = bool(headed[asked.behaviour])
    for edge in range(edge_start[node], edge_start[node + 1]):
        there, left = int(target[edge]), heading - yaw[edge]
        limit, matches = turn_limit[there], asked.behaviour == behaviour[there]
        most = speed_quality(float(speed[there]), asked.speed, rules) if matches else 0.0
        first = (edge - edge_start[node]) * len(level)
        for k in range(len(level) if limit > 0.0 else 1):
            turn = limit * level[k]
            control = most * control_quality(left - turn, matches, gaussian, rules.heading_sigma)
            quality = smoothness[edge] * turn_smoothness[there, k]
            value = arrival_value(rules, codes, lowest, step, there, asked, left - turn, control, quality)
            if value > highest:
                highest, best, best_turn, number = value, edge, turn, first + k
        turn = wrapped_angle(float(left))
        if exact and abs(turn) < limit:
            value = exact_value(rules, codes, lowest, step, smoothness, price, edge, there, asked, most, turn)
            if value > highest:
                highest, best, best_turn, number = value, edge, turn, first
    return highest, best, best_turn, number


@numba.njit(cache=True, nogil=True, forceinline=True)  # handing over so many arrays costs a fifth of a decision
def best_listed_action(
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
    speed: NDArray,
    rules: Rules,
    codes: NDArray,
    lowest: NDArray,
    step: NDArray,
    shortlist: NDArray,
    node: int,
    asked: Asked,
    heading: float,
    exact: bool,
) -> tuple[int, float]:
    """The edge and the extra turn of the better of two actions: those best at the headings tabulated on either side.

    Where both are the same one there is nothing to judge, but whether to turn right onto the heading. Arguments as of
    ``best_action``, ``asked`` is not between two levels, and ``shortlist`` is that of PolicyTable.  # (N, Q, H)
    """
    highest, best, best_turn = -np.inf, -1, 0.0
    low, high, _ = bins_around(heading, shortlist.shape[2])
    one, other = int(shortlist[node, asked.low, low]), int(shortlist[node, asked.low, high])
    for number in (one, other):
        edge, k = edge_start[node] + number // len(level), number % len(level)
        there, left = int(target[edge]), heading - yaw[edge]
        limit, matches = turn_limit[there], asked.behaviour == behaviour[there]
        most = speed_quality(float(speed[there]), asked.speed, rules) if matches else 0.0
        turn, straight = limit * level[k], wrapped_angle(float(left))
        reaches = exact and abs(straight) < limit
        if one == other and not reaches:
            return edge, turn
        control = most * control_quality(left - turn, matches, bool(headed[asked.behaviour]), rules.heading_sigma)
        quality = smoothness[edge] * turn_smoothness[there, k]
        value = arrival_value(rules, codes, lowest, step, there, asked, left - turn, control, quality)
        if value > highest:
            highest, best, best_turn = value, edge, turn
        if reaches:
            value = exact_value(rules, codes, lowest, step, smoothness, price, edge, there, asked, most, straight)
            if value > highest:
                highest, best, best_turn = value, edge, straight
        if one == other:
            break
    return best, best_turn
