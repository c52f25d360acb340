"""The body's centre of mass: each segment's mass halfway along the segment (convention)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.skeleton import Skeleton


def mass_shares(skeleton: Skeleton) -> NDArray[np.float64]:
    """Each segment's share of the body's mass.  # (J,)

    Raises:
        InputError: for a skeleton without masses.
    """
    total = skeleton.masses.sum()
    if not total > 0.0:
        raise InputError("its segments have no masses, expected those of the common body", skeleton.where)
    return skeleton.masses / total


def segment_centres(skeleton: Skeleton) -> NDArray[np.float64]:
    """The middle of each segment in its joint's frame, metres: half-way to its children or its end.  # (J, 3)"""
    centres = 0.5 * skeleton.ends
    for joint in range(skeleton.joint_count):
        children = skeleton.children(joint)
        if children:
            centres[joint] = 0.5 * skeleton.offsets[children].mean(axis=0)
    return centres


def centre_of_mass(skeleton: Skeleton, places: ArrayLike, turns: ArrayLike) -> NDArray[np.float64]:
    """Centre of mass of poses, metres.  # (..., J, 3), (..., J, 4) -> (..., 3)

    Args:
        skeleton: the body.
        places: world places of its joints, metres.
        turns: their world rotations.
    """
    middles = np.asarray(places) + quaternion.rotate(turns, segment_centres(skeleton))
    return np.einsum("...jk,j->...k", middles, mass_shares(skeleton))
