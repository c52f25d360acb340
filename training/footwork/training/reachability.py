"""Which nodes a path from an original frame to an original frame can pass at all."""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.kept_edges import KeptEdges


def between_originals(originals: int, edges: KeptEdges) -> NDArray[np.bool_]:
    """Nodes that some original leads to and that lead to some original, and all originals.  # (N,)

    Left out are interpolated chains that nothing enters or that only lead to dead ends.

    Args:
        originals: the nodes 0 .. originals - 1 are the original frames.
        edges: the graph.
    """
    ahead = _reached(originals, edges.start, edges.target)
    return ahead & _reached(originals, edges.into, edges.source)


@numba.njit(cache=True, nogil=True)
def _reached(originals: int, start: NDArray, target: NDArray) -> NDArray[np.bool_]:
    reached = np.zeros(len(start) - 1, dtype=np.bool_)
    waiting = np.empty(len(start) - 1, dtype=np.int32)
    for node in range(originals):
        reached[node] = True
        waiting[node] = node
    count = originals
    while count > 0:
        count -= 1
        node = waiting[count]
        for at in range(start[node], start[node + 1]):
            if not reached[target[at]]:
                reached[target[at]] = True
                waiting[count] = target[at]
                count += 1
    return reached
