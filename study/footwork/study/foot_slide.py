"""Foot slide: how far the soles of the feet move over the ground while they stand, cm per second of contact.

Source: conventions.md 7 (convention). A step from one frame to the next counts for a foot that is in contact at both.
A sole is two points, so that a foot that pivots on its ball slides too: the ball, and a point behind it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion.alignment import turn
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import clip_places
from footwork.motion.skeleton import Skeleton
from footwork.motion.tick import TICK

HEEL = 0.12
"""Metres from the ball of a foot back to the second point of its sole, over the ground and along the foot."""
_UPRIGHT = 1e-6  # metres from ankle to ball over the ground, under which a foot points nowhere


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


def soles(skeleton: Skeleton, places: ArrayLike) -> NDArray[np.float64]:
    """The two points of each sole over the ground, x and z: the ball, and HEEL behind it.

    A foot points from its ankle to its ball; one that stands upright on its ball has both points there.

    Args:
        skeleton: the body.
        places: of its joints in the world, metres.  # (..., J, 3)

    Returns:
        Metres.  # (..., feet, 2, 2)
    """
    ground = np.asarray(places, dtype=np.float64)[..., [0, 2]]
    ankle, ball = (ground[..., skeleton.feet[:, part], :] for part in (0, 1))
    along = ball - ankle
    length = np.linalg.norm(along, axis=-1, keepdims=True)
    heel = ball - HEEL * np.where(length > _UPRIGHT, along / np.maximum(length, _UPRIGHT), 0.0)
    return np.stack([ball, heel], axis=-2)


def slide_of_steps(start: ArrayLike, end: ArrayLike, standing: ArrayLike, seconds: float) -> Slide:
    """The slide of steps that all last ``seconds``: the mean way of a sole's points.

    Args:
        start: soles before each step.  # (n, feet, 2, 2)
        end: after it.  # (n, feet, 2, 2)
        standing: whether a foot is in contact before and after.  # (n, feet) bool
        seconds: from start to end.
    """
    moved = np.linalg.norm(np.asarray(end) - np.asarray(start), axis=-1).mean(axis=-1)
    return _slide(moved, np.asarray(standing, dtype=bool), seconds)


def slide_of_frames(soles_of_frames: ArrayLike, contacts: ArrayLike, fps: float) -> Slide:
    """The slide of a run of frames.  # soles (F, feet, 2, 2), contacts (F, feet)"""
    points, contacts = np.asarray(soles_of_frames), np.asarray(contacts, dtype=bool)
    return slide_of_steps(points[:-1], points[1:], contacts[:-1] & contacts[1:], 1.0 / fps)


def slide_of_clip(clip: Clip) -> Slide:
    """The slide of a clip with contacts."""
    return slide_of_frames(soles(clip.skeleton, clip_places(clip)[0]), clip.contacts, clip.fps)


def slide_of_capture(graph: MotionGraph, clips: ArrayLike | None = None, highest: float = np.inf) -> Slide:
    """The slide of the source clips themselves, all or some, over the natural edges between captured frames.

    Args:
        graph: the graph.
        clips: indices of the clips that are meant; all where not given.
        highest: a foot whose ball is higher than this is in the air whatever its contact says, metres.
    """
    meant = graph.original if clips is None else graph.original & np.isin(graph.clip, clips)
    return _slide(*_natural_steps(graph, meant, highest))


def slide_of_interpolation(graph: MotionGraph) -> tuple[Slide, Slide]:
    """The slide of interpolated motion, and that of the captured frames it is made of, in shares of their weights.

    Both over the interpolated frames whose sources the graph holds, and over feet that stand in all three.
    """
    moved, standing = _natural_steps(graph, np.ones(graph.node_count, dtype=bool))
    captured = np.flatnonzero(graph.original)
    frames = 1 + int(max(graph.frame.max(initial=0), graph.other_frame.max(initial=0)))
    node = np.full((len(graph.clips), frames), -1)
    node[graph.clip[captured], graph.frame[captured]] = captured
    first, second = node[graph.clip, graph.frame], node[graph.other_clip, graph.other_frame]
    made = np.flatnonzero(~graph.original & (first >= 0) & (second >= 0))
    first, second, share = first[made], second[made], graph.weight[made, None]
    together = standing[made] & standing[first] & standing[second]
    sources = share * moved[first] + (1.0 - share) * moved[second]
    return _slide(moved[made], together), _slide(sources, together)


def _natural_steps(
    graph: MotionGraph, meant: NDArray[np.bool_], highest: float = np.inf
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """How far each sole moves from each node meant to the next, metres, and whether it stands there.  # (N, feet) each

    Nothing stands on the way to or from a node that is not meant, nor where no motion goes on.
    """
    edges = np.flatnonzero(graph.natural & meant[graph.source] & meant[graph.target])
    source, target = graph.source[edges], graph.target[edges]
    places = graph.joint_places
    here = soles(graph.skeleton, places)
    on_ground = graph.contacts & (places[:, graph.skeleton.feet[:, 1], 1] <= highest)
    step = graph.displacement[edges].astype(np.float64)[:, None, None]
    x, z = turn(here[target][..., 0], here[target][..., 1], step[..., 2])
    ahead = np.stack([x, z], axis=-1) + step[..., :2]
    moved, standing = np.zeros(graph.contacts.shape), np.zeros(graph.contacts.shape, dtype=bool)
    moved[source] = np.linalg.norm(ahead - here[source], axis=-1).mean(axis=-1)
    standing[source] = on_ground[source] & on_ground[target]
    return moved, standing


def _slide(moved: NDArray[np.float64], standing: NDArray[np.bool_], seconds: float = TICK) -> Slide:
    return Slide(float(moved[standing].sum()), float(standing.sum()) * seconds)
