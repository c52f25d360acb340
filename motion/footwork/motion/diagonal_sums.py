"""Windowed sums: along the diagonals of matrices of per-frame products (conventions.md 1)."""

import numba
from numpy.typing import NDArray


@numba.njit(cache=True, nogil=True)
def add_diagonals(gram: NDArray, weights: NDArray, i: int, sums: NDArray) -> None:
    """Weighted sums along the diagonals of each part of ``gram``, for one row of windows.

    Args:
        gram: products of the A frames and K // 2 more on either side with the B frames and theirs.
            # (parts, A + K - 1, B + K - 1)
        weights: of the window's middle frame and of those next to it on both sides, outwards.  # (K // 2 + 1,)
        i: which of the A frames.
        sums: the result.  # (parts, >= B)
    """
    radius = weights.shape[0] - 1
    columns = gram.shape[2] - 2 * radius
    for part in range(gram.shape[0]):
        total, middle = sums[part], gram[part, i + radius, radius:]
        for j in range(columns):
            total[j] = weights[0] * middle[j]
        for k in range(1, radius + 1):
            weight = weights[k]
            early, late = gram[part, i + radius - k, radius - k :], gram[part, i + radius + k, radius + k :]
            for j in range(columns):
                total[j] += weight * (early[j] + late[j])
