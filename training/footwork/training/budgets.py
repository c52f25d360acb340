"""How far it may pay to leave the nodes kept: bounds that let a search pass over most of a graph.

The *budget* of a node that is not kept is the largest label with which it could be on a best path to a kept node: the
largest, over all kept nodes b, of (label of b) - (cost from the node to b). The budget of a kept node is the largest
label with which leaving the kept nodes there could pay.
Labels only fall from search to search of a clip, so that budgets stay bounds; and a node kept since had a label within
its budget. A label equal to its budget is still explored: so every best path is found, and which of equal ones is
taken does not depend on budgets.
"""

import numba
from numpy.typing import NDArray

from footwork.training.best_paths import Paths
from footwork.training.bucket_queue import NONE, BucketQueue, bucket, first, is_queued, put, remove
from footwork.training.kept_edges import KeptEdges


@numba.njit(cache=True, nogil=True)
def tighten(edges: KeptEdges, paths: Paths, left: int) -> int:
    """Lower the budgets of the nodes that a search left, given its labels; returns how many edges were looked at.

    From the last settled to the first, so that most of what a node leads to is lowered before it. No budget is
    above its node's label: the label of b is at most that of the node and the cost on to b.
    """
    label, budget, unknown = paths.label, paths.budget, paths.unknown[0]
    start, middle, target, base, far = edges.start, edges.middle, edges.target, edges.base, edges.far
    looked = 0
    for k in range(left):
        node = paths.left[k]
        budget[node] = min(budget[node], label[node])
    for k in range(left - 1, -1, -1):
        node = paths.left[k]
        best = paths.leaf[node]
        if best == unknown:
            best = -unknown
            for at in range(middle[node], start[node + 1]):
                best = max(best, budget[target[at]] - far[base[at]])
            looked += int(start[node + 1] - middle[node])
        if not edges.kept[node]:
            for at in range(start[node], middle[node]):
                best = max(best, label[target[at]] - far[base[at]])
            looked += int(middle[node] - start[node])
        budget[node] = min(budget[node], best)
    return looked


@numba.njit(cache=True, nogil=True)
def bound(kept_nodes: NDArray, due: NDArray, edges: KeptEdges, paths: Paths, queue: BucketQueue, worth: NDArray) -> int:
    """Lower all budgets to what the labels of kept nodes allow; returns how many edges were looked at.

    Backwards from the kept nodes of the largest label to those of the smallest, so that each node's turn comes once
    its budget is known.

    Args:
        kept_nodes: all of them, by label, the largest first.  # (K,)
        due: their labels, negative.  # (K,)
        edges: the graph.
        paths: changed.
        queue: empty, and so again at the end.
        worth: room for the budgets, negative.  # (N,) T
    """
    kept, into, source, cost, far = edges.kept, edges.into, edges.source, edges.cost, edges.far
    budget, label, unknown = paths.budget, paths.label, paths.unknown[0]
    head, after, before = queue.head, queue.after, queue.before
    worth[:] = unknown
    sown, queued, turn, looked = 0, 0, bucket(due[0]), 0
    while queued > 0 or sown < len(kept_nodes):
        turn = turn if queued > 0 else max(turn, bucket(due[sown]))
        while sown < len(kept_nodes) and bucket(due[sown]) <= turn:
            put(head, after, before, kept_nodes[sown], due[sown])
            queued, sown = queued + 1, sown + 1
        node = first(head, turn)
        if node == NONE:
            turn += 1
            continue
        remove(head, after, before, node)
        queued -= 1
        own = kept[node] == 1
        here = -label[node] if own else worth[node]
        looked += into[node + 1] - into[node]
        for at in range(into[node], into[node + 1]):
            there = source[at]
            # what no path is known to reach has no bound, nor has what leads there
            new = here if here < -unknown // 2 else here + far[cost[at]]
            if kept[there]:
                if not own:
                    worth[there] = min(worth[there], new)
            elif new < worth[there] and budget[there] > -unknown:
                if is_queued(before, there):
                    remove(head, after, before, there)
                else:
                    queued += 1
                worth[there] = new
                put(head, after, before, there, new)
    _lower(paths, worth)
    return looked


@numba.njit(cache=True, nogil=True)
def _lower(paths: Paths, worth: NDArray) -> None:
    """Lower budgets to those found; no budget needs to be above its node's label."""
    budget, label, unknown = paths.budget, paths.label, paths.unknown[0]
    for node in range(len(worth)):
        if budget[node] > -unknown:
            room = -worth[node]
            if label[node] < unknown:
                room = min(room, label[node])
            budget[node] = min(budget[node], max(room, 1 - unknown))
