"""The cost of two windows under weights of each pair, for windows laid out as in ``windows`` (conventions.md 1, 8)."""

import math
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.pair_weights import PairWeights

PRODUCTS = 8  # of two frames


class Standing(NamedTuple):
    """What stands at each frame, for compiled code.

    Args:
        kind: which feet stand at each frame, one bit a foot.  # (F,)
        times: how many times its mass part a point weighs, for each kind at the first and at the second frame of a
            pair; points are filled up with zeros.  # (2^feet, 2^feet, P)
        root_weights: square roots of the mass parts, filled up with zeros.  # (P,)
    """

    kind: NDArray[np.int8]
    times: NDArray[np.float64]
    root_weights: NDArray[np.float64]


def fixed_standing() -> Standing:
    """For weights that do not depend on what stands: empty."""
    return Standing(np.zeros(0, np.int8), np.zeros((0, 0, 0)), np.zeros(0))


def standing_of(contacts: NDArray[np.bool_], weights: PairWeights, root_weights: NDArray[np.float64]) -> Standing:
    """What stands at F frames (F, feet), for points whose places are scaled by ``root_weights`` (>= P,)."""
    feet = contacts.shape[1]
    kinds = (np.arange(1 << feet)[:, None] >> np.arange(feet)) & 1
    each = np.zeros((1 << feet, len(root_weights)))
    # a point without mass part can have no friction either: both are shares of one segment's weight
    np.divide(weights.frictions(kinds), weights.mass, out=each[:, : len(weights.mass)], where=weights.mass > 0.0)
    times = each[:, None] + each
    times[..., : len(weights.mass)] += weights.mass > 0.0
    return Standing((contacts @ (1 << np.arange(feet))).astype(np.int8), times, root_weights)


# Sums may be taken in any order, as in ``windows``.
@numba.njit(cache=True, nogil=True, fastmath={"reassoc"})
def pair_products(frames: NDArray, standing: Standing, a: int, b: int, products: NDArray) -> None:
    """Sums over the points of two frames under the weights of what stands at them.

    Args:
        frames: places scaled by root mass parts over UNIT, as in Windows.  # (F, 3, P)
        standing: what stands at each frame.
        a: a frame.
        b: another.
        products: the result: x x' + z z', x z' - z x', squares of both less 2 y y', x, z, x', z' and the weights.
            # (PRODUCTS,)
    """
    times, root = standing.times[standing.kind[a], standing.kind[b]], standing.root_weights
    cosine, sine, square, total = 0.0, 0.0, 0.0, 0.0
    x, z, other_x, other_z = 0.0, 0.0, 0.0, 0.0
    for p in range(times.shape[0]):
        first_x, first_z, second_x, second_z = frames[a, 0, p], frames[a, 2, p], frames[b, 0, p], frames[b, 2, p]
        rise, weight, pull = frames[a, 1, p] - frames[b, 1, p], times[p], times[p] * root[p]
        cosine += weight * (first_x * second_x + first_z * second_z)
        sine += weight * (first_x * second_z - first_z * second_x)
        square += weight * (first_x**2 + first_z**2 + second_x**2 + second_z**2 + rise * rise)
        x += pull * first_x
        z += pull * first_z
        other_x += pull * second_x
        other_z += pull * second_z
        total += pull * root[p]
    products[0], products[1], products[2] = cosine, sine, square
    products[3], products[4], products[5], products[6], products[7] = x, z, other_x, other_z, total


@numba.njit(cache=True, nogil=True)
def pair_cost(products: NDArray, weights: NDArray) -> float:
    """s in closed form from the products of two windows' frames, each frame with its own friction (conventions.md 1).

    Args:
        products: of the first frames of both windows, of the second and so on.  # (LENGTH, PRODUCTS)
        weights: of a window's frames.  # (LENGTH,)
    """
    cosine, sine, square, total = 0.0, 0.0, 0.0, 0.0
    x, z, other_x, other_z = 0.0, 0.0, 0.0, 0.0
    for k in range(weights.shape[0]):
        w = weights[k]
        cosine += w * products[k, 0]
        sine += w * products[k, 1]
        square += w * products[k, 2]
        x += w * products[k, 3]
        z += w * products[k, 4]
        other_x += w * products[k, 5]
        other_z += w * products[k, 6]
        total += w * products[k, 7]
    square -= (x * x + z * z + other_x * other_x + other_z * other_z) / total
    cosine -= (x * other_x + z * other_z) / total
    sine -= (x * other_z - z * other_x) / total
    return max(square - 2.0 * math.sqrt(cosine * cosine + sine * sine), 0.0)
