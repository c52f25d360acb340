"""The poses that are shown: node poses between ticks, with what inertialisation adds."""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.runtime.motion_rows import SPIN, VELOCITY
from footwork.runtime.rotation_kernels import along, before, column3, column4, exp, multiply, planar, turned


@numba.njit(cache=True, nogil=True)
def _pose_root(place, position, velocity, back, root, a, b, shown):
    """The root's place in the world, written into ``shown`` (3,)."""
    x, y, z = position[0] - back * velocity[0], position[1] - back * velocity[1], position[2] - back * velocity[2]
    x, y, z = turned(math.cos(place[2]), math.sin(place[2]), (x, y, z))
    shown[0] = place[0] + x + a * root[0, 0] + b * root[1, 0]
    shown[1] = y + a * root[0, 1] + b * root[1, 1]
    shown[2] = place[1] + z + a * root[0, 2] + b * root[1, 2]


@numba.njit(cache=True, nogil=True)
def _pose_first_joint(yaw, node, offset, back, a, b, shown):
    """Joint 0 in the world, written into ``shown`` (4,): the yaw stands between the offset and the node's rotation."""
    motion = before(column3(node, SPIN, 0), column4(node, 0, 0), back)
    motion = planar(motion, math.cos(0.5 * yaw), math.sin(0.5 * yaw))
    x, y, z = along((0.0, 0.0, 0.0), a, column3(offset, 0, 0), b, column3(offset, VELOCITY, 0))
    q = multiply(exp(x, y, z), motion)
    for k in range(4):
        shown[k] = q[k]


@numba.njit(cache=True, nogil=True)
def _pose_joints(node, offset, back, a, b, rows):
    """All joints as if none were in the world, eight at once in float32: written into ``rows`` (4, padded J)."""
    for joint in range(rows.shape[1]):
        back_turn = exp(-back * node[4, joint], -back * node[5, joint], -back * node[6, joint])
        motion = multiply(back_turn, (node[0, joint], node[1, joint], node[2, joint], node[3, joint]))
        x = a * offset[0, joint] + b * offset[3, joint]
        y = a * offset[1, joint] + b * offset[4, joint]
        z = a * offset[2, joint] + b * offset[5, joint]
        q = multiply(exp(x, y, z), motion)
        rows[0, joint], rows[1, joint], rows[2, joint], rows[3, joint] = q[0], q[1], q[2], q[3]


@numba.njit(cache=True, nogil=True)
def pose(
    here: int,
    place: tuple[float, float, float],
    back: float,
    weights: tuple[float, float, float, float],
    root_position: NDArray,
    root_velocity: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    root: NDArray,
    shown_root: NDArray,
    shown_rotations: NDArray,
    rows: NDArray,
) -> None:
    """Write one character's pose at a moment of the tick into ``shown_root`` and ``shown_rotations``.

    The node's pose is moved back by its own velocities over what is left of the tick; the offsets have decayed over
    what has passed of it.

    Args:
        here: its node.
        place: its planar place (x, z, yaw) at that moment.
        back: what is left of the tick, s.
        weights: ``decay_weights`` of the offsets over what has passed of it.
        root_position: of the graph.  # (N, 3)
        root_velocity: of the graph.  # (N, 3)
        nodes: ``motion_rows.node_rows`` of the graph.  # (N, 7, padded J)
        offsets: ``motion_rows.offset_rows`` at the start of the tick, rad and rad/s.  # (6, padded J)
        root: offset (m) and its velocity (m/s) of the root.  # (2, 3)
        shown_root: joint 0 in the world, m.  # (3,) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (J, 4) float32
        rows: room to work in.  # (4, padded J) float32
    """
    a, b, _, _ = weights
    _pose_root(place, root_position[here], root_velocity[here], back, root, a, b, shown_root)
    _pose_first_joint(place[2], nodes[here], offsets, back, a, b, shown_rotations[0])
    _pose_joints(nodes[here], offsets, np.float32(back), np.float32(a), np.float32(b), rows)
    for joint in range(1, shown_rotations.shape[0]):
        for k in range(4):
            shown_rotations[joint, k] = rows[k, joint]
