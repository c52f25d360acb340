"""Blended transitions: a third of a second in which one motion is faded into another laid onto it.

After Kovar, Gleicher and Pighin (2002): rotations slerp and the root goes straight, by the weight
2 u^3 - 3 u^2 + 1 of the motion that is left, u from 0 to 1. Convention: the blend is over the metric's own window,
five frames to each side of the pair, so what is blended is what was compared.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.alignment import Alignment, turn
from footwork.motion.clip import Clip
from footwork.motion.window import LENGTH, RADIUS

AROUND = 3  # frames on each side of a blend that come along as they are, so that its first and last speeds are known
MARGIN = RADIUS + AROUND  # frames that must lie to each side of both frames of a pair
BLEND = slice(AROUND, AROUND + LENGTH)  # where the blend lies among the frames of a run
RUN = LENGTH + 2 * AROUND  # frames of a run


class Runs(NamedTuple):
    """M runs of RUN frames, each a motion of its own."""

    root_position: NDArray[np.float64]  # (M, RUN, 3)
    rotations: NDArray[np.float64]  # (M, RUN, J, 4)
    contacts: NDArray[np.bool_]  # (M, RUN, feet)


def fading() -> NDArray[np.float64]:
    """Weight of the motion that is left, by frame of a run: 1, then 2 u^3 - 3 u^2 + 1, then 0.  # (RUN,)"""
    u = np.clip((np.arange(RUN) - AROUND) / (LENGTH - 1), 0.0, 1.0)
    return 2.0 * u**3 - 3.0 * u**2 + 1.0


def runs_of(clips: Sequence[Clip], frames: ArrayLike) -> Runs:
    """The captured runs round some frames, which are numbered through the clips laid end to end.

    Raises:
        InputError: for a frame with fewer than MARGIN frames of its clip on either side.
    """
    frames = np.asarray(frames, dtype=np.intp)
    lengths = [clip.frame_count for clip in clips]
    if not inside(lengths, frames).all():
        raise InputError(f"a frame nearer than {MARGIN} frames to an end of its clip", "blend")
    rows = frames[:, None] + np.arange(-MARGIN, MARGIN + 1)
    root, rotations, contacts = (
        np.concatenate([getattr(clip, part) for clip in clips])[rows]
        for part in ("root_position", "rotations", "contacts")
    )
    return Runs(root, rotations, contacts)


def inside(lengths: Sequence[int], frames: ArrayLike) -> NDArray[np.bool_]:
    """Whether frames of clips laid end to end have MARGIN frames of their clip on both sides."""
    place = np.concatenate([np.arange(length) for length in lengths])[np.asarray(frames, dtype=np.intp)]
    left = np.concatenate([np.arange(length)[::-1] for length in lengths])[np.asarray(frames, dtype=np.intp)]
    return np.minimum(place, left) >= MARGIN


def laid(runs: Runs, alignment: Alignment) -> Runs:
    """Runs turned and shifted on the ground, each as its alignment says.  # alignment of (M,)"""
    theta, x0, z0 = (np.asarray(part)[:, None] for part in alignment[:3])
    x, z = turn(runs.root_position[..., 0], runs.root_position[..., 2], theta)
    rotations = runs.rotations.copy()
    rotations[..., 0, :] = quaternion.multiply(quaternion.from_yaw(theta), rotations[..., 0, :])
    root = np.stack([x + x0, runs.root_position[..., 1], z + z0], axis=-1)
    return Runs(root, rotations, runs.contacts)


def blended(source: Runs, target: Runs) -> Runs:
    """Runs that leave ``source`` for ``target``, which lies where it is meant to; in contact where both are."""
    share = 1.0 - fading()
    return Runs(
        source.root_position + share[:, None] * (target.root_position - source.root_position),
        quaternion.slerp(source.rotations, target.rotations, share[:, None]),
        source.contacts & target.contacts,
    )
