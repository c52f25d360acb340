"""The innermost loop of the metric: windowed sums along the diagonals of per-frame products (papers.md 1)."""

import math

import numba
from numpy.typing import NDArray


@numba.njit(cache=True, nogil=True)
def window_costs(
    gram: NDArray,
    weights: NDArray,
    row: int,
    rows: int,
    first: NDArray,
    count: NDArray,
    column: NDArray,
    mean: NDArray,
    energy: NDArray,
    scale: float,
    sums: NDArray,
    costs: NDArray,
) -> None:
    """Fill the blocks (rows of one chunk) x (each of some other chunks) of the cost matrix, and their mirror images.

    A chunk is a stretch of frames of one clip; its padded rows hold its frames and the context on either side, so
    that the window of the chunk's frame r covers its padded rows r..r + K - 1.

    Args:
        gram: products of the row chunk's padded frames with all padded frames of the other chunks, summed over
            points: x x' + z z', x z' - z x' and y y'.  # (3, >= rows + K - 1, padded columns)
        weights: the window's weights.  # (K,)
        row: the first frame of the row chunk.
        rows: its number of frames.
        first: the first frame of each column chunk.  # (C,)
        count: its number of frames.  # (C,)
        column: its first padded column in ``gram``.  # (C,)
        mean: weighted mean x and z of each frame's window.  # (N, 2)
        energy: weighted mean square of each frame's window, less that of its mean.  # (N,)
        scale: what squared metres are multiplied by.
        sums: scratch.  # (3, >= largest count)
        costs: the result.  # (N, N)
    """
    for chunk in range(first.shape[0]):
        start, frames, offset = first[chunk], count[chunk], column[chunk]
        for i in range(row, row + rows):
            sums[:, :frames] = 0.0
            for k in range(weights.shape[0]):
                weight = weights[k]
                for part in range(3):
                    products, total = gram[part, i - row + k, offset + k : offset + k + frames], sums[part]
                    for j in range(frames):
                        total[j] += weight * products[j]
            line, x, z, own = costs[i, start : start + frames], mean[i, 0], mean[i, 1], energy[i]
            for j in range(frames):
                real = sums[0, j] - x * mean[start + j, 0] - z * mean[start + j, 1]
                imaginary = sums[1, j] - x * mean[start + j, 1] + z * mean[start + j, 0]
                left = own + energy[start + j] - 2.0 * sums[2, j] - 2.0 * math.sqrt(real * real + imaginary * imaginary)
                line[j] = scale * max(left, 0.0)
        for j in range(start, start + frames):
            for i in range(row, row + rows):
                costs[j, i] = costs[i, j]
