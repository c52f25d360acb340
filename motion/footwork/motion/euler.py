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
    angles = np.asarray(angles, dtype=np.float64)
    if not axes:
        return np.broadcast_to([0.0, 0.0, 0.0, 1.0], (*angles.shape[:-1], 4)).copy()
    flat = angles.reshape(-1, len(axes))
    return Rotation.from_euler(axes, flat).as_quat().reshape(*angles.shape[:-1], 4)


def to_euler(axes: str, rotations: ArrayLike) -> NDArray[np.float64]:
    """Angles (..., 3) in radians of quaternions xyzw (..., 4): the inverse of ``from_euler`` for three axes.

    In gimbal lock, where many triples mean the same rotation, it is one of them.
    """
    rotations = np.asarray(rotations, dtype=np.float64)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Gimbal lock")
        angles = Rotation.from_quat(rotations.reshape(-1, 4)).as_euler(axes)
    return angles.reshape(*rotations.shape[:-1], 3)
