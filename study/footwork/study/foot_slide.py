"""Foot slide: how far the balls of the feet move over the ground while they stand, cm per second of contact.

Source: conventions.md 7 (convention). A step from one frame to the next counts for a foot that is in contact at both.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.tick import TICK


@dataclass(frozen=True)
class Slide:
    """How far feet slid in contact, metres, and for how long they were in contact, seconds; slides add up."""

    metres: float
    seconds: float

    def __add__(self, other: "Slide") -> "Slide":
        return Slide(self.metres + other.metres, self.seconds + other.seconds)

    @property
    def cm_per_second(self) -> float | None:
        """Slide in cm per second of contact, None where no foot was ever in contact."""
        return 100.0 * self.metres / self.seconds if self.seconds > 0.0 else None


def slide_of_steps(start: ArrayLike, end: ArrayLike, standing: ArrayLike, seconds: float) -> Slide:
    """The slide of steps that all last ``seconds``.

    Args:
        start: balls of the feet before each step.  # (n, feet, 3)
        end: after it.  # (n, feet, 3)
        standing: whether a foot is in contact before and after.  # (n, feet) bool
        seconds: from start to end.
    """
    moved = (np.asarray(end) - np.asarray(start))[..., [0, 2]]
    standing = np.asarray(standing, dtype=bool)
    return Slide(float(np.linalg.norm(moved, axis=-1)[standing].sum()), float(standing.sum()) * seconds)


def slide_of_frames(balls: ArrayLike, contacts: ArrayLike, fps: float) -> Slide:
    """The slide of a run of frames.  # balls (F, feet, 3), contacts (F, feet)"""
    balls, contacts = np.asarray(balls), np.asarray(contacts, dtype=bool)
    return slide_of_steps(balls[:-1], balls[1:], contacts[:-1] & contacts[1:], 1.0 / fps)


def slide_of_clip(clip: Clip) -> Slide:
    """The slide of a clip with contacts."""
    balls = clip_places(clip)[0][:, clip.skeleton.feet[:, 1]]
    return slide_of_frames(balls, clip.contacts, clip.fps)


def slide_of_capture(graph: MotionGraph, clips: ArrayLike | None = None) -> Slide:
    """The slide of the source clips themselves, all or some, over the natural edges between captured frames."""
    meant = graph.original if clips is None else graph.original & np.isin(graph.clip, clips)
    edges = np.flatnonzero(graph.natural & meant[graph.source] & meant[graph.target])
    source, target = graph.source[edges], graph.target[edges]
    balls = forward(graph.skeleton, graph.root_position, graph.rotations)[0][:, graph.skeleton.feet[:, 1]]
    step = graph.displacement[edges].astype(np.float64)
    ahead = quaternion.rotate(quaternion.from_yaw(step[:, None, 2]), balls[target])
    ahead[..., 0] += step[:, None, 0]
    ahead[..., 2] += step[:, None, 1]
    return slide_of_steps(balls[source], ahead, graph.contacts[source] & graph.contacts[target], TICK)


def shown_balls(graph: MotionGraph, root: NDArray, rotations: NDArray) -> NDArray[np.float64]:
    """Balls of the feet of poses as the world shows them.  # (F, 3), (F, J, 4) -> (F, feet, 3)"""
    return forward(graph.skeleton, root, rotations)[0][:, graph.skeleton.feet[:, 1]]
