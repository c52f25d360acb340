"""The nodes of a motion graph: every frame of some clips, in its own planar frame, with its behaviour."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.graph import NO_BEHAVIOUR, captured
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.motion.skeleton import Skeleton
from footwork.motion.task import BEHAVIOUR_OF_LABEL

FPS = 30.0


@dataclass(frozen=True, eq=False)
class Nodes:
    """The frames of clips laid end to end; letters and units as in MotionGraph.

    Args:
        skeleton: the body that all clips share.
        clips: names of the clips.
        labels: the words that frames are labelled with, sorted.
        behaviours: the behaviours that commands may ask for.
        lengths: frames of each clip; they sum to N.
        arrays: the node arrays of MotionGraph by name, each (N, ...).
        places: planar place x, z, yaw of each frame in its clip's world, metres and radians.  # (N, 3)
    """

    skeleton: Skeleton
    clips: tuple[str, ...]
    labels: tuple[str, ...]
    behaviours: tuple[str, ...]
    lengths: tuple[int, ...]
    arrays: dict[str, Any]
    places: NDArray[np.float64]

    @property
    def ends(self) -> NDArray[np.intp]:
        """For each frame the last frame of its clip.  # (N,)"""
        return np.repeat(np.cumsum(self.lengths) - 1, self.lengths)


def nodes_of(clips: Sequence[Clip], behaviours: tuple[str, ...]) -> Nodes:
    """The frames of clips as nodes.

    Raises:
        InputError: for no clips, clips of different bodies or not at 30 frames a second.
    """
    skeleton = _common_skeleton(clips)
    labels = tuple(sorted({str(label) for clip in clips for label in np.unique(clip.labels)}))
    parts = [_arrays(clip) for clip in clips]
    arrays = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    places = arrays.pop("places")
    lengths = tuple(clip.frame_count for clip in clips)
    arrays |= captured(np.repeat(np.arange(len(clips)), lengths), arrays["frame"])
    arrays["label"] = np.searchsorted(labels, np.concatenate([clip.labels for clip in clips]))
    arrays["behaviour"] = np.concatenate([behaviours_of(clip.labels, behaviours) for clip in clips])
    return Nodes(skeleton, tuple(clip.name for clip in clips), labels, behaviours, lengths, arrays, places)


def behaviours_of(labels: NDArray[np.str_], behaviours: tuple[str, ...]) -> NDArray[np.int16]:
    """Index of each frame's behaviour, -1 for none (conventions.md 5).  # (F,) -> (F,)

    A turn counts as walk, or as run where the frames before and after it run (or those on the one side there is).
    """
    names = [BEHAVIOUR_OF_LABEL.get(str(label), "") for label in labels]
    for start, end in _stretches(labels):
        around = [str(labels[at]) for at in (start - 1, end) if 0 <= at < len(labels)]
        if labels[start] == "turn" and around and all(label == "run" for label in around):
            names[start:end] = ["run"] * (end - start)
    known = {name: index for index, name in enumerate(behaviours)}
    return np.array([known.get(name, NO_BEHAVIOUR) for name in names], dtype=np.int16)


def _stretches(labels: NDArray[np.str_]) -> list[tuple[int, int]]:
    """Start and end of each run of equal labels."""
    cuts = np.flatnonzero(labels[1:] != labels[:-1]) + 1
    edges = [0, *cuts.tolist(), len(labels)]
    return list(pairwise(edges))


def _common_skeleton(clips: Sequence[Clip]) -> Skeleton:
    if not clips:
        raise InputError("no clips, expected at least one", "motions")
    body = clips[0].skeleton
    for clip in clips:
        same = clip.skeleton.names == body.names and np.array_equal(clip.skeleton.offsets, body.offsets)
        if not same or clip.translations is not None:
            raise InputError(f"another body than that of {clips[0].name}, expected the common body", clip.name)
        if clip.fps != FPS:
            raise InputError(f"{clip.fps:g} frames a second, expected {FPS:g}", clip.name)
    return body


def _arrays(clip: Clip) -> dict[str, NDArray]:
    yaw = facing_yaw(clip.skeleton, clip_places(clip)[0])
    upright = quaternion.from_yaw(-yaw)
    spin = _backward_spin(clip.rotations)
    spin[:, 0] = quaternion.rotate(upright, spin[:, 0])
    rotations = clip.rotations.copy()
    rotations[:, 0] = quaternion.multiply(upright, rotations[:, 0])
    ground = np.array([0.0, 1.0, 0.0])
    return {
        "frame": np.arange(clip.frame_count),
        "contacts": clip.contacts,
        "root_position": clip.root_position * ground,
        "rotations": rotations,
        "root_velocity": quaternion.rotate(upright, _backward(np.diff(clip.root_position, axis=0))),
        "angular_velocity": spin,
        "places": np.column_stack([clip.root_position[:, 0], clip.root_position[:, 2], yaw]),
    }


def _backward_spin(rotations: NDArray) -> NDArray[np.float64]:
    """Angular velocity over the tick before each frame, in the parent's frame, rad/s.  # (F, J, 4) -> (F, J, 3)"""
    steps = quaternion.multiply(rotations[1:], quaternion.conjugate(rotations[:-1]))
    return _backward(quaternion.to_rotation_vector(steps))


def _backward(steps: NDArray) -> NDArray[np.float64]:
    """Velocities from the steps between frames; the first frame has that of the second.  # (F - 1, ...) -> (F, ...)"""
    if not len(steps):
        return np.zeros((1, *steps.shape[1:]))
    return FPS * np.concatenate([steps[:1], steps])
