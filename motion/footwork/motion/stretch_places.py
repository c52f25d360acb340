"""Where the nodes of a graph stand along the stretches that the capture leads through in one piece."""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.planar import after, triple


def natural_steps(graph: MotionGraph) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Which nodes follow the node before them in the capture, and the transforms to those that do.  # (N,), (N, 3)"""
    edges = np.flatnonzero(graph.natural & (graph.target == graph.source + 1))
    follows, steps = np.zeros(graph.node_count, dtype=np.bool_), np.zeros((graph.node_count, 3))
    follows[graph.target[edges]] = True
    steps[graph.target[edges]] = graph.displacement[edges]
    return follows, steps


def stretch_places(graph: MotionGraph) -> NDArray[np.float64]:
    """The planar place (x, z, yaw) of each node in its stretch, whose first node stands at the origin.  # (N, 3)"""
    places = np.zeros((graph.node_count, 3))
    _fill(*natural_steps(graph), places)
    return places


@numba.njit(cache=True, nogil=True)
def _fill(follows: NDArray, steps: NDArray, places: NDArray) -> None:
    for node in range(1, steps.shape[0]):
        if follows[node]:
            x, z, yaw = after(triple(places, node - 1), triple(steps, node))
            places[node, 0], places[node, 1], places[node, 2] = x, z, yaw
