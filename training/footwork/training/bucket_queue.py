"""A queue of nodes by whole frames of path cost: what Dijkstra's search takes its nodes from (Dial, 1969).

No edge costs less than a frame, so nodes of one bucket cannot improve each other and may leave it in any order. Buckets
are doubly linked lists threaded through the nodes, reused in a circle: a queue never holds labels that differ by
more than the dearest edge.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.path_cost import UNIT

NONE = -1
_SHIFT = UNIT.bit_length() - 1  # a label's bucket is label >> _SHIFT


class BucketQueue(NamedTuple):
    """The nodes that are queued; B buckets, a power of two.

    Args:
        head: first node of each bucket, NONE for none.  # (B,)
        after: the node behind each queued one, NONE for none.  # (N,)
        before: the node ahead of it, NONE - 1 - b at the head of bucket b; NONE for nodes that are not queued.  # (N,)
    """

    head: NDArray[np.int32]
    after: NDArray[np.int32]
    before: NDArray[np.int32]


def bucket_queue(count: int, dearest: int) -> BucketQueue:
    """An empty queue.

    Args:
        count: the number of nodes.
        dearest: the largest cost of an edge, in units.
    """
    buckets = 1 << (dearest // UNIT + 1).bit_length()
    return BucketQueue(*(np.full(size, NONE, dtype=np.int32) for size in (buckets, count, count)))


# inline, and on plain arrays: called in the innermost loop, where passing a tuple on costs as much as the work


@numba.njit(inline="always")
def put(head: NDArray, after: NDArray, before: NDArray, node: int, label: int) -> None:
    """Queue a node by its label."""
    bucket = (label >> _SHIFT) & (len(head) - 1)
    behind = head[bucket]
    head[bucket] = node
    after[node] = behind
    before[node] = NONE - 1 - bucket
    if behind != NONE:
        before[behind] = node


@numba.njit(inline="always")
def remove(head: NDArray, after: NDArray, before: NDArray, node: int) -> None:
    """Take a queued node out."""
    ahead, behind = before[node], after[node]
    if ahead >= 0:
        after[ahead] = behind
    else:
        head[NONE - 1 - ahead] = behind
    if behind != NONE:
        before[behind] = ahead
    before[node] = NONE


@numba.njit(inline="always")
def is_queued(before: NDArray, node: int) -> bool:
    """Whether a node is in the queue."""
    return before[node] != NONE


@numba.njit(inline="always")
def bucket(label: int) -> int:
    """The bucket of a label, counted from label 0 on."""
    return label >> _SHIFT


@numba.njit(inline="always")
def first(head: NDArray, turn: int) -> int:
    """A node of the bucket whose turn it is, counted from label 0 on; NONE if that is empty."""
    return head[turn & (len(head) - 1)]
