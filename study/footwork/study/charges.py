"""What a tick is charged: s of the edge or the leap by the uniform metric, and s of the turn that was added to it.

Source: conventions.md 2 and 5. A controller of any kind is charged alike, on the poses before they are smoothed.
"""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.graph_windows import NONE, GraphWindows
from footwork.motion.metric import UNIT, align_windows
from footwork.motion.moves import LEAP
from footwork.motion.turn_warp import TurnWarp, adjustment_cost

_AT_ONCE = 512


def charges(
    graph: MotionGraph,
    warp: TurnWarp,
    source: NDArray,
    edge: NDArray,
    target: NDArray,
    adjustment: NDArray,
    sigma: float,
) -> NDArray[np.float64]:
    """s of K ticks.  # (K,)

    Args:
        graph: what was moved on.
        warp: the prices of turns on it.
        source: the node left.  # (K,)
        edge: the edge taken, LEAP for none.  # (K,)
        target: the node come to.  # (K,)
        adjustment: what the controller added.  # (K, 3)
        sigma: what the graph's smoothness was made with.
    """
    costs = np.empty(len(edge))
    leaps = edge == LEAP
    costs[~leaps] = edge_costs(graph, edge[~leaps], sigma)
    costs[leaps] = leap_costs(graph, source[leaps], target[leaps])
    return costs + np.maximum(adjustment_cost(warp.moments[target], adjustment), 0.0)


def edge_costs(graph: MotionGraph, edges: NDArray, sigma: float) -> NDArray[np.float64]:
    """s of edges by the uniform metric, whichever metric built the graph.  # (n,)"""
    smoothness = np.maximum(graph.smoothness[edges].astype(np.float64), np.finfo(np.float32).tiny)
    return -sigma * np.log(smoothness)


def leap_costs(graph: MotionGraph, source: NDArray, target: NDArray) -> NDArray[np.float64]:
    """s of leaps between frames that no edge joins, as an edge between them would have it.  # (n,), (n,) -> (n,)

    A leap from i to the frame after j costs s(i, j) between the windows of i and j, aligned (conventions.md 1 and 2);
    one to a frame that nothing comes before is compared with that frame itself. Windows hold the frames at the ends
    of a motion.
    """
    windows = GraphWindows(graph)
    target = np.asarray(target)
    similar = np.where(windows.before[target] == NONE, target, windows.before[target])
    pairs = np.stack([windows.held(windows.nodes(nodes)) for nodes in (source, similar)], axis=1)
    costs = np.empty(len(pairs))
    for first in range(0, len(pairs), _AT_ONCE):
        points = windows.points(pairs[first : first + _AT_ONCE])
        costs[first : first + _AT_ONCE] = align_windows(points[:, 0], points[:, 1]).square / UNIT**2
    return costs
