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
    yaw makes no difference (every point on one upright line) it is 0. Source: conventions.md 1.

    Args:
        first: points of the first clouds, metres.  # (..., P, 3)
        second: points of the second clouds.  # (..., P, 3)
        weights: of the points, not negative, sums above zero: fixed (P,), or those of each pair.  # (..., P)
    """
    w = np.asarray(weights, dtype=np.float64)
    (px, py, pz), p_mean = _centred(first, w)
    (qx, qy, qz), q_mean = _centred(second, w)
    wx, wy, wz = px * w, py * w, pz * w
    sine, cosine = _dot(wx, qz) - _dot(wz, qx), _dot(wx, qx) + _dot(wz, qz)
    theta = np.arctan2(sine, cosine)
    own = _dot(wx, px) + _dot(wy, py) + _dot(wz, pz) + _dot(qx * qx + qy * qy + qz * qz, w)
    square = own - 2.0 * _dot(wy, qy) - 2.0 * np.hypot(sine, cosine)
    turned_x, turned_z = turn(*q_mean, theta)
    return Alignment(theta, p_mean[0] - turned_x, p_mean[1] - turned_z, np.maximum(square, 0.0))


def _centred(points: ArrayLike, weights: NDArray) -> tuple[NDArray, tuple[NDArray, NDArray]]:
    """x, y, z (3, ..., P) with x and z about their weighted means, and those means (...)."""
    x, y, z = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
    total = weights.sum(axis=-1)
    mean_x, mean_z = _dot(x, weights) / total, _dot(z, weights) / total
    return np.stack([x - mean_x[..., None], y, z - mean_z[..., None]]), (mean_x, mean_z)


def _dot(a: NDArray, b: NDArray) -> NDArray[np.float64]:
    return np.einsum("...p,...p->...", a, b)


def turn(x: ArrayLike, z: ArrayLike, yaw: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The ground vector (x, z) turned by ``yaw`` radians; positive turns left."""
    x, z = np.asarray(x, dtype=np.float64), np.asarray(z, dtype=np.float64)
    sine, cosine = np.sin(yaw), np.cos(yaw)
    return x * cosine + z * sine, z * cosine - x * sine
