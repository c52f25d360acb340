"""The innermost loop of the metric under fixed weights (conventions.md 1)."""

import math

import numba
from numpy.typing import NDArray

from footwork.motion.diagonal_sums import add_diagonals


@numba.njit(cache=True, nogil=True)
def window_costs(
    gram: NDArray,
    weights: NDArray,
    i_mean: NDArray,
    j_mean: NDArray,
    i_energy: NDArray,
    j_energy: NDArray,
    scale: float,
    sums: NDArray,
    costs: NDArray,
    mirrored: NDArray,
) -> None:
    """Fill a block of the cost matrix and its mirror image: A frames in a row against B frames in a row.

    Args:
        gram: products of the A frames and K // 2 more on either side with the B frames and theirs, summed over
            points: x x' + z z', x z' - z x' and y y'.  # (3, A + K - 1, B + K - 1)
        weights: of the window's middle frame and of those next to it on both sides, outwards.  # (K // 2 + 1,)
        i_mean: weighted mean x and z of the A windows.  # (A, 2)
        j_mean: that of the B windows.  # (B, 2)
        i_energy: weighted mean square of the A windows less that of their mean.  # (A,)
        j_energy: that of the B windows.  # (B,)
        scale: what squared metres are multiplied by.
        sums: scratch.  # (3, >= B)
        costs: the result.  # (A, B)
        mirrored: the result, mirrored.  # (B, A)
    """
    rows, columns = costs.shape
    for i in range(rows):
        add_diagonals(gram, weights, i, sums)
        line, x, z, own = costs[i], i_mean[i, 0], i_mean[i, 1], i_energy[i]
        for j in range(columns):
            real = sums[0, j] - x * j_mean[j, 0] - z * j_mean[j, 1]
            imaginary = sums[1, j] - x * j_mean[j, 1] + z * j_mean[j, 0]
            left = own + j_energy[j] - 2.0 * sums[2, j] - 2.0 * math.sqrt(real * real + imaginary * imaginary)
            line[j] = scale * max(left, 0.0)
    for j in range(columns):
        for i in range(rows):
            mirrored[j, i] = costs[i, j]
