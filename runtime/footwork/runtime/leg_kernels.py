"""Legs inside compiled loops: where a leg is, and two-bone inverse kinematics, in tuples of numbers.

The same formulas for whole arrays are in ``footwork.motion.ik``. A leg is thigh, shank and foot, each a rotation in
the world and the place of its joint; the thigh hangs from joint 0.
"""

import math

import numba

from footwork.runtime.rotation_kernels import along, cross, multiply, rotate

_STRAIGHT = 0.01
"""A leg bent less than this share of the way to its knee has no plane of its own (``motion.ik``)."""
_TINY = 1e-12
_FORWARD = (0.0, 0.0, 1.0)  # where a knee points when it bends from straight, in the thigh's frame


@numba.njit(cache=True, nogil=True)
def dot(a, b):
    """a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@numba.njit(cache=True, nogil=True)
def less(a, b):
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@numba.njit(cache=True, nogil=True)
def scaled(v, scale):
    """A vector times a number."""
    return v[0] * scale, v[1] * scale, v[2] * scale


@numba.njit(cache=True, nogil=True)
def plus(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@numba.njit(cache=True, nogil=True)
def conjugate(q):
    """The inverse of a rotation."""
    return -q[0], -q[1], -q[2], q[3]


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def bent_knee(hip, knee, ankle, thigh_turn, target, span, longest):
    """Rotations of the world to put before the thigh's and the shank's, so that the ankle comes to ``target``.

    Bones keep their lengths and their twist about the bending plane, and the knee points as it did
    (``motion.ik.reach`` without a pole). A target beyond ``longest`` is approached along its own direction.

    Args:
        hip: place of the thigh's joint, metres.
        knee: place of the shank's joint.
        ankle: place of the foot's joint.
        thigh_turn: the thigh's rotation in the world.
        target: where the ankle shall be.
        span: lengths of thigh and shank, metres.
        longest: how far from the hip the ankle may come, metres, at most both bones' lengths.
    """
    to_knee, to_ankle, goal = less(knee, hip), less(ankle, knee), less(target, hip)
    upper, lower = span[0], span[1]
    way = less(ankle, hip)
    way = scaled(way, 1.0 / max(math.sqrt(dot(way, way)), _TINY))
    pole = along(to_knee, -dot(to_knee, way), way, 0.0, way)
    lean = max(_STRAIGHT * upper - math.sqrt(dot(pole, pole)), 0.0)
    pole = along(pole, lean, rotate(thigh_turn, _FORWARD), 0.0, way)
    distance = math.sqrt(dot(goal, goal))
    new_way = scaled(goal, 1.0 / max(distance, _TINY))
    distance = min(max(distance, abs(upper - lower) + _TINY), longest)
    normal, new_normal = _unit(cross(way, pole)), _unit(cross(new_way, pole))

    ahead = (upper * upper - lower * lower + distance * distance) / (2.0 * distance)
    outward = math.sqrt(max(upper * upper - ahead * ahead, 0.0))
    new_knee = along(scaled(new_way, ahead), outward, cross(new_normal, new_way), 0.0, way)
    new_ankle = less(scaled(new_way, distance), new_knee)
    thigh = _between_frames(scaled(to_knee, 1.0 / upper), normal, scaled(new_knee, 1.0 / upper), new_normal)
    return thigh, _between_frames(scaled(to_ankle, 1.0 / lower), normal, scaled(new_ankle, 1.0 / lower), new_normal)


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _unit(v):
    return scaled(v, 1.0 / max(math.sqrt(dot(v, v)), _TINY))


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _between_frames(bone, normal, new_bone, new_normal):
    """The rotation that takes a unit bone to another, and the normal of its bending plane with it.

    A swing of the bone, then a twist about it; each is (a x b, 1 + a . b) before it is brought to length one.
    """
    x, y, z = cross(bone, new_bone)
    w = 1.0 + dot(bone, new_bone)
    # turned by a quaternion of any length: the square of that length is 2 w
    axis = x, y, z
    across = cross(axis, normal)
    carried = along(normal, 1.0, across, 1.0 / max(w, _TINY), cross(axis, across))
    i, j, k = cross(carried, new_normal)
    q = multiply((i, j, k, 1.0 + dot(carried, new_normal)), (x, y, z, w))
    scale = 1.0 / max(math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), _TINY)
    return q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale
