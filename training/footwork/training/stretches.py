"""Contracting a graph of frames to segments: stretches of a clip between branch points, within one state."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph


def stretches(graph: MotionGraph, state: NDArray) -> NDArray[np.int32]:
    """The first node of each segment, and N.

    A node goes on a segment where the capture leads to it from the node before it, which has no other way out, it has
    no other way in, and both are of one state.

    Args:
        graph: nodes in the order of the capture.
        state: of each node.  # (N,)
    """
    ways_in = np.bincount(graph.target, minlength=graph.node_count)
    source, target = graph.source, graph.target
    joins = graph.natural & (target == source + 1) & (state[source] == state[target])
    joins &= (np.diff(graph.edge_start)[source] == 1) & (ways_in[target] == 1)
    begins = np.ones(graph.node_count + 1, dtype=np.bool_)
    begins[target[joins]] = False
    return np.flatnonzero(begins).astype(np.int32)
