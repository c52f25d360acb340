"""Small motion graphs made by hand, for tests of what runs on graphs."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion import kinematics, quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph, captured

FPS = 30.0
BEHAVIOURS = ("stop", "walk", "run", "jump")


def wandering_clip(seed: int, frames: int = 24) -> Clip:
    """A clip in which every joint turns smoothly at random and the root wanders."""
    body, random = default_body(), np.random.default_rng(seed)
    time = np.arange(frames)[:, None, None] / FPS
    shape = (1, body.joint_count, 3)
    waves = random.normal(0.0, 0.4, shape) * np.sin(random.uniform(2, 8, shape) * time + random.uniform(0, 6, shape))
    rotations = quaternion.from_rotation_vector(waves)
    heading = quaternion.from_yaw(random.uniform(-3, 3) + random.uniform(-2, 2) * time[:, 0, 0])
    rotations[:, 0] = quaternion.multiply(heading, rotations[:, 0])
    root = random.normal(0.0, 1.0, 3) + np.cumsum(quaternion.rotate(heading, [0.0, 0.0, 0.04]), axis=0)
    root[:, 1] = 0.9 + 0.05 * np.sin(9.0 * time[:, 0, 0])
    return Clip(f"wander{seed}", body, FPS, root, rotations)


def planar_places(clip: Clip) -> NDArray[np.float64]:
    """Where the planar frame of each frame lies: (x, z, yaw).  # (F, 3)"""
    yaw = kinematics.facing_yaw(clip.skeleton, kinematics.clip_places(clip)[0])
    return np.stack([clip.root_position[:, 0], clip.root_position[:, 2], yaw], axis=-1)


def homogeneous(place) -> NDArray[np.float64]:
    """The 4 x 4 matrix of a planar place (x, z, yaw)."""
    x, z, yaw = place
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return np.array([[cosine, 0, sine, x], [0, 1, 0, 0], [-sine, 0, cosine, z], [0, 0, 0, 1]])


def _displacement(start, end) -> list[float]:
    matrix = np.linalg.inv(homogeneous(start)) @ homogeneous(end)
    return [matrix[0, 3], matrix[2, 3], np.arctan2(matrix[0, 2], matrix[0, 0])]


def _nodes_of(clip: Clip) -> dict[str, NDArray]:
    """Poses and backward velocities in the planar frames; the first frame's velocity is that of the second."""
    places = planar_places(clip)
    level = quaternion.from_yaw(-places[:, 2])
    step = np.diff(clip.root_position, axis=0) * FPS
    spins = quaternion.multiply(clip.rotations[1:], quaternion.conjugate(clip.rotations[:-1]))
    spins = quaternion.to_rotation_vector(spins) * FPS
    step, spins = np.concatenate([step[:1], step]), np.concatenate([spins[:1], spins])
    rotations = clip.rotations.copy()
    rotations[:, 0] = quaternion.multiply(level, rotations[:, 0])
    spins[:, 0] = quaternion.rotate(level, spins[:, 0])
    root = clip.root_position * [0.0, 1.0, 0.0]
    return {
        "root_position": root,
        "rotations": rotations,
        "root_velocity": quaternion.rotate(level, step),
        "angular_velocity": spins,
    }


def graph_of(clips: list[Clip], jumps: list[tuple[int, int]], behaviour=None) -> MotionGraph:
    """A graph of whole clips, with transitions from node i to node j + 1 for each pair (i, j) of ``jumps``."""
    nodes = [_nodes_of(clip) for clip in clips]
    lengths = [clip.frame_count for clip in clips]
    places = np.concatenate([planar_places(clip) for clip in clips])
    count, ends = sum(lengths), set(np.cumsum(lengths) - 1)
    edges = [
        (node, node + 1, _displacement(places[node], places[node + 1]), True)
        for node in range(count)
        if node not in ends
    ]
    edges += [(i, j + 1, _displacement(places[j], places[j + 1]), False) for i, j in jumps]
    edges.sort(key=lambda edge: edge[0])
    sources = [edge[0] for edge in edges]
    natural = np.array([edge[3] for edge in edges])
    arrays: dict[str, Any] = {name: np.concatenate([part[name] for part in nodes]) for name in nodes[0]}
    frames = np.concatenate([np.arange(length) for length in lengths])
    arrays |= captured(np.repeat(np.arange(len(clips)), lengths), frames)
    arrays |= {
        "label": np.zeros(count),
        "behaviour": np.ones(count) if behaviour is None else behaviour,
        "contacts": np.zeros((count, len(clips[0].skeleton.feet))),
        "edge_start": np.searchsorted(sources, np.arange(count + 1)),
        "target": np.array([edge[1] for edge in edges]),
        "cost": np.where(natural, 0.0, 0.1),
        "smoothness": np.where(natural, 1.0, 0.9),
        "displacement": np.array([edge[2] for edge in edges]),
        "natural": natural,
    }
    names = tuple(clip.name for clip in clips)
    return MotionGraph(skeleton=clips[0].skeleton, clips=names, labels=("walk",), behaviours=BEHAVIOURS, **arrays)


def edge_between(graph: MotionGraph, source: int, target: int) -> int:
    """The edge from one node to another."""
    first, end = graph.edge_start[source], graph.edge_start[source + 1]
    return int(first + np.flatnonzero(graph.target[first:end] == target)[0])
