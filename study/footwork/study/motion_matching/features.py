"""What motion matching compares: 27 numbers of each frame, about its pose and about where it goes.

After the public reference implementation of motion matching: places and velocities of both ankles, the velocity of
the hips, and places and directions of the planar frame a third, two thirds and three thirds of a second ahead, all seen
from the frame's own planar frame.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.motion.alignment import turn
from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.tick import TICK
from footwork.study.motion_matching.chains import Chains, world_points

COUNT = 27
AHEAD = (10, 20, 30)
"""How many ticks ahead the trajectory is looked at: 20, 40 and 60 frames at 60 Hz."""
FOOT_POSITION, FOOT_VELOCITY, HIP_VELOCITY = slice(0, 6), slice(6, 12), slice(12, 15)
TRAJECTORY_POSITION, TRAJECTORY_DIRECTION = slice(15, 21), slice(21, 27)
GROUPS = {
    "foot_position": FOOT_POSITION,
    "foot_velocity": FOOT_VELOCITY,
    "hip_velocity": HIP_VELOCITY,
    "trajectory_position": TRAJECTORY_POSITION,
    "trajectory_direction": TRAJECTORY_DIRECTION,
}


class Weights(NamedTuple):
    """How much each group of features counts; the defaults are the reference's."""

    foot_position: float = 0.75
    foot_velocity: float = 1.0
    hip_velocity: float = 1.0
    trajectory_position: float = 1.0
    trajectory_direction: float = 1.5


@dataclass(frozen=True, eq=False)
class Features:
    """Features of N frames, as they are compared: (raw - offset) / scale.

    Args:
        values: of every frame.  # (N, 27) float32
        offset: mean of each feature.  # (27,)
        scale: mean standard deviation of the feature's group, divided by its weight.  # (27,)
    """

    values: NDArray[np.float32]
    offset: NDArray[np.float64]
    scale: NDArray[np.float64]


def raw_features(graph: MotionGraph, chains: Chains) -> NDArray[np.float64]:
    """The features of every node, metres and metres a second.  # (N, 27)

    Left ankle and right ankle (x, y, z), their velocities, the hips' velocity, then (x, z) of the places ahead and
    the directions (sin, cos of the yaw) ahead. Velocities are over the ground, by central differences, one-sided at
    the ends of a stretch; what lies ahead of its end is its last frame.
    """
    ankles = world_points(graph, chains, graph.skeleton.feet[:, 0].astype(np.intp))
    hips = world_points(graph, chains, np.array([0]))
    nodes = len(ankles)
    return np.hstack(
        [
            _seen(ankles - _level(chains.place), chains).reshape(nodes, -1),
            _seen(_velocity(ankles, chains), chains).reshape(nodes, -1),
            _seen(_velocity(hips, chains), chains).reshape(nodes, -1),
            *_ahead(chains),
        ]
    )


def normalised(raw: NDArray[np.float64], weights: Weights) -> Features:
    """Features with each group at mean zero and, on average over it, standard deviation times weight one."""
    offset, scale = raw.mean(axis=0), np.empty(COUNT)
    for name, group in GROUPS.items():
        spread = raw[:, group].std(axis=0).mean()
        scale[group] = (spread if spread > 0.0 else 1.0) / getattr(weights, name)
    return Features(frozen((raw - offset) / scale, np.float32), frozen(offset, np.float64), frozen(scale, np.float64))


def _level(place: NDArray) -> NDArray[np.float64]:
    """The points on the ground under planar places.  # (N, 3) -> (N, 1, 3)"""
    return np.stack([place[:, 0], np.zeros(len(place)), place[:, 1]], axis=-1)[:, None]


def _seen(vectors: NDArray, chains: Chains) -> NDArray[np.float64]:
    """Vectors (N, P, 3) turned into each node's planar frame."""
    x, z = turn(vectors[..., 0], vectors[..., 2], -chains.place[:, 2:])
    return np.stack([x, vectors[..., 1], z], axis=-1)


def _velocity(points: NDArray, chains: Chains) -> NDArray[np.float64]:
    """Velocities of points (N, P, 3) within their stretches, zero where a stretch is a single node."""
    node = np.arange(len(points))
    before, after = np.maximum(node - 1, chains.first), np.minimum(node + 1, chains.last)
    return (points[after] - points[before]) / (np.maximum(after - before, 1) * TICK)[:, None, None]


def _ahead(chains: Chains) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places (N, 6) and directions (N, 6) of the planar frame AHEAD."""
    node, place = np.arange(len(chains.first)), chains.place
    positions, directions = [], []
    for ticks in AHEAD:
        away = place[np.minimum(node + ticks, chains.last)] - place
        positions += turn(away[:, 0], away[:, 1], -place[:, 2])
        directions += [np.sin(away[:, 2]), np.cos(away[:, 2])]
    return np.stack(positions, axis=-1), np.stack(directions, axis=-1)
