"""The transitive closure of a motion graph: which frames can be reached from which (Zhao and Safonova 2008).

All nodes of one strongly connected part reach the same nodes, so the search runs over parts, each with a bit for
every part that holds frames, some thousand bits at a time.
"""

from collections.abc import Iterator

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from footwork.errors import InputError
from footwork.study.breadth_first import reversed_edges

_WORD = 64
_BYTES_AT_ONCE = 256 * 2**20


def closure(edge_start: NDArray, target: NDArray, frames: NDArray) -> NDArray[np.bool_]:
    """Whether frame b can be reached from frame a; every frame from itself.  # (F, F) by a, b

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        frames: the nodes asked about, such as the captured frames.  # (F,)
    """
    part = parts_of(edge_start, target)
    ends, place = np.unique(part[frames], return_inverse=True)
    reached = np.empty((len(ends), len(ends)), dtype=np.bool_)
    for first, block in _reached(edge_start, target, part, ends):
        reached[:, first : first + block.shape[1]] = block
    return reached[np.ix_(place, place)]


def closure_share(edge_start: NDArray, target: NDArray, frames: NDArray) -> float:
    """Share of the ordered pairs of two different frames of which the second can be reached from the first.

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        frames: the nodes asked about, without repetition.  # (F,)

    Raises:
        InputError: for fewer than two frames, which make no pair.
    """
    count = len(frames)
    if count < 2:
        raise InputError(f"{count} frames, expected at least 2", "transitive closure")
    part = parts_of(edge_start, target)
    ends, sizes = np.unique(part[frames], return_counts=True)
    pairs = sum(
        int(sizes @ (block @ sizes[first : first + block.shape[1]]))
        for first, block in _reached(edge_start, target, part, ends)
    )
    return (pairs - count) / (count * (count - 1))


def parts_of(edge_start: NDArray, target: NDArray) -> NDArray[np.int32]:
    """The strongly connected part of each node, numbered from 0.  # (N,)"""
    nodes = len(edge_start) - 1
    matrix = csr_array((np.ones(len(target), dtype=np.int8), target, edge_start), shape=(nodes, nodes))
    return connected_components(matrix, directed=True, connection="strong")[1]


def _reached(edge_start: NDArray, target: NDArray, part: NDArray, ends: NDArray) -> Iterator[tuple[int, NDArray]]:
    """Blocks of columns of the closure over the parts ``ends``: first column, and (ends, columns) bool."""
    count = int(part.max(initial=-1)) + 1
    members = np.argsort(part, kind="stable").astype(np.int32)
    member_start = np.searchsorted(part[members], np.arange(count + 1))
    order = np.empty(count, dtype=np.int32)
    _sinks_first(edge_start, target, *reversed_edges(edge_start, target), part, members, member_start, order)
    columns = _WORD * max(1, _BYTES_AT_ONCE // (8 * max(count, 1)))
    for first in range(0, len(ends), columns):
        own = ends[first : first + columns]
        bits = np.zeros((count, -(-len(own) // _WORD)), dtype=np.uint64)
        bit = np.arange(len(own))
        bits[own, bit // _WORD] |= np.uint64(1) << (bit % _WORD).astype(np.uint64)
        _gather(edge_start, target, part, members, member_start, order, bits)
        rows = bits[ends].astype("<u8", copy=False).view(np.uint8)
        yield first, np.unpackbits(rows, axis=1, count=len(own), bitorder="little").astype(np.bool_)


@numba.njit(cache=True, nogil=True)
def _sinks_first(
    edge_start: NDArray,
    target: NDArray,
    back_start: NDArray,
    source: NDArray,
    part: NDArray,
    members: NDArray,
    member_start: NDArray,
    order: NDArray,
) -> None:
    """Fill ``order`` with the parts so that each comes after all those that it leads to (Kahn 1962)."""
    left = np.zeros(order.shape[0], dtype=np.int64)
    for node in range(part.shape[0]):
        for edge in range(edge_start[node], edge_start[node + 1]):
            left[part[node]] += part[target[edge]] != part[node]
    found = 0
    for number in range(order.shape[0]):
        if left[number] == 0:
            order[found] = number
            found += 1
    done = 0
    while done < found:
        number = order[done]
        done += 1
        for node in members[member_start[number] : member_start[number + 1]]:
            for before in part[source[back_start[node] : back_start[node + 1]]]:
                if before != number:
                    left[before] -= 1
                    if left[before] == 0:
                        order[found] = before
                        found += 1


@numba.njit(cache=True, nogil=True)
def _gather(
    edge_start: NDArray,
    target: NDArray,
    part: NDArray,
    members: NDArray,
    member_start: NDArray,
    order: NDArray,
    bits: NDArray,
) -> None:
    """Give each part the bits of all parts that it leads to."""
    for number in order:
        for node in members[member_start[number] : member_start[number + 1]]:
            for edge in range(edge_start[node], edge_start[node + 1]):
                end = part[target[edge]]
                if end != number:
                    for word in range(bits.shape[1]):
                        bits[number, word] |= bits[end, word]
