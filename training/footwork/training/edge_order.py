"""Edges in the order of the nodes at one of their ends."""

import numba
import numpy as np
from numpy.typing import NDArray


@numba.njit(cache=True, nogil=True)
def starts(count: int, node: NDArray) -> NDArray[np.int32]:
    """Where the edges of each node start once edges are ordered by the node at one end.  # (E,) -> (N + 1,)"""
    start = np.zeros(count + 1, dtype=np.int32)
    for end in node:
        start[end + 1] += 1
    for k in range(count):
        start[k + 1] += start[k]
    return start


def order_by(node: NDArray) -> NDArray[np.intp] | slice:
    """What orders edges by the node at one end, those of one node as they are; all of them where they are so."""
    if np.all(node[1:] >= node[:-1]):
        return slice(None)
    return np.argsort(node, kind="stable")
