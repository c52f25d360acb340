"""Small made-up clips and graphs for tests: smooth random motion of the common body, with a known seed."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph, captured

STRIDE = 32  # frames in which a sample clip's swing comes round again, so that clips meet themselves
# left and right foot in contact, phase by phase
BY_TURNS = ((True, False), (False, True))
EVERY_WAY = ((True, False), (True, True), (False, True), (False, False))


@dataclass
class SampleMotions:
    """Clips as a build takes them: with the files they come from and whom to thank."""

    clips: Sequence[Clip]
    files: Sequence[dict[str, str]] = ()
    attribution: Sequence[str] = ()


def sample_clip(seed: int = 0, frames: int = 120, label: str = "walk", speed: float = 1.2, turn: float = 0.4) -> Clip:
    """A body that travels along an arc with all joints swinging smoothly and periodically, at 30 Hz.

    Clips of different seeds differ a little in how they swing and start at different places and yaws.
    """
    body = default_body()
    rng = np.random.default_rng(seed)
    common = np.random.default_rng(1234)
    swing = common.normal(0.0, 0.25, (body.joint_count, 3)) + rng.normal(0.0, 0.02, (body.joint_count, 3))
    lag = common.uniform(0.0, 2.0 * np.pi, (body.joint_count, 3))
    beat = 2.0 * np.pi * np.arange(frames) / STRIDE + rng.uniform(0.0, 2.0 * np.pi)
    rotations = quaternion.from_rotation_vector(swing * np.sin(beat[:, None, None] + lag))
    yaw = rng.uniform(-np.pi, np.pi) + turn * np.arange(frames) / 30.0
    rotations[:, 0] = quaternion.multiply(quaternion.from_yaw(yaw), rotations[:, 0])
    steps = speed / 30.0 * np.stack([np.sin(yaw), np.zeros(frames), np.cos(yaw)], axis=-1)
    place = np.cumsum(steps, axis=0) + np.array([rng.uniform(-3, 3), 0.94, rng.uniform(-3, 3)])
    place[:, 1] += 0.02 * np.sin(2.0 * beat)
    return Clip(f"sample{seed}", body, 30.0, place, rotations, labels=np.full(frames, label))


def sample_clips(count: int = 4, frames: int = 120) -> list[Clip]:
    """Several sample clips that stand, walk, run and jump by turns and turn different ways."""
    labels = ("walk", "idle", "run", "jump")
    return [
        sample_clip(seed, frames, labels[seed % len(labels)], speed=1.0 + 0.1 * seed, turn=0.6 - 0.4 * seed)
        for seed in range(count)
    ]


def stepping(clip: Clip, stance: int, phases: Sequence[tuple[bool, bool]] = BY_TURNS) -> Clip:
    """The clip with other contacts: its feet go through the phases in turn, ``stance`` frames each."""
    return replace(clip, contacts=np.array(phases)[np.arange(clip.frame_count) // stance % len(phases)])


def ring_graph(nodes: int = 12, turn: float = 0.0, behaviours: tuple[str, ...] = ("stop", "walk")) -> MotionGraph:
    """A single loop of natural edges: every node walks 4 cm on and turns by ``turn`` radians."""
    body = default_body()
    sources: dict[str, Any] = captured(np.zeros(nodes), np.arange(nodes))
    return MotionGraph(
        **sources,
        skeleton=body,
        clips=("ring",),
        labels=("walk",),
        behaviours=behaviours,
        label=np.zeros(nodes, np.int16),
        behaviour=np.full(nodes, behaviours.index("walk"), np.int16),
        contacts=np.zeros((nodes, len(body.feet)), np.bool_),
        root_position=np.tile(np.array([0.0, 0.94, 0.0], np.float32), (nodes, 1)),
        rotations=np.tile(quaternion.IDENTITY.astype(np.float32), (nodes, body.joint_count, 1)),
        root_velocity=np.tile(np.array([0.0, 0.0, 1.2], np.float32), (nodes, 1)),
        angular_velocity=np.zeros((nodes, body.joint_count, 3), np.float32),
        edge_start=np.arange(nodes + 1, dtype=np.int32),
        target=np.roll(np.arange(nodes, dtype=np.int32), -1),
        cost=np.zeros(nodes, np.float32),
        smoothness=np.ones(nodes, np.float32),
        displacement=np.tile(np.array([0.0, 0.04, turn], np.float32), (nodes, 1)),
        natural=np.ones(nodes, np.bool_),
    )
