"""The poses that are shown: node poses between ticks, with what inertialisation adds."""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.runtime.inertialisation import decay_weights
from footwork.runtime.motion_rows import SPIN, VELOCITY
from footwork.runtime.moving import glided
from footwork.runtime.rotation_kernels import along, before, column3, column4, exp, multiply, planar, turned


@numba.njit(cache=True, nogil=True, forceinline=True)
def _pose_root(place, position, velocity, back, root, a, b, shown):
    """The root's place in the world, written into ``shown`` (3,)."""
    x, y, z = position[0] - back * velocity[0], position[1] - back * velocity[1], position[2] - back * velocity[2]
    x, y, z = turned(math.cos(place[2]), math.sin(place[2]), (x, y, z))
    shown[0] = place[0] + x + a * root[0, 0] + b * root[1, 0]
    shown[1] = y + a * root[0, 1] + b * root[1, 1]
    shown[2] = place[1] + z + a * root[0, 2] + b * root[1, 2]


@numba.njit(cache=True, nogil=True, forceinline=True)
def _pose_first_joint(yaw, node, offset, back, a, b, shown):
    """Joint 0 in the world, written into ``shown`` (4,): the yaw stands between the offset and the node's rotation."""
    motion = before(column3(node, SPIN, 0), column4(node, 0, 0), back)
    motion = planar(motion, math.cos(0.5 * yaw), math.sin(0.5 * yaw))
    x, y, z = along((0.0, 0.0, 0.0), a, column3(offset, 0, 0), b, column3(offset, VELOCITY, 0))
    q = multiply(exp(x, y, z), motion)
    for k in range(4):
        shown[k] = q[k]


@numba.njit(cache=True, nogil=True, forceinline=True)
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
    slots: NDArray,
    node: NDArray,
    place: NDArray,
    glide: NDArray,
    fraction: float,
    halflife: float,
    root_position: NDArray,
    root_velocity: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    roots: NDArray,
    shown_root: NDArray,
    shown_rotations: NDArray,
) -> None:
    """Write the poses of characters at a fraction of the tick into the last two arrays.

    The node's pose is moved back by its own velocities, and its place along its glide, over what is left of the tick;
    the offsets have decayed over what has passed of it.

    Args:
        slots: which rows.  # (n,)
        node: where each is.  # (C,)
        place: planar places (x, z, yaw) of the nodes.  # (C, 3)
        glide: planar motions that led there over the tick, m and rad a tick.  # (C, 3)
        fraction: how much of the tick has passed, 0..1.
        halflife: of the offsets, s.
        root_position: of the graph.  # (N, 3)
        root_velocity: of the graph.  # (N, 3)
        nodes: ``motion_rows.node_rows`` of the graph.  # (N, 7, padded J)
        offsets: ``motion_rows.offset_rows`` at the start of the tick, rad and rad/s.  # (C, 6, padded J)
        roots: offset (m) and its velocity (m/s) of the root.  # (C, 2, 3)
        shown_root: joint 0 in the world, m.  # (C, 3) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (C, J, 4) float32
    """
    back = (1.0 - fraction) * TICK
    a, b, _, _ = decay_weights(fraction * TICK, halflife)
    back32, a32, b32 = np.float32(back), np.float32(a), np.float32(b)
    rows = np.empty((4, nodes.shape[2]), dtype=np.float32)
    for who in slots:
        here, shown = node[who], shown_rotations[who]
        at = glided(place[who], glide[who], fraction - 1.0)
        _pose_root(at, root_position[here], root_velocity[here], back, roots[who], a, b, shown_root[who])
        _pose_first_joint(at[2], nodes[here], offsets[who], back, a, b, shown[0])
        _pose_joints(nodes[here], offsets[who], back32, a32, b32, rows)
        for joint in range(1, shown.shape[0]):
            for k in range(4):
                shown[joint, k] = rows[k, joint]
