"""The kernels of steering: the edge and the extra turn that a policy table makes best, by one-step lookahead."""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.policy import Policy
from footwork.motion.actions import Actions
from footwork.motion.coded_values import CodedValues
from footwork.motion.lookahead import best_action, best_listed_action
from footwork.motion.moves import fill_moves
from footwork.motion.requests import Requests, asked_for
from footwork.motion.turn_warp import turn_about


@numba.njit(cache=True, nogil=True)
def decide(
    actions: Actions,
    coded: CodedValues,
    shortlist: NDArray,
    requests: Requests,
    onward: NDArray,
    segment_ticks: int,
    exact: bool,
    slot: NDArray,
    node: NDArray,
    place: NDArray,
    heading: NDArray,
    behaviour: NDArray,
    speed: NDArray,
    held: NDArray,
    edge: NDArray,
    turn: NDArray,
) -> None:
    """Write the edge and the extra turn of each of C characters, going on by itself where a decision still holds.

    Args:
        actions: of the graph and the task.
        coded: PolicyTable.coded.
        shortlist: PolicyTable.shortlist, for all but speeds between two levels.  # (N, Q, H) or (N, Q, 0)
        requests: SteeringTask.requests.
        onward: ``onward_edges``.  # (N,)
        segment_ticks: SteeringTask.segment_ticks.
        exact: whether turns may lie between the levels.
        slot: as of Situations, and so are node, place, heading, behaviour and speed.  # (C,)
        held: ticks by slot for which the last decision still holds, counted down here.  # (slots,)
        edge: the result.  # (C,) int32
        turn: the result, radians.  # (C,)
    """
    # Compiled code counts references at each look into a tuple of arrays, so it looks once.
    edge_start, target, yaw, smoothness, shown, turn_limit, price, level, turn_smoothness, headed, pace, rules = actions
    codes, lowest, step = coded
    for who in range(node.shape[0]):
        if held[slot[who]] > 0:
            held[slot[who]] -= 1
            edge[who], turn[who] = onward[node[who]], 0.0
        else:
            held[slot[who]] = segment_ticks - 1
            left = heading[who] - place[who, 2]
            asked = asked_for(requests, behaviour[who], speed[who])
            if shortlist.shape[2] and asked.share == 0.0:
                edge[who], turn[who] = best_listed_action(
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
                    pace,
                    rules,
                    codes,
                    lowest,
                    step,
                    shortlist,
                    node[who],
                    asked,
                    left,
                    exact,
                )
            else:
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
                    pace,
                    rules,
                    codes,
                    lowest,
                    step,
                    node[who],
                    asked,
                    left,
                    exact,
                )
                edge[who], turn[who] = found[1], found[2]


@numba.njit(cache=True, nogil=True)
def turn_moves(pivot: NDArray, target: NDArray, turn: NDArray, adjustment: NDArray) -> None:
    """Write the adjustments (C, 3) that turn characters about the pivots (N, 2) of the frames they come to."""
    for who in range(turn.shape[0]):
        if turn[who] != 0.0:
            there = target[who]
            x, z, yaw = turn_about(pivot[there, 0], pivot[there, 1], turn[who])
            adjustment[who, 0], adjustment[who, 1], adjustment[who, 2] = x, z, yaw


@numba.njit(cache=True, nogil=True)
def steer(
    policy: Policy,
    slot: NDArray,
    node: NDArray,
    place: NDArray,
    heading: NDArray,
    behaviour: NDArray,
    speed: NDArray,
    held: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
) -> None:
    """Write the moves of C characters into the last five arrays; the arguments before are those of ``decide``."""
    actions, pivot, turn = policy.actions, policy.pivot, np.empty(slot.shape[0])
    decide(
        actions,
        policy.coded,
        policy.shortlist,
        policy.requests,
        policy.onward,
        policy.segment_ticks,
        policy.exact,
        slot,
        node,
        place,
        heading,
        behaviour,
        speed,
        held,
        edge,
        turn,
    )
    edges, graph_target = edge, actions.target
    fill_moves(
        edges, graph_target, policy.displacement, policy.natural, edge, target, displacement, adjustment, natural
    )
    turn_moves(pivot, target, turn, adjustment)
