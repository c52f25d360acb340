"""The arrays in a pose message: raw little-endian float32, so that a pose costs no more than a copy."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.protocol.messages import Pose

WIRE_FLOAT = np.dtype("<f4")


def packed(values: ArrayLike) -> bytes:
    """The wire's bytes of an array of any shape."""
    return np.ascontiguousarray(values, dtype=WIRE_FLOAT).tobytes()


def root_of(pose: Pose) -> NDArray[np.float32]:
    """Place of joint 0 in the world, metres; read-only.  # (3,)"""
    return np.frombuffer(pose.root, dtype=WIRE_FLOAT)


def rotations_of(pose: Pose) -> NDArray[np.float32]:
    """Local rotations xyzw, joint 0 in the world; read-only.  # (J, 4)"""
    return np.frombuffer(pose.rotations, dtype=WIRE_FLOAT).reshape(-1, 4)
