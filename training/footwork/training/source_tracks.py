"""What interpolation reads of the clips, as smooth curves through their frames laid end to end."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.training.centre_of_mass import centre_of_mass


@dataclass(frozen=True, eq=False)
class Tracks:
    """Curves over F frames of all clips.

    Args:
        start: first frame of each clip, and F.  # (clips + 1,)
        turns: local rotations, joint 0 and, after the joints, the feet in the world; signs chosen so that
            neighbouring frames of a clip lie in one hemisphere.  # (F, J + feet, 4)
        points: centre of mass and balls of the feet in the world, metres.  # (F, 1 + feet, 3)
        places: world places of the joints, metres.  # (F, J, 3)
    """

    start: NDArray[np.intp]
    turns: NDArray[np.float64]
    points: NDArray[np.float64]
    places: NDArray[np.float64]


def tracks_of(clips: Sequence[Clip]) -> Tracks:
    """The curves of clips of one body."""
    turns, points, places = zip(*(_curves(clip) for clip in clips), strict=True)
    start = np.cumsum([0, *(clip.frame_count for clip in clips)])
    return Tracks(start, np.concatenate(turns), np.concatenate(points), np.concatenate(places))


def _curves(clip: Clip) -> tuple[NDArray, NDArray, NDArray]:
    body = clip.skeleton
    places, world = clip_places(clip)
    ankles, balls = body.feet.T
    turns = quaternion.unroll(np.concatenate([clip.rotations, world[:, ankles]], axis=1))
    centre = centre_of_mass(body, places, world)
    return turns, np.concatenate([centre[:, None], places[:, balls]], axis=1), places
