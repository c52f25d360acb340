"""The windows of a graph's nodes: the frames round each along its natural edges, laid out as the metric has them."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.alignment import turn
from footwork.motion.graph import MotionGraph
from footwork.motion.window import RADIUS

NONE = -1


class GraphWindows:
    """Where the natural edges of a graph lead, forwards and back.

    Args:
        graph: the graph.

    Attributes:
        before: the node before each in its motion, NONE where there is none.  # (N,)
        after: the node after each.  # (N,)
        step: planar place of that node, seen from the one before it, zero where there is none.  # (N, 3)
    """

    def __init__(self, graph: MotionGraph) -> None:
        edges = np.flatnonzero(graph.natural)
        source, target = graph.source[edges], graph.target[edges]
        self.graph = graph
        self.before, self.after = (np.full(graph.node_count, NONE, dtype=np.int64) for _ in range(2))
        self.before[target], self.after[source] = source, target
        self.step = np.zeros((graph.node_count, 3))
        self.step[source] = graph.displacement[edges]

    def nodes(self, middle: NDArray) -> NDArray[np.int64]:
        """The nodes of each node's window, NONE where its motion has none.  # (n,) -> (n, LENGTH)"""
        early, late = [np.asarray(middle, dtype=np.int64)], []
        here = early[0]
        for _ in range(RADIUS):
            early.append(np.where(early[-1] == NONE, NONE, self.before[early[-1]]))
            here = np.where(here == NONE, NONE, self.after[here])
            late.append(here)
        return np.stack([*early[::-1], *late], axis=1)

    def held(self, windows: NDArray) -> NDArray[np.int64]:
        """Windows whose missing nodes are the nearest that there is.  # (..., LENGTH)"""
        whole = windows.copy()
        for at in range(RADIUS - 1, -1, -1):
            whole[..., at] = np.where(whole[..., at] == NONE, whole[..., at + 1], whole[..., at])
        for at in range(RADIUS + 1, windows.shape[-1]):
            whole[..., at] = np.where(whole[..., at] == NONE, whole[..., at - 1], whole[..., at])
        return whole

    def places(self, windows: NDArray) -> NDArray[np.float64]:
        """Planar places of whole windows' nodes, seen from their first.  # (..., LENGTH) -> (..., LENGTH, 3)"""
        places = np.zeros((*windows.shape, 3))
        for at in range(1, windows.shape[-1]):
            moves = windows[..., at] != windows[..., at - 1]
            step = self.step[windows[..., at - 1]] * moves[..., None]
            places[..., at, :] = composed(places[..., at - 1, :], step)
        return places

    def points(self, windows: NDArray) -> NDArray[np.float64]:
        """Joints of whole windows, each in the planar frame of its first node, metres.

        # (..., LENGTH) -> (..., LENGTH, J, 3)
        """
        return laid(self.graph.joint_places[windows], self.places(windows))


def composed(place: NDArray, step: NDArray) -> NDArray[np.float64]:
    """Planar places: a step seen from where ``place`` is.  # (..., 3), (..., 3) -> (..., 3)"""
    x, z = turn(step[..., 0], step[..., 1], place[..., 2])
    return place + np.stack([x, z, step[..., 2]], axis=-1)


def laid(points: NDArray, place: NDArray) -> NDArray[np.float64]:
    """Points (..., J, 3) in a planar frame that lies at a place x, z, yaw (..., 3)."""
    x, z = turn(points[..., 0], points[..., 2], place[..., 2, None])
    return np.stack([x + place[..., 0, None], points[..., 1], z + place[..., 1, None]], axis=-1)
