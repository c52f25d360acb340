"""The best paths from one original frame to all others, by Dijkstra's search that passes over what cannot matter.

A search takes up the labels of the one before it, from the next frame of the clip: what that can reach is reached by
the natural edge and its path. Counted from the clip's last frame, labels only fall, by better paths from the new frame
and by edges that are cheaper since their ends are kept; only where they fall edges are followed. It follows kept nodes
first and leaves them only where budgets say that it may still pay (``budgets``).
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.bucket_queue import NONE, BucketQueue, bucket, first, is_queued, put, remove
from footwork.training.kept_edges import KeptEdges


class Paths(NamedTuple):
    """What is known between the searches of a clip; T is the integer type of costs.

    Args:
        label: cost of the best path to each node, less the shift of the search; ``unknown`` where none was
            found.  # (N,) T
        parent: the node before each on its best path.  # (N,)
        budget: a bound on each node's budget, less the shift of the search.  # (N,) T
        leaf: for each node left, the part of its budget that is due to its edges to nodes not kept, ``unknown`` where
            one of them was followed.  # (N,) T
        left: the nodes whose edges to nodes not kept the last search followed, in the order they were settled.  # (N,)
        unknown: more than any label.  # (1,) T
    """

    label: NDArray
    parent: NDArray[np.int32]
    budget: NDArray
    leaf: NDArray
    left: NDArray[np.int32]
    unknown: NDArray


def no_paths(count: int, kind: type[np.signedinteger]) -> Paths:
    """Before the first search among N nodes, with costs of a type."""
    unknown = np.array([1 << (np.iinfo(kind).bits - 2)], dtype=kind)
    label, budget, leaf = (np.full(count, unknown[0], dtype=kind) for _ in range(3))
    parent, left = (np.full(count, NONE, dtype=np.int32) for _ in range(2))
    return Paths(label, parent, budget, leaf, left, unknown)


def forget(paths: Paths, useful: NDArray[np.bool_]) -> None:
    """Give every useful node an unbounded budget and the others none: before a search that follows no other."""
    paths.label[:] = paths.unknown
    paths.budget[:] = np.where(useful, paths.unknown, -paths.unknown)


class Progress(NamedTuple):
    """How far a search has come.

    Args:
        sown: how many seeds are queued.
        queued: how many nodes stand in the queue.
        turn: the bucket whose turn it is.
        left: how many nodes ``Paths.left`` holds.
        looked: how many edges were looked at.
    """

    sown: int
    queued: int
    turn: int
    left: int
    looked: int


BEGUN = Progress(0, 0, -(1 << 62), 0, 0)  # before every bucket


@numba.njit(cache=True, nogil=True)
def spread(seeds: NDArray, due: NDArray, edges: KeptEdges, paths: Paths, queue: BucketQueue) -> Progress:
    """Lower the labels of kept nodes by paths over kept nodes; ``left`` are then the nodes whose labels fell.

    Args:
        seeds: kept nodes whose edges may lower labels, by label.  # (S,)
        due: their labels.  # (S,)
        edges: the graph.
        paths: of the search before; changed.
        queue: empty, and so again at the end.
    """
    label, parent, kept, start, middle = paths.label, paths.parent, edges.kept, edges.start, edges.middle
    target, base, head, after, before = edges.target, edges.base, queue.head, queue.after, queue.before
    sown, queued, left, turn, looked = 0, 0, 0, bucket(due[0]), 0
    while queued > 0 or sown < len(seeds):
        turn = turn if queued > 0 else max(turn, bucket(due[sown]))
        sown, more = _sow(seeds, due, label, head, after, before, sown, turn)
        queued += more
        node = first(head, turn)
        if node == NONE:
            turn += 1
            continue
        remove(head, after, before, node)
        queued -= 1
        here = label[node]
        looked += middle[node] - start[node]
        for at in range(start[node], middle[node]):
            there = target[at]
            new = here + base[at]
            if new <= label[there]:
                queued += _lower(kept, label, parent, head, after, before, node, there, new)
        paths.left[left] = node
        left += 1
    return Progress(sown, queued, turn, left, looked)


@numba.njit(cache=True, nogil=True)
def search(
    seeds: NDArray, due: NDArray, edges: KeptEdges, paths: Paths, queue: BucketQueue, so_far: Progress, most: int
) -> Progress:
    """Lower the labels of all that a best path from the origin to a kept node may pass.

    Of equal paths to a node the one whose last edge comes from a kept node is taken, then the one from the node of
    the lowest number.

    Args:
        seeds: the nodes whose edges may lower labels, by label.  # (S,)
        due: their labels.  # (S,)
        edges: the graph.
        paths: of the search before; changed.
        queue: empty, and so again at the end, unless the search stopped before.
        so_far: where to go on.
        most: how many nodes are left before it stops, so that budgets can be lowered; then it can go on.
    """
    # taken out of their tuples here: inside the loop that would count references
    label, parent, budget, unknown = paths.label, paths.parent, paths.budget, paths.unknown[0]
    kept, start, middle, target = edges.kept, edges.start, edges.middle, edges.target
    base, far = edges.base, edges.far
    head, after, before = queue.head, queue.after, queue.before
    sown, queued, turn, left, looked = so_far
    while (queued > 0 or sown < len(seeds)) and left < most:
        turn = turn if queued > 0 else max(turn, bucket(due[sown]))
        sown, more = _sow(seeds, due, label, head, after, before, sown, turn)
        queued += more
        node = first(head, turn)
        if node == NONE:
            turn += 1
            continue
        remove(head, after, before, node)
        queued -= 1
        here, cheap = label[node], kept[node]
        if not cheap and here > budget[node]:
            continue
        looked += middle[node] - start[node]
        for at in range(start[node], middle[node]):
            there = target[at]
            new = here + (base[at] if cheap else far[base[at]])
            if new <= label[there]:
                queued += _lower(kept, label, parent, head, after, before, node, there, new)
        if cheap and here > budget[node]:
            continue
        looked += start[node + 1] - middle[node]
        leaf = -unknown
        for at in range(middle[node], start[node + 1]):
            there, cost = target[at], far[base[at]]
            room = budget[there] - cost
            if here > room:
                leaf = max(leaf, room)
                continue
            leaf, new = unknown, here + cost
            if new <= label[there]:
                queued += _lower(kept, label, parent, head, after, before, node, there, new)
        paths.leaf[node] = leaf
        paths.left[left] = node
        left += 1
    return Progress(sown, queued, turn, left, looked)


@numba.njit(inline="always")
def _sow(
    seeds: NDArray, due: NDArray, label: NDArray, head: NDArray, after: NDArray, before: NDArray, sown: int, turn: int
) -> tuple[int, int]:
    """Queue the seeds whose turn has come; how many are sown now, and how many of these were queued."""
    queued = 0
    while sown < len(seeds) and bucket(due[sown]) <= turn:
        # one that was reached at less since has had its turn
        if label[seeds[sown]] == due[sown]:
            put(head, after, before, seeds[sown], due[sown])
            queued += 1
        sown += 1
    return sown, queued


@numba.njit(inline="always")
def _lower(
    kept: NDArray,
    label: NDArray,
    parent: NDArray,
    head: NDArray,
    after: NDArray,
    before: NDArray,
    node: int,
    there: int,
    new: int,
) -> int:
    """Reach ``there`` by a path over ``node`` that costs no more than its best so far; 1 if it is queued for that."""
    old = label[there]
    if new == old:
        if comes_first(kept, parent, node, there):
            parent[there] = node
        return 0
    stood = is_queued(before, there)
    if stood:
        remove(head, after, before, there)
    label[there], parent[there] = new, node
    put(head, after, before, there, new)
    return 0 if stood else 1


@numba.njit(inline="always")
def comes_first(kept: NDArray, parent: NDArray, node: int, there: int) -> bool:
    """Whether of two equal paths to ``there`` that over ``node`` is taken."""
    last = parent[there]
    # the origin is its own parent and keeps it
    return last != there and (kept[node] > kept[last] or (kept[node] == kept[last] and node < last))


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
