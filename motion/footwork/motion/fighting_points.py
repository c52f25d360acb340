"""The points of a body that count in a fight: what strikes, and what may be struck.

Convention: a fist is half-way along the hand, a foot strikes with its ball. Targets are spheres about the middle of the
head, the middle of the chest, and the belly.
"""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import forward
from footwork.motion.skeleton import Skeleton

LIMBS = ("left_hand", "right_hand", "left_foot", "right_foot")
TARGETS = ("head", "chest", "abdomen")
RADII = (0.12, 0.18, 0.18)
"""Of the targets, metres."""
_JOINTS = ("left_hand", "right_hand", "left_toes", "right_toes", "head", "chest", "spine")
_FIST = 0.5  # of the way along the hand


def fighting_points(skeleton: Skeleton) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """The joints that the points hang from, and where in the joints' frames: LIMBS, then TARGETS.  # (7,), (7, 3)

    Raises:
        InputError: for a body that lacks one of these joints.
    """
    missing = [name for name in (*_JOINTS, "neck") if name not in skeleton.names]
    if missing:
        raise InputError(f"no joint {missing[0]!r}, which a fight needs", skeleton.where)
    joints = skeleton.indices(_JOINTS)
    offsets = np.zeros((len(joints), 3))
    offsets[:2] = _FIST * skeleton.ends[joints[:2]]
    offsets[4] = 0.5 * skeleton.ends[joints[4]]
    offsets[5] = 0.5 * skeleton.offsets[skeleton.index("neck")]
    return frozen(joints, np.int32), frozen(offsets, np.float64)


def points_of(graph: MotionGraph) -> NDArray[np.float64]:
    """The points at every node, in its planar frame, metres.  # (N, 7, 3)

    Raises:
        InputError: as ``fighting_points`` does.
    """
    joints, offsets = fighting_points(graph.skeleton)
    places, turns = forward(graph.skeleton, graph.root_position, graph.rotations)
    return frozen(places[:, joints] + quaternion.rotate(turns[:, joints], offsets), np.float64)
