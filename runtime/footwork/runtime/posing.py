"""The poses that are shown: node poses between ticks, with what inertialisation adds."""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.runtime.inertialisation import TICK, decay_weights
from footwork.runtime.rotation_kernels import exp, multiply, planar, turned, wide3


@numba.njit(cache=True, nogil=True)
def _pose_root(place, position, velocity, back, root, a, b, shown):
    """The root's place in the world, written into ``shown`` (3,)."""
    x, y, z = wide3(position)
    x, y, z = x - back * velocity[0], y - back * velocity[1], z - back * velocity[2]
    x, y, z = turned(math.cos(place[2]), math.sin(place[2]), (x, y, z))
    shown[0] = place[0] + x + a * root[0, 0] + b * root[1, 0]
    shown[1] = y + a * root[0, 1] + b * root[1, 1]
    shown[2] = place[1] + z + a * root[0, 2] + b * root[1, 2]


@numba.njit(cache=True, nogil=True)
def _pose_joint(q, spin, back, x, v, a, b, yaw_cosine, yaw_sine):
    """A joint's local rotation: the node's, moved back, turned by half the yaw given, then by the offset."""
    turn = exp(-back * spin[0], -back * spin[1], -back * spin[2])
    motion = planar(multiply(turn, (q[0], q[1], q[2], q[3])), yaw_cosine, yaw_sine)
    offset = exp(a * x[0] + b * v[0], a * x[1] + b * v[1], a * x[2] + b * v[2])
    return multiply(offset, motion)


@numba.njit(cache=True, nogil=True)
def pose(
    active: NDArray,
    node: NDArray,
    place: NDArray,
    fraction: float,
    halflife: float,
    root_position: NDArray,
    root_velocity: NDArray,
    rotations: NDArray,
    angular_velocity: NDArray,
    offsets: NDArray,
    velocities: NDArray,
    roots: NDArray,
    shown_root: NDArray,
    shown_rotations: NDArray,
) -> None:
    """Write the poses of all active characters at a fraction of the tick into the last two arrays.

    The node's pose is moved back by its own velocities over what is left of the tick, and the offsets have decayed
    over what has passed of it.

    Args:
        active: which rows are characters.  # (C,)
        node: where each is.  # (C,)
        place: planar places (x, z, yaw) of the nodes.  # (C, 3)
        fraction: how much of the tick has passed, 0..1.
        halflife: of the offsets, s.
        root_position: of the graph.  # (N, 3)
        root_velocity: of the graph.  # (N, 3)
        rotations: of the graph.  # (N, J, 4)
        angular_velocity: of the graph.  # (N, J, 3)
        offsets: of the joints at the start of the tick, rad.  # (C, J, 3)
        velocities: of those, rad/s.  # (C, J, 3)
        roots: offset (m) and its velocity (m/s) of the root.  # (C, 2, 3)
        shown_root: joint 0 in the world, m.  # (C, 3) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (C, J, 4) float32
    """
    back = (1.0 - fraction) * TICK
    a, b, _, _ = decay_weights(fraction * TICK, halflife)
    back32, a32, b32 = np.float32(back), np.float32(a), np.float32(b)
    for who in range(active.shape[0]):
        if not active[who]:
            continue
        here = node[who]
        _pose_root(place[who], root_position[here], root_velocity[here], back, roots[who], a, b, shown_root[who])
        cosine, sine = np.float32(math.cos(0.5 * place[who, 2])), np.float32(math.sin(0.5 * place[who, 2]))
        for joint in range(rotations.shape[1]):
            q = _pose_joint(
                rotations[here, joint],
                angular_velocity[here, joint],
                back32,
                offsets[who, joint],
                velocities[who, joint],
                a32,
                b32,
                cosine if joint == 0 else np.float32(1.0),
                sine if joint == 0 else np.float32(0.0),
            )
            for k in range(4):
                shown_rotations[who, joint, k] = q[k]
