"""How the tick's kernels lay out joints: one row a component, joints side by side.

Arrays of the form (J, 4) would have the compiler work on one joint after the other; rows of joints let it work on
eight at once, which makes poses about three times as fast. Rows are padded to whole groups of eight.
"""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph

LANES = 8

SPIN = 4
"""In a node's seven rows: the quaternion's x, y, z, w, then from here the angular velocity's x, y, z."""

VELOCITY = 3
"""In a character's six rows: the offset's x, y, z, then from here its velocity's."""


def padded(joints: int) -> int:
    """The length of a row that holds so many joints."""
    return -(-joints // LANES) * LANES


def node_rows(graph: MotionGraph) -> NDArray[np.float32]:
    """Rotations and angular velocities of all nodes.  # (N, 7, padded J)"""
    joints = graph.skeleton.joint_count
    rows = np.zeros((graph.node_count, 7, padded(joints)), dtype=np.float32)
    rows[:, :SPIN, :joints] = graph.rotations.transpose(0, 2, 1)
    rows[:, SPIN:, :joints] = graph.angular_velocity.transpose(0, 2, 1)
    rows.flags.writeable = False
    return rows


def offset_rows(capacity: int, joints: int) -> NDArray[np.float32]:
    """Joint offsets and their velocities of so many characters, all zero.  # (capacity, 6, padded J)"""
    return np.zeros((capacity, 6, padded(joints)), dtype=np.float32)
