"""How fast a body moves on at each node of a graph."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.graph_windows import NONE, GraphWindows, composed
from footwork.motion.tick import TICK_RATE

REACH = 7
"""Frames that count on either side; with the tick before the first of them that is half a second."""


def node_speeds(graph: MotionGraph) -> NDArray[np.float64]:
    """The way of each node's planar root, as the crow flies, over the half second around it: m/s (convention).

    The sway of a step is shorter than that and mostly cancels. Where the natural edges end sooner, the shorter time
    that they cover counts; it has one tick at least, for nodes keep the velocity that they came with.  # (N,)
    """
    windows, nodes = GraphWindows(graph), np.arange(graph.node_count)
    returns = (windows.before != NONE) & (windows.after[windows.before] == nodes)
    first, behind = _along(np.where(returns, windows.before, NONE), nodes)
    _, ahead = _along(windows.after, nodes)
    place, here = np.zeros((graph.node_count, 3)), first
    for made in range(2 * REACH):
        moves = made < behind + ahead
        place = np.where(moves[:, None], composed(place, windows.step[here]), place)
        here = np.where(moves, windows.after[here], here)
    way = place[:, :2] + graph.root_velocity[first][:, [0, 2]] / TICK_RATE
    return frozen(np.hypot(way[:, 0], way[:, 1]) * TICK_RATE / (1 + behind + ahead), np.float64)


def _along(next_node: NDArray, nodes: NDArray) -> tuple[NDArray, NDArray]:
    """Where REACH steps lead from nodes, fewer where there is no next one, and how many were made.  # (N,), (N,)"""
    here, made = nodes, np.zeros(len(nodes), np.int64)
    for _ in range(REACH):
        there = next_node[here] != NONE
        here, made = np.where(there, next_node[here], here), made + there
    return here, made
