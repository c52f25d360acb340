"""Euler angles of motion files to quaternions and back."""

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation


def from_euler(axes: str, angles: ArrayLike) -> NDArray[np.float64]:
    """Quaternions xyzw (..., 4) of intrinsic rotations about ``axes`` in turn, angles (..., len(axes)) in radians.

    ``"ZXY"`` is Rz Rx Ry, as a BVH joint with the channels Zrotation Xrotation Yrotation means it; no axes at all
    give the identity.
    """
    half = 0.5 * np.asarray(angles, dtype=np.float64)
    q = np.zeros((4, *half.shape[:-1]))
    q[3] = 1.0
    for index, axis in enumerate(axes):
        sine, cosine = np.sin(half[..., index]), np.cos(half[..., index])
        # The product q (sine e_i, cosine), with i, j, k in the order of a right-handed frame.
        i, j, k = ((("XYZ".index(axis) + step) % 3) for step in range(3))
        q[[i, j, k, 3]] = (
            q[i] * cosine + q[3] * sine,
            q[j] * cosine + q[k] * sine,
            q[k] * cosine - q[j] * sine,
            q[3] * cosine - q[i] * sine,
        )
    return np.ascontiguousarray(np.moveaxis(q, 0, -1))


def to_euler(axes: str, rotations: ArrayLike) -> NDArray[np.float64]:
    """Angles (..., 3) in radians of quaternions xyzw (..., 4): the inverse of ``from_euler`` for three axes.

    In gimbal lock, where many triples mean the same rotation, it is one of them.
    """
    rotations = np.asarray(rotations, dtype=np.float64)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Gimbal lock")
        angles = Rotation.from_quat(rotations.reshape(-1, 4)).as_euler(axes)
    return angles.reshape(*rotations.shape[:-1], 3)
