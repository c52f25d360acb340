"""Unit quaternions xyzw in batches: every function broadcasts over the leading dimensions.

Euler angles and matrices are left to ``scipy.spatial.transform.Rotation``.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])
IDENTITY.flags.writeable = False


def multiply(a: ArrayLike, b: ArrayLike) -> NDArray[np.float64]:
    """The Hamilton product ``a b``: the rotation ``b`` followed by ``a``.  # (..., 4)"""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    ax, ay, az, aw = (a[..., part] for part in range(4))
    bx, by, bz, bw = (b[..., part] for part in range(4))
    product = np.empty(np.broadcast_shapes(a.shape, b.shape))
    product[..., 0] = aw * bx + ax * bw + ay * bz - az * by
    product[..., 1] = aw * by - ax * bz + ay * bw + az * bx
    product[..., 2] = aw * bz + ax * by - ay * bx + az * bw
    product[..., 3] = aw * bw - ax * bx - ay * by - az * bz
    return product


def conjugate(q: ArrayLike) -> NDArray[np.float64]:
    """The inverse of a unit quaternion.  # (..., 4)"""
    return np.asarray(q, dtype=np.float64) * np.array([-1.0, -1.0, -1.0, 1.0])


def normalise(q: ArrayLike) -> NDArray[np.float64]:
    """``q`` (or any vectors) at length one.  # (..., 4)"""
    values = np.asarray(q, dtype=np.float64)
    return values / np.linalg.norm(values, axis=-1, keepdims=True)


def rotate(q: ArrayLike, v: ArrayLike) -> NDArray[np.float64]:
    """The vectors ``v`` (..., 3) turned by ``q`` (..., 4)."""
    turn = np.asarray(q, dtype=np.float64)
    start = np.asarray(v, dtype=np.float64)
    axis = turn[..., :3]
    twice = 2.0 * _cross(axis, start)
    return start + turn[..., 3:] * twice + _cross(axis, twice)


def _cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """The cross product (..., 3) without the checks that make ``np.cross`` several times slower on small batches."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    product = np.empty(np.broadcast_shapes(a.shape, b.shape))
    product[..., 0] = ay * bz - az * by
    product[..., 1] = az * bx - ax * bz
    product[..., 2] = ax * by - ay * bx
    return product


def from_rotation_vector(vector: ArrayLike) -> NDArray[np.float64]:
    """exp: the rotation about ``vector`` (..., 3) by its length in radians."""
    vector = np.asarray(vector, dtype=np.float64)
    half = 0.5 * np.linalg.norm(vector, axis=-1, keepdims=True)
    return np.concatenate([0.5 * np.sinc(half / np.pi) * vector, np.cos(half)], axis=-1)


def to_rotation_vector(q: ArrayLike) -> NDArray[np.float64]:
    """log: axis times angle of the shorter way round, angle in 0..pi.  # (..., 4) -> (..., 3)"""
    q = np.asarray(q, dtype=np.float64)
    q = np.where(q[..., 3:] < 0.0, -q, q)
    sine = np.linalg.norm(q[..., :3], axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, q[..., 3:])
    tiny = sine < 1e-12
    return q[..., :3] * np.where(tiny, 2.0, angle / np.where(tiny, 1.0, sine))


def slerp(a: ArrayLike, b: ArrayLike, t: ArrayLike) -> NDArray[np.float64]:
    """The rotation a share ``t`` (...) of the shorter way from ``a`` to ``b`` (..., 4)."""
    step = to_rotation_vector(multiply(b, conjugate(a)))
    return multiply(from_rotation_vector(np.asarray(t, dtype=np.float64)[..., None] * step), a)


def from_yaw(yaw: ArrayLike) -> NDArray[np.float64]:
    """The rotation about +y by ``yaw`` (...) radians; positive turns left.  # (..., 4)"""
    half = 0.5 * np.asarray(yaw, dtype=np.float64)
    zero = np.zeros_like(half)
    return np.stack([zero, np.sin(half), zero, np.cos(half)], axis=-1)


def between(a: ArrayLike, b: ArrayLike) -> NDArray[np.float64]:
    """The smallest rotation that turns the directions ``a`` onto ``b`` (..., 3), neither of them zero."""
    start, end = normalise(a), normalise(b)
    cosine = np.sum(start * end, axis=-1, keepdims=True)
    q = np.concatenate([_cross(start, end), 1.0 + cosine], axis=-1)
    opposite = cosine < -1.0 + 1e-9
    return normalise(np.where(opposite, _half_turn(start), q))


def _half_turn(a: NDArray[np.float64]) -> NDArray[np.float64]:
    """A half turn about any axis across ``a``: opposite directions have no single smallest rotation."""
    helper = np.where(np.abs(a[..., :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    return np.concatenate([normalise(_cross(a, helper)), np.zeros((*a.shape[:-1], 1))], axis=-1)


def unroll(q: ArrayLike) -> NDArray[np.float64]:
    """``q`` (F, ..., 4) with signs chosen so that consecutive frames lie in one hemisphere."""
    q = np.array(q, dtype=np.float64)
    flips = np.sum(q[1:] * q[:-1], axis=-1) < 0.0
    signs = np.where(np.cumsum(flips, axis=0) % 2 == 1, -1.0, 1.0)
    q[1:] *= signs[..., None]
    return q
