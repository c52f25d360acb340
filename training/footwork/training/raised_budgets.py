"""Labels and budgets of one stream of searches after nodes have been kept.

A node kept since is one more that best paths may want to reach, and edges between it and other kept nodes are cheaper.
A stream's own searches find only nodes within their budgets, which therefore stay bounds; another's may lie beyond
them. For these every node before them is allowed the label with which it could still be on a best path to them, and so
on backwards as far as budgets rise; edges that a budget held back until then are followed.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.best_paths import Paths, comes_first
from footwork.training.kept_edges import KeptEdges

_WAITS, _RAISED = 1, 2


class Raising(NamedTuple):
    """Room for the nodes whose budgets rise.

    Args:
        waiting: a queue of those whose sources may rise with them.  # (N + 1,)
        nodes: those whose budgets rose, in the order they first did.  # (N,)
        state: 0 for the others, and for all before and after.  # (N,)
    """

    waiting: NDArray[np.int32]
    nodes: NDArray[np.int32]
    state: NDArray[np.uint8]


def no_raising(count: int) -> Raising:
    """For a graph of N nodes."""
    return Raising(np.empty(count + 1, np.int32), np.empty(count, np.int32), np.zeros(count, np.uint8))


@numba.njit(cache=True, nogil=True)
def join(nodes: NDArray, edges: KeptEdges, paths: Paths) -> int:
    """Lower the labels of nodes kept since by their edges from kept nodes; returns how many edges were looked at.

    Args:
        nodes: kept since the last search, in the order of their path.
        edges: the graph.
        paths: of the last search; changed.
    """
    label, into, looked = paths.label, edges.into, 0
    for node in nodes:
        looked += into[node + 1] - into[node]
        for at in range(into[node], into[node + 1]):
            before = edges.source[at]
            if edges.kept[before] and label[before] < paths.unknown[0]:
                _follow(edges, paths, before, node, int(label[before] + edges.cost[at]))
    return int(looked)


@numba.njit(cache=True, nogil=True)
def _follow(edges: KeptEdges, paths: Paths, node: int, there: int, new: int) -> None:
    """Reach ``there`` over ``node`` where that is better."""
    old = paths.label[there]
    if new < old or (new == old and comes_first(edges.kept, paths.parent, node, there)):
        paths.label[there], paths.parent[there] = new, node


@numba.njit(cache=True, nogil=True)
def allow(nodes: NDArray, edges: KeptEdges, paths: Paths, raising: Raising) -> tuple[int, int]:
    """Raise budgets so that they bound those of the next search, and follow edges within them.

    Args:
        nodes: those that the other stream found, kept and joined by now.
        edges: the graph.
        paths: of this stream's last search; changed.
        raising: its ``nodes`` are filled with those to be searched on from, at their labels.

    Returns:
        How many ``nodes`` there are and how many edges were looked at.
    """
    label, budget, into, state = paths.label, paths.budget, edges.into, raising.state
    looked = first = last = count = 0
    for node in nodes:
        if label[node] > budget[node]:
            # between kept nodes searches go freely, so that only nodes not kept need to be allowed to lead here
            last, count = _allow_before(node, int(label[node]), False, edges, paths, raising, last, count)
            looked += into[node + 1] - into[node]
    # first come, first served: budgets that rise again would rise far more often the other way round
    while first != last:
        node = raising.waiting[first]
        first, state[node] = (first + 1) % len(raising.waiting), _RAISED
        last, count = _allow_before(node, int(budget[node]), True, edges, paths, raising, last, count)
        looked += into[node + 1] - into[node]
    open_ = 0
    for k in range(count):
        node = raising.nodes[k]
        state[node] = 0
        if label[node] <= budget[node] and label[node] < paths.unknown[0]:
            raising.nodes[open_] = node
            open_ += 1
    return open_, int(looked)


@numba.njit(cache=True, nogil=True)
def _allow_before(
    node: int, wanted: int, leave: bool, edges: KeptEdges, paths: Paths, raising: Raising, last: int, count: int
) -> tuple[int, int]:
    """Raise the budgets of the nodes before one; with ``leave`` those of kept nodes, too, whose edges are followed.

    Returns:
        Where the queue ends now and how many nodes were raised so far.
    """
    label, budget, unknown, state = paths.label, paths.budget, paths.unknown[0], raising.state
    for at in range(edges.into[node], edges.into[node + 1]):
        before = edges.source[at]
        if edges.kept[before] and not leave:
            continue
        cost = edges.far[edges.cost[at]]
        if label[before] <= wanted - cost and (edges.kept[before] or label[before] <= budget[before]):
            _follow(edges, paths, before, node, int(label[before] + cost))
        # what no path is known to reach has no bound, nor has what leads there: so that none rises twice
        room = unknown if wanted > unknown // 2 else wanted - cost
        if label[before] < unknown:
            room = min(room, label[before])  # no budget needs to be above its node's label
        if room <= budget[before]:
            continue
        budget[before] = room
        if edges.kept[before] or state[before] == _WAITS:
            continue
        if state[before] != _RAISED:
            raising.nodes[count] = before
            count += 1
        raising.waiting[last], state[before] = before, _WAITS
        last = (last + 1) % len(raising.waiting)
    return last, count
