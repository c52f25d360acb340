"""The innermost loop of the metric under weights of each pair of frames (conventions.md 1)."""

import math

import numba
from numpy.typing import NDArray

from footwork.motion.diagonal_sums import add_diagonals

PARTS = 7


@numba.njit(cache=True, nogil=True)
def pair_window_costs(
    gram: NDArray,
    weights: NDArray,
    i_own: NDArray,
    j_own: NDArray,
    scale: float,
    sums: NDArray,
    costs: NDArray,
    mirrored: NDArray,
) -> None:
    """Fill a block of the cost matrix and its mirror image: A frames in a row against B frames in a row.

    Args:
        gram: products of the A frames and K // 2 more on either side with the B frames and theirs, summed over
            points: under the pair's weights x x' + z z', x z' - z x' and -2 y y'; to this last added the squares
            of each one's places under the other's friction; x and z of the one's places under the other's
            friction, and then of the other's under the one's.  # (PARTS, A + K - 1, B + K - 1)
        weights: of the window's middle frame and of those next to it on both sides, outwards.  # (K // 2 + 1,)
        i_own: of the A windows, under their own weights: sums of x, z and squares, and the weights' share in the
            sum of a pair's weights.  # (A, 4)
        j_own: those of the B windows.  # (B, 4)
        scale: what squared metres are multiplied by.
        sums: scratch.  # (PARTS, >= B)
        costs: the result.  # (A, B)
        mirrored: the result, mirrored.  # (B, A)
    """
    rows, columns = costs.shape
    for i in range(rows):
        add_diagonals(gram, weights, i, sums)
        line, own_x, own_z, own_square, own_weight = costs[i], i_own[i, 0], i_own[i, 1], i_own[i, 2], i_own[i, 3]
        for j in range(columns):
            x, z = own_x + sums[3, j], own_z + sums[4, j]
            other_x, other_z = j_own[j, 0] + sums[5, j], j_own[j, 1] + sums[6, j]
            share = 1.0 / (own_weight + j_own[j, 3])
            real = sums[0, j] - (x * other_x + z * other_z) * share
            imaginary = sums[1, j] - (x * other_z - z * other_x) * share
            square = own_square + j_own[j, 2] + sums[2, j]
            square -= (x * x + z * z + other_x * other_x + other_z * other_z) * share
            left = square - 2.0 * math.sqrt(real * real + imaginary * imaginary)
            line[j] = scale * max(left, 0.0)
    for j in range(columns):
        for i in range(rows):
            mirrored[j, i] = costs[i, j]
