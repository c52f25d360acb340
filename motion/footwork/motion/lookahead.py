"""One-step lookahead on interpolated values: what an edge is worth under a command, and which edge is best.

The solver and the controller use the same kernels, so the policy that was solved for is the policy that is played.
Nearest-bin rounding would leave slow turns stuck in their bin (conventions.md 5), so values are always interpolated.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray


@numba.njit(cache=True, nogil=True)
def interpolate(values: NDArray, heading: float) -> float:
    """The periodic linear interpolation of ``values`` (H,), tabulated evenly from -pi on, at ``heading``."""
    bins = values.shape[0]
    place = (heading + math.pi) * (bins / (2.0 * math.pi))
    whole = math.floor(place)
    share = place - whole
    low = int(whole) % bins
    high = low + 1 if low + 1 < bins else 0
    return values[low] * (1.0 - share) + values[high] * share


@numba.njit(cache=True, nogil=True)
def control_quality(delta: float, matches: bool, headed: bool, sigma: float) -> float:
    """SteeringTask.control_quality for one state."""
    if not matches:
        return 0.0
    if not headed:
        return 1.0
    wrapped = delta - 2.0 * math.pi * math.floor(delta / (2.0 * math.pi) + 0.5)
    return math.exp(-0.5 * (wrapped / sigma) ** 2)


@numba.njit(cache=True, nogil=True)
def edge_value(
    heading: float,
    wanted: int,
    headed: bool,
    shown: int,
    yaw: float,
    smoothness: float,
    next_values: NDArray,
    sigma: float,
    discount: float,
) -> float:
    """r + discount V' of one edge: r = qc qt, judged at the frame the edge leads to (conventions.md 5).

    Args:
        heading: wanted heading less facing before the edge, radians.
        wanted: index of the behaviour asked for.
        headed: whether that behaviour is judged by its heading.
        shown: index of the behaviour of the edge's target.
        yaw: how far the edge turns, radians.
        smoothness: qt of the edge.
        next_values: values of the target under the behaviour asked for.  # (H,)
        sigma: the task's heading_sigma.
        discount: the task's discount.
    """
    after = heading - yaw
    reward = smoothness * control_quality(after, wanted == shown, headed, sigma)
    return reward + discount * interpolate(next_values, after)


@numba.njit(cache=True, nogil=True)
def best_edges(
    node: NDArray,
    heading: NDArray,
    wanted: NDArray,
    headed: NDArray,
    sigma: float,
    discount: float,
    values: NDArray,
    edge_start: NDArray,
    target: NDArray,
    behaviour: NDArray,
    turn: NDArray,
    smoothness: NDArray,
    best: NDArray,
) -> None:
    """Write into ``best`` (C,) the edge of highest value for each of C characters; the first of equals wins.

    Args:
        node: where each character is.  # (C,)
        heading: wanted heading less facing, radians.  # (C,)
        wanted: index of the behaviour asked for.  # (C,)
        headed: SteeringTask.headed.  # (B,)
        sigma: the task's heading_sigma.
        discount: the task's discount.
        values: PolicyTable.values.  # (N, B, H)
        edge_start: CSR row starts.  # (N + 1,)
        target: CSR columns.  # (E,)
        behaviour: behaviour of each node.  # (N,)
        turn: yaw of each edge, radians.  # (E,)
        smoothness: qt of each edge.  # (E,)
        best: the result.  # (C,) int32
    """
    for character in range(node.shape[0]):
        here = node[character]
        asked = wanted[character]
        highest = -np.inf
        for edge in range(edge_start[here], edge_start[here + 1]):
            there = target[edge]
            value = edge_value(
                heading[character],
                asked,
                bool(headed[asked]),
                int(behaviour[there]),
                turn[edge],
                smoothness[edge],
                values[there, asked],
                sigma,
                discount,
            )
            if value > highest:
                highest = value
                best[character] = edge
