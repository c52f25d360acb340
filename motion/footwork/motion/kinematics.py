"""Forward kinematics for whole batches, and what is read off the joints' places: facing and velocities."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.skeleton import Skeleton


def forward(
    skeleton: Skeleton, root_position: ArrayLike, rotations: ArrayLike, translations: ArrayLike | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """World places (..., J, 3) in metres and world rotations (..., J, 4) of all joints.

    Args:
        skeleton: the body.
        root_position: place of joint 0 in the world.  # (..., 3)
        rotations: local rotations xyzw.  # (..., J, 4)
        translations: places in the parents' frames, where they differ from the rest offsets.  # (..., J, 3)
    """
    local = np.asarray(rotations, dtype=np.float64)
    offsets = np.broadcast_to(skeleton.offsets if translations is None else translations, (*local.shape[:-1], 3))
    places = np.empty((*local.shape[:-1], 3))
    turns = np.empty_like(local)
    places[..., 0, :] = root_position
    turns[..., 0, :] = local[..., 0, :]
    for joint in range(1, skeleton.joint_count):
        parent = skeleton.parents[joint]
        turns[..., joint, :] = quaternion.multiply(turns[..., parent, :], local[..., joint, :])
        reach = quaternion.rotate(turns[..., parent, :], offsets[..., joint, :])
        places[..., joint, :] = places[..., parent, :] + reach
    return places, turns


def clip_places(clip: Clip) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """World places (F, J, 3) and rotations (F, J, 4) of every frame of a clip."""
    return forward(clip.skeleton, clip.root_position, clip.rotations, clip.translations)


def local_rotations(skeleton: Skeleton, world: ArrayLike) -> NDArray[np.float64]:
    """Local rotations from world rotations: the inverse of ``forward``.  # (..., J, 4)"""
    world = np.asarray(world, dtype=np.float64)
    local = world.copy()
    local[..., 1:, :] = quaternion.multiply(
        quaternion.conjugate(world[..., skeleton.parents[1:], :]), world[..., 1:, :]
    )
    return local


def facing_yaw(skeleton: Skeleton, places: ArrayLike) -> NDArray[np.float64]:
    """Yaw of the horizontal part of across x up, where across runs from right to left hip plus shoulder.

    Source: conventions.md 5 (convention). The skeleton is the common body; ``places`` is (..., J, 3), the result (...).
    """
    places = np.asarray(places, dtype=np.float64)
    left = skeleton.indices(["left_thigh", "left_upper_arm"])
    right = skeleton.indices(["right_thigh", "right_upper_arm"])
    across = np.sum(places[..., left, :] - places[..., right, :], axis=-2)
    return np.arctan2(-across[..., 2], across[..., 0])


def central_velocity(values: ArrayLike, fps: float) -> NDArray[np.float64]:
    """Velocity by central differences, one-sided at the ends, zero for a single frame.  # (F, ...) -> (F, ...)"""
    values = np.asarray(values, dtype=np.float64)
    if len(values) == 1:
        return np.zeros_like(values)
    return np.gradient(values, 1.0 / fps, axis=0)
