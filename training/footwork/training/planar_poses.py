"""Poses as a graph's nodes hold them: each in its own planar frame, with the velocities that led to it."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion
from footwork.motion.kinematics import facing_yaw, forward
from footwork.motion.skeleton import Skeleton

FPS = 30.0
_GROUND = np.array([0.0, 1.0, 0.0])


def planar_poses(
    skeleton: Skeleton, root_position: NDArray, rotations: NDArray, lengths: ArrayLike
) -> dict[str, NDArray[np.float64]]:
    """The pose arrays of ``MotionGraph`` by name, and ``places``: the planar place x, z, yaw of each frame.  # (M, ...)

    A velocity is that of the tick before the frame; a stretch's first frame has that of its second.

    Args:
        skeleton: the body.
        root_position: of joint 0 in the world, stretches at 30 Hz laid end to end, metres.  # (M, 3)
        rotations: local rotations.  # (M, J, 4)
        lengths: frames of each stretch; they sum to M.
    """
    yaw = facing_yaw(skeleton, forward(skeleton, root_position, rotations)[0])
    upright = quaternion.from_yaw(-yaw)
    spin = _backward_spin(rotations, lengths)
    spin[:, 0] = quaternion.rotate(upright, spin[:, 0])
    turned = np.array(rotations, dtype=np.float64)
    turned[:, 0] = quaternion.multiply(upright, turned[:, 0])
    return {
        "root_position": root_position * _GROUND,
        "rotations": turned,
        "root_velocity": quaternion.rotate(upright, _backward(np.diff(root_position, axis=0), lengths)),
        "angular_velocity": spin,
        "places": np.column_stack([root_position[:, 0], root_position[:, 2], yaw]),
    }


def _backward_spin(rotations: NDArray, lengths: ArrayLike) -> NDArray[np.float64]:
    """Angular velocity over the tick before each frame, in the parent's frame, rad/s.  # (M, J, 4) -> (M, J, 3)"""
    steps = quaternion.multiply(rotations[1:], quaternion.conjugate(rotations[:-1]))
    return _backward(quaternion.to_rotation_vector(steps), lengths)


def _backward(steps: NDArray, lengths: ArrayLike) -> NDArray[np.float64]:
    """Velocities from the steps between all frames.  # (M - 1, ...) -> (M, ...)"""
    velocity = np.zeros((len(steps) + 1, *steps.shape[1:]))
    velocity[1:] = FPS * steps
    length = np.asarray(lengths, dtype=np.intp)
    first = np.cumsum(length) - length
    # where a stretch has but one frame there is no step at all
    velocity[first] = 0.0
    longer = first[length > 1]
    velocity[longer] = velocity[longer + 1]
    return velocity
