"""How soon a graph itself can turn a character or change what it does, whatever the controller: bounds from below."""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.study.breadth_first import UNREACHED, reversed_edges, ticks_from


def ticks_to_behaviour(graph: MotionGraph, behaviour: int) -> NDArray[np.int32]:
    """Ticks of the shortest way from each node to a frame of a behaviour, UNREACHED where there is none.  # (N,)"""
    back = reversed_edges(graph.edge_start, graph.target)
    return ticks_from(*back, np.flatnonzero(graph.behaviour == behaviour))


def ticks_to_turn(
    graph: MotionGraph, behaviour: int, radians: float, within: float, turn_limit: NDArray, most: int
) -> NDArray[np.int32]:
    """Ticks in which a character on each node can have turned by an angle, to within another, and do a behaviour then.

    No way is shorter: it may turn either way round, by the extra turns that it is allowed, and stop turning at will.

    Args:
        graph: what it moves on.
        behaviour: index of what it shall do once it has turned.
        radians: how far it turns, positive left.
        within: how far off is near enough, radians.
        turn_limit: the largest extra turn on arriving at each node, radians.  # (N,)
        most: ticks after which it counts as UNREACHED.

    Returns:
        # (N,)
    """
    left, right = radians % (2.0 * np.pi) - within, -radians % (2.0 * np.pi) - within
    ticks = np.full(graph.node_count, UNREACHED, np.int32)
    furthest = [np.where(graph.behaviour == behaviour, 0.0, -np.inf) for _ in range(2)]
    yaw = graph.displacement[:, 2].astype(np.float64)
    for tick in range(1, most + 1):
        furthest = [
            _turned_further(graph.edge_start, graph.target, sign * yaw, turn_limit, far)
            for sign, far in zip((1.0, -1.0), furthest, strict=True)
        ]
        there = (furthest[0] >= left) | (furthest[1] >= right)
        ticks[there & (ticks == UNREACHED)] = tick
    return ticks


@numba.njit(cache=True, nogil=True)
def _turned_further(
    edge_start: NDArray, target: NDArray, yaw: NDArray, turn_limit: NDArray, furthest: NDArray
) -> NDArray:
    """How far one can turn in a tick and then as far as ``furthest`` (N,) says of where one is.  # (N,)"""
    further = np.full(len(furthest), -np.inf)
    for node in range(len(furthest)):
        for edge in range(edge_start[node], edge_start[node + 1]):
            there = target[edge]
            turned = yaw[edge] + turn_limit[there] + furthest[there]
            further[node] = max(further[node], turned)
    return further
