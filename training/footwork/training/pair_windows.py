"""The cost of two windows under weights of each pair, for windows laid out as in ``windows`` (conventions.md 1, 8)."""

import math
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.pair_weights import PairWeights


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
def full_pair_cost(frames: NDArray, start: NDArray, weights: NDArray, standing: Standing, i: int, j: int) -> float:
    """s of rows i and j: all of both windows taken in, each frame with its own friction.

    Args:
        frames: places scaled by root mass parts over UNIT, as in Windows.  # (F, 3, P)
        start: first frame of each row's window.  # (R,)
        weights: of a window's frames.  # (LENGTH,)
        standing: what stands at each frame.
        i: a row.
        j: another.
    """
    total, square, cosine, sine = 0.0, 0.0, 0.0, 0.0
    x, z, other_x, other_z = 0.0, 0.0, 0.0, 0.0
    root = standing.root_weights
    for k in range(weights.shape[0]):
        a, b = frames[start[i] + k], frames[start[j] + k]
        times = standing.times[standing.kind[start[i] + k], standing.kind[start[j] + k]]
        # sums of one frame, then weighted: t sum of weights, q squares, c and s products, the rest as above
        t, q, c, s, ax, az, bx, bz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for p in range(times.shape[0]):
            weight = times[p]
            pull = weight * root[p]
            t += pull * root[p]
            ax += pull * a[0, p]
            az += pull * a[2, p]
            bx += pull * b[0, p]
            bz += pull * b[2, p]
            rise = a[1, p] - b[1, p]
            q += weight * (a[0, p] * a[0, p] + a[2, p] * a[2, p] + b[0, p] * b[0, p] + b[2, p] * b[2, p] + rise * rise)
            c += weight * (a[0, p] * b[0, p] + a[2, p] * b[2, p])
            s += weight * (a[0, p] * b[2, p] - a[2, p] * b[0, p])
        total += weights[k] * t
        square += weights[k] * q
        cosine += weights[k] * c
        sine += weights[k] * s
        x += weights[k] * ax
        z += weights[k] * az
        other_x += weights[k] * bx
        other_z += weights[k] * bz
    square -= (x * x + z * z + other_x * other_x + other_z * other_z) / total
    cosine -= (x * other_x + z * other_z) / total
    sine -= (x * other_z - z * other_x) / total
    return max(square - 2.0 * math.sqrt(cosine * cosine + sine * sine), 0.0)
