"""Nodes of a motion graph laid out in the world, one after the other along planar steps."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion
from footwork.motion.alignment import turn
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.tick import TICK_RATE


def places_along(steps: ArrayLike) -> NDArray[np.float64]:
    """Planar places x, z, yaw reached by steps (n, 3), each seen from the last place; the first is 0.  # (n + 1, 3)"""
    steps = np.asarray(steps, dtype=np.float64).reshape(-1, 3)
    places = np.zeros((len(steps) + 1, 3))
    places[1:, 2] = np.cumsum(steps[:, 2])
    x, z = turn(steps[:, 0], steps[:, 1], places[:-1, 2])
    places[1:, 0], places[1:, 1] = np.cumsum(x), np.cumsum(z)
    return places


def placed_poses(
    graph: MotionGraph, nodes: NDArray, places: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Root positions (n, 3) and local rotations (n, J, 4) of nodes at planar places x, z, yaw (n, 3).

    A node's own root has x = z = 0 in its planar frame, so the place is where the root goes.
    """
    root = graph.root_position[nodes].astype(np.float64)
    root[:, [0, 2]] += places[:, :2]
    rotations = graph.rotations[nodes].astype(np.float64)
    rotations[:, 0] = quaternion.multiply(quaternion.from_yaw(places[:, 2]), rotations[:, 0])
    return root, rotations


def placed_clip(graph: MotionGraph, nodes: NDArray, steps: ArrayLike, name: str) -> Clip:
    """Nodes (n,) as the frames of a clip, each a planar step (n - 1, 3) on from the one before."""
    return clip_of_poses(graph, nodes, *placed_poses(graph, nodes, places_along(steps)), name)


def clip_of_poses(graph: MotionGraph, nodes: ArrayLike, root: ArrayLike, rotations: ArrayLike, name: str) -> Clip:
    """Poses in the world as a clip, with the contacts and labels of the nodes that they are shown for.

    Args:
        graph: whose nodes.
        nodes: one a pose.  # (n,)
        root: root positions, metres.  # (n, 3)
        rotations: local rotations.  # (n, J, 4)
        name: of the clip.
    """
    return Clip(
        name=name,
        skeleton=graph.skeleton,
        fps=float(TICK_RATE),
        root_position=np.asarray(root, dtype=np.float64),
        rotations=np.asarray(rotations, dtype=np.float64),
        contacts=graph.contacts[np.asarray(nodes)],
        labels=np.array(graph.labels)[graph.label[np.asarray(nodes)]],
    )
