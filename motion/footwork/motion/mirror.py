"""Mirrored motion: left and right exchanged, as seen in a mirror across the body's x.

A mirrored walk is as good a walk: motion for one side serves for the other. Source: convention. The reflection takes
x to -x, so a rotation (x, y, z, w) becomes (x, -y, -z, w), and joints change places with those of the other side.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.skeleton import Skeleton

MIRRORED = " (mirrored)"
"""What a mirrored clip's name ends with."""

_PLACE = np.array([-1.0, 1.0, 1.0])
_ROTATION = np.array([1.0, -1.0, -1.0, 1.0])


def mirrored(clip: Clip) -> Clip:
    """The clip with left and right exchanged; its name gains MIRRORED, or loses it.

    Raises:
        InputError: for a body that is not its own mirror image: both sides need the same joints, called ``left_`` and
            ``right_``, of the same lengths and masses. Capture that was mapped onto the common body has such a body.
    """
    body = clip.skeleton
    joints, feet = _other_sides(body), _other_feet(body)
    shifts = None if clip.translations is None else clip.translations[:, joints] * _PLACE
    return replace(
        clip,
        name=clip.name.removesuffix(MIRRORED) if clip.name.endswith(MIRRORED) else clip.name + MIRRORED,
        root_position=clip.root_position * _PLACE,
        rotations=clip.rotations[:, joints] * _ROTATION,
        contacts=clip.contacts[:, feet],
        translations=shifts,
    )


def _other_sides(body: Skeleton) -> NDArray[np.intp]:
    """For each joint the one on the other side, itself on the middle line.  # (J,)"""
    names = [_exchanged(name) for name in body.names]
    alone = [name for name, other in zip(body.names, names, strict=True) if other not in body.names]
    if alone:
        raise InputError(f"joint {alone[0]!r} has none on the other side, expected both to be mirrored", body.where)
    others = body.indices(names)
    for joint, other in enumerate(others):
        parent = body.parents[joint]
        same_parent = body.parents[other] == (others[parent] if parent >= 0 else parent)
        if not (same_parent and _alike(body, joint, int(other))):
            problem = f"joint {body.names[joint]!r} is no mirror image of {body.names[other]!r}, expected it to be"
            raise InputError(problem, body.where)
    return others


def _exchanged(name: str) -> str:
    for side, other in (("left_", "right_"), ("right_", "left_")):
        if name.startswith(side):
            return other + name.removeprefix(side)
    return name


def _alike(body: Skeleton, joint: int, other: int) -> bool:
    """Whether two joints, or one on the middle line and itself, are mirror images."""
    lengths = (body.offsets, body.ends)
    same = all(np.array_equal(values[joint], values[other] * _PLACE) for values in lengths)
    return same and body.masses[joint] == body.masses[other]


def _other_feet(body: Skeleton) -> list[int]:
    """For each foot the number of the one on the other side."""
    ankles = [body.names[ankle] for ankle in body.feet[:, 0]]
    try:
        return [ankles.index(_exchanged(name)) for name in ankles]
    except ValueError:
        raise InputError(f"its feet are {', '.join(ankles)}, expected both to be mirrored", body.where) from None
