"""The centre of mass of the common body."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion
from footwork.motion.kinematics import forward
from footwork.motion.masses import mass_fractions
from footwork.motion.skeleton import Skeleton


def centre_of_mass(body: Skeleton, root: ArrayLike, rotations: ArrayLike) -> NDArray[np.float64]:
    """Places (..., 3) of the centre of mass, metres, for roots (..., 3) and local rotations (..., J, 4).

    Each segment's mass lies half way along it (convention); fractions of mass as in conventions.md 8 (Winter).
    """
    places, turns = forward(body, root, rotations)
    centres = places + 0.5 * quaternion.rotate(turns, _tips(body))
    return np.einsum("j,...jx->...x", mass_fractions(body.names), centres)


def _tips(body: Skeleton) -> NDArray[np.float64]:
    """The far end of each joint's segment in the joint's frame: its first child, or its end site.  # (J, 3)"""
    tips = np.array(body.ends)
    for joint in range(body.joint_count):
        children = body.children(joint)
        if children:
            tips[joint] = body.offsets[children[0]]
    return tips
