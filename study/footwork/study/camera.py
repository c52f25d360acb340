"""How places in the world come to lie on a picture."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion import quaternion


@dataclass(frozen=True)
class Camera:
    """A camera that looks at a point from a direction, without perspective where ``distance`` is infinite.

    Args:
        yaw: where it looks, radians: 0 looks along +z, positive turns left.
        pitch: how far it looks down, radians.
        target: the point that comes to lie at the origin of the picture.
        distance: from the camera to the target, metres.
    """

    yaw: float
    pitch: float = 0.0
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    distance: float = math.inf

    def project(self, points: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Where points fall: picture places right and up, depth away from the camera, and scale against the target's.

        Args:
            points: in the world, metres.  # (..., 3)

        Returns:
            places (..., 2) in metres at the target's distance, depth (...) in metres beyond the target, scale (...).
        """
        look = quaternion.multiply(
            quaternion.from_yaw(self.yaw), quaternion.from_rotation_vector([self.pitch, 0.0, 0.0])
        )
        seen = quaternion.rotate(quaternion.conjugate(look), np.asarray(points, dtype=np.float64) - self.target)
        depth = seen[..., 2]
        near = np.maximum(self.distance + depth, 0.1)
        scale = np.ones_like(depth) if math.isinf(self.distance) else self.distance / near
        # looking along +z with y up, the world's +x lies to the left of the picture
        return np.stack([-seen[..., 0], seen[..., 1]], axis=-1) * scale[..., None], depth, scale
