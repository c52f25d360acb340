"""The yaw and the shift on the ground that bring one cloud of points closest to another, in closed form."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Alignment(NamedTuple):
    """How to move the second cloud of each pair onto the first, and what is left.

    A point (x, z) of the second goes to (x cos + z sin + x0, -x sin + z cos + z0), its yaw becomes yaw + theta.
    """

    theta: NDArray[np.float64]  # (...) radians
    x0: NDArray[np.float64]  # (...) metres
    z0: NDArray[np.float64]  # (...) metres
    square: NDArray[np.float64]  # (...) weighted squared distance that is left, m^2


def align(first: ArrayLike, second: ArrayLike, weights: ArrayLike) -> Alignment:
    """The best alignment of ``second`` onto ``first``, for many pairs of clouds at once.

    Clouds are centred before they are multiplied, so that places far from the origin cost no accuracy. Where the
    yaw makes no difference (every point on one upright line) it is 0. Source: papers.md 1, fixed weights.

    Args:
        first: points of the first clouds, metres.  # (..., P, 3)
        second: points of the second clouds.  # (..., P, 3)
        weights: of the points, not negative, sum above zero.  # (P,)
    """
    p, q, w = (np.asarray(values, dtype=np.float64) for values in (first, second, weights))
    ground = np.array([1.0, 0.0, 1.0])
    p_mean = np.einsum("p,...pc->...c", w, p) / w.sum() * ground
    q_mean = np.einsum("p,...pc->...c", w, q) / w.sum() * ground
    p, q = p - p_mean[..., None, :], q - q_mean[..., None, :]
    cross = np.einsum("p,...pc,...pd->...cd", w, p, q)
    sine, cosine = cross[..., 0, 2] - cross[..., 2, 0], cross[..., 0, 0] + cross[..., 2, 2]
    theta = np.arctan2(sine, cosine)
    own = np.einsum("p,...pc->...", w, p * p) + np.einsum("p,...pc->...", w, q * q)
    square = own - 2.0 * cross[..., 1, 1] - 2.0 * np.hypot(sine, cosine)
    turned_x, turned_z = turn(q_mean[..., 0], q_mean[..., 2], theta)
    return Alignment(theta, p_mean[..., 0] - turned_x, p_mean[..., 2] - turned_z, np.maximum(square, 0.0))


def turn(x: ArrayLike, z: ArrayLike, yaw: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The ground vector (x, z) turned by ``yaw`` radians; positive turns left."""
    x, z = np.asarray(x, dtype=np.float64), np.asarray(z, dtype=np.float64)
    sine, cosine = np.sin(yaw), np.cos(yaw)
    return x * cosine + z * sine, z * cosine - x * sine
