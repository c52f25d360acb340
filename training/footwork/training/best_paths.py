"""The best paths from one original frame to all others, by Dijkstra's search that passes over what cannot matter.

A search follows kept nodes freely and leaves them only where it may still pay. The *budget* of a node that is not
kept is the largest label with which it could be on a best path to a kept node: the largest, over all kept nodes b, of
(label of b) - (cost from the node to b). The budget of a kept node is the largest label with which leaving the kept
nodes there could pay.
Budgets of one search, one frame larger, bound those of a search from the frame before: whatever it wants to reach, it
can reach by its natural edge and the other's path. Keeping more nodes only lowers labels, and a node kept since had a
label within its budget, so the bound stays one. A label equal to its budget is still explored: so every best
path is found, and which of equal ones is taken does not depend on budgets.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.bucket_queue import NONE, BucketQueue, first, put, remove
from footwork.training.kept_edges import KeptEdges


class Paths(NamedTuple):
    """The labels of a search and what it leaves to the next; T is the integer type of costs.

    Args:
        label: cost of the best path to each node, ``unknown`` where none was found.  # (N,) T
        parent: the node before each on its best path.  # (N,)
        budget: a bound on each node's budget, less the shift of the search.  # (N,) T
        leaf: for each node left, the part of its budget that is due to its edges to nodes not kept, ``unknown`` where
            one of them was followed.  # (N,) T
        touched: the nodes with labels.  # (N + 1,)
        left: the nodes whose edges to nodes not kept were followed, in the order they were settled.  # (N,)
        unknown: more than any label.  # (1,) T
    """

    label: NDArray
    parent: NDArray[np.int32]
    budget: NDArray
    leaf: NDArray
    touched: NDArray[np.int32]
    left: NDArray[np.int32]
    unknown: NDArray


def no_paths(count: int, kind: type[np.signedinteger]) -> Paths:
    """Before the first search among N nodes, with costs of a type."""
    unknown = np.array([1 << (np.iinfo(kind).bits - 2)], dtype=kind)
    label, budget, leaf = (np.full(count, unknown[0], dtype=kind) for _ in range(3))
    # one more: a search writes down what it has reached before it knows whether that is new
    parent, touched, left = (np.full(count + 1, NONE, dtype=np.int32) for _ in range(3))
    return Paths(label, parent, budget, leaf, touched, left, unknown)


def forget(paths: Paths, useful: NDArray[np.bool_]) -> None:
    """Give every useful node an unbounded budget and the others none: before a search that follows no other."""
    paths.budget[:] = np.where(useful, paths.unknown, -paths.unknown)


@numba.njit(cache=True, nogil=True)
def search(origin: int, edges: KeptEdges, paths: Paths, queue: BucketQueue, shift: int) -> tuple[int, int, int, int]:
    """Label all that a best path from ``origin`` to a kept node may pass.

    Of equal paths to a node the one whose last edge comes from a kept node is taken, then the one from the node of
    the lowest number.

    Args:
        origin: a kept node.
        edges: the graph.
        paths: no labels, and budgets of an earlier search; filled.
        queue: empty, and so again at the end.
        shift: what the budgets have grown by since they were written.

    Returns:
        How many nodes were touched and how many left, how many buckets were gone through and edges looked at.
    """
    # taken out of their tuples here: inside the loop that would count references
    label, parent, budget, unknown = paths.label, paths.parent, paths.budget, paths.unknown[0]
    kept, start, middle, target = edges.kept, edges.start, edges.middle, edges.target
    base, far, reached = edges.base, edges.far, paths.touched
    head, after, before = queue.head, queue.after, queue.before
    label[origin], parent[origin] = 0, origin
    reached[0] = origin
    put(head, after, before, origin, 0)
    queued, touched, left, turn, looked = 1, 1, 0, 0, 0
    while queued > 0:
        node = first(head, turn)
        if node == NONE:
            turn += 1
            continue
        remove(head, after, before, node)
        queued -= 1
        here, cheap = label[node], kept[node]
        looked += middle[node] - start[node]
        for at in range(start[node], middle[node]):
            there = target[at]
            new = here + (base[at] if cheap else far[base[at]])
            if new <= label[there]:
                found = _lower(kept, label, parent, head, after, before, unknown, node, there, new)
                reached[touched] = there
                touched, queued = touched + found, queued + found
        used = here - shift
        if cheap and used > budget[node]:
            continue
        looked += start[node + 1] - middle[node]
        leaf = -unknown
        for at in range(middle[node], start[node + 1]):
            there, cost = target[at], far[base[at]]
            room = budget[there] - cost
            if used > room:
                leaf = max(leaf, room)
                continue
            leaf, new = unknown, here + cost
            if new <= label[there]:
                found = _lower(kept, label, parent, head, after, before, unknown, node, there, new)
                reached[touched] = there
                touched, queued = touched + found, queued + found
        paths.leaf[node] = leaf
        paths.left[left] = node
        left += 1
    return touched, left, turn, looked


@numba.njit(inline="always")
def _lower(
    kept: NDArray,
    label: NDArray,
    parent: NDArray,
    head: NDArray,
    after: NDArray,
    before: NDArray,
    unknown: int,
    node: int,
    there: int,
    new: int,
) -> int:
    """Reach ``there`` by a path over ``node`` that costs no more than its best so far; 1 if it is the first."""
    old = label[there]
    if new == old:
        last = parent[there]
        # the origin is its own parent and keeps it
        if last != there and (kept[node] > kept[last] or (kept[node] == kept[last] and node < last)):
            parent[there] = node
        return 0
    if old != unknown:
        remove(head, after, before, there)
    label[there], parent[there] = new, node
    put(head, after, before, there, new)
    return 1 if old == unknown else 0


@numba.njit(cache=True, nogil=True)
def tighten(edges: KeptEdges, paths: Paths, left: int, shift: int) -> int:
    """Lower the budgets of the nodes that a search left, given its labels; returns how many edges were looked at.

    From the last settled to the first, so that most of what a node leads to is lowered before it. No budget is
    above its node's label: the label of b is at most that of the node and the cost on to b.
    """
    label, budget, unknown = paths.label, paths.budget, paths.unknown[0]
    start, middle, target, base, far = edges.start, edges.middle, edges.target, edges.base, edges.far
    looked = 0
    for k in range(left):
        node = paths.left[k]
        budget[node] = min(budget[node], label[node] - shift)
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
                best = max(best, label[target[at]] - far[base[at]] - shift)
            looked += int(middle[node] - start[node])
        budget[node] = min(budget[node], best)
    return looked


@numba.njit(cache=True, nogil=True)
def take(
    origin: int,
    originals: int,
    kept: NDArray,
    paths: Paths,
    seen: NDArray,
    before: NDArray,
    changed: NDArray,
    new: NDArray,
) -> tuple[int, int]:
    """Follow the best paths from ``origin`` back from all originals reached.

    Args:
        origin: where the search began.
        originals: the nodes 0 .. originals - 1 are the original frames.
        kept: which nodes are kept.  # (N,)
        paths: the labels of the search.
        seen: for each node the origin whose paths it was last on.  # (N,)
        before: for each node its parent then.  # (N,)
        changed: filled with the nodes on the paths with another parent than then.  # (N,)
        new: filled with the nodes on the paths that are not kept yet.  # (N,)

    Returns:
        How many nodes are in ``changed`` and in ``new``.
    """
    unknown, changes, count = paths.unknown[0], 0, 0
    seen[origin] = origin
    for wanted in range(originals):
        node = wanted if paths.label[wanted] < unknown else origin
        while seen[node] != origin:
            seen[node] = origin
            if before[node] != paths.parent[node]:
                before[node] = paths.parent[node]
                changed[changes] = node
                changes += 1
            if not kept[node]:
                new[count] = node
                count += 1
            node = before[node]
    return changes, count
