"""The nodes of a motion graph: every frame of some clips, in its own planar frame, with its behaviour."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.graph import NO_BEHAVIOUR, captured
from footwork.motion.skeleton import Skeleton
from footwork.motion.state_machine import StateMachine
from footwork.motion.task import BEHAVIOUR_OF_LABEL
from footwork.training.planar_poses import FPS, planar_poses


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
    lengths = tuple(clip.frame_count for clip in clips)
    root = np.concatenate([clip.root_position for clip in clips])
    rotations = np.concatenate([clip.rotations for clip in clips])
    arrays: dict[str, Any] = planar_poses(skeleton, root, rotations, lengths)
    places = arrays.pop("places")
    arrays |= captured(
        np.repeat(np.arange(len(clips)), lengths), np.concatenate([np.arange(length) for length in lengths])
    )
    arrays["contacts"] = np.concatenate([clip.contacts for clip in clips])
    arrays["label"] = np.searchsorted(labels, np.concatenate([clip.labels for clip in clips]))
    arrays["behaviour"] = np.concatenate([behaviours_of(clip.labels, behaviours) for clip in clips])
    return Nodes(skeleton, tuple(clip.name for clip in clips), labels, behaviours, lengths, arrays, places)


def nodes_in_states(clips: Sequence[Clip], machine: StateMachine) -> Nodes:
    """The frames of clips as nodes whose behaviours are the states that labels show; errors as of ``nodes_of``."""
    nodes = nodes_of(clips, machine.names)
    state = np.array(machine.states_of(nodes.labels), dtype=np.int16)[nodes.arrays["label"]]
    return replace(nodes, arrays=nodes.arrays | {"behaviour": state})


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
