"""s of the pairs along some diagonals of some rows in a row with some rows of one other chain, a band at a time.

Motions that are alike stay so for a while, so that near pairs lie along diagonals: a band holds little else. The
products of two frames serve all pairs whose windows hold both. What a band needs fits in the cache.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.window import LENGTH
from footwork.training.pair_windows import PRODUCTS, Standing, pair_cost, pair_products
from footwork.training.windows import frame_products

STRETCH = 60  # rows of a chain that are dealt with together: with one before and one after, bits of an integer
COLUMNS = 48  # rows of the other chain in a band, at most
ROWS = STRETCH + 2
DIAGONALS = ROWS + COLUMNS - 1
# Equal windows differ by this much of rounding at most. As nothing between them counts as lower than another, a
# motion that comes twice has the transitions that exact numbers would give it.
_NOTHING = 1e-10


class Compared(NamedTuple):
    """What s of rows is computed from: see Windows."""

    frames: NDArray[np.float64]
    start: NDArray[np.intp]
    mean: NDArray[np.float64]
    energy: NDArray[np.float64]
    weights: NDArray[np.float64]
    standing: Standing


class Band(NamedTuple):
    """Pairs of the rows ``base`` + n with the rows ``column`` + m, n - m from ``diagonal`` on.

    Args:
        base: a row.
        rows: how many of its chain from there on.
        diagonal: the first n - m.
        diagonals: how many.
        column: first of the other chain's rows.
        columns: how many, at most COLUMNS.
    """

    base: int
    rows: int
    diagonal: int
    diagonals: int
    column: int
    columns: int


class Room(NamedTuple):
    """Room for the pairs of a band.

    ``cost`` has s of the row base + diagonal + v + m and the row column + m at [m + 1, v + 2], infinity where there is
    no such row and around the band.
    """

    cost: NDArray[np.float64]  # (COLUMNS + 2, DIAGONALS + 4)
    products: NDArray[np.float64]  # (COLUMNS + LENGTH - 1, DIAGONALS, 3 or PRODUCTS) of two frames


@numba.njit(cache=True, nogil=True)
def new_room(compared: Compared) -> Room:
    """Room for a band of any size."""
    kinds = PRODUCTS if compared.standing.times.size else 3
    cost = np.full((COLUMNS + 2, DIAGONALS + 4), np.inf)
    return Room(cost, np.zeros((COLUMNS + LENGTH - 1, DIAGONALS, kinds)))


@numba.njit(cache=True, nogil=True)
def fill_band(
    cost: NDArray,
    products: NDArray,
    frames: NDArray,
    start: NDArray,
    mean: NDArray,
    energy: NDArray,
    weights: NDArray,
    band: Band,
) -> None:
    """Compute s of all pairs of a band, in closed form from the products of their windows' frames (conventions.md 1).

    Args:
        cost: of Room, the result.
        products: of Room.
        frames: of Compared, and so are start, mean, energy and weights.
        band: which pairs.
    """
    clear(cost, band)
    first, other = start[band.base] + band.diagonal, start[band.column]
    for b in range(band.columns + LENGTH - 1):
        begin, end = meeting(band, b, band.rows + LENGTH - 1)
        for v in range(begin, end):
            products[b, v, 0], products[b, v, 1], products[b, v, 2] = frame_products(frames, first + v + b, other + b)
    for m in range(band.columns):
        begin, end = meeting(band, m, band.rows)
        for v in range(begin, end):
            row, column = band.base + band.diagonal + v + m, band.column + m
            cosine, sine, height = 0.0, 0.0, 0.0
            for k in range(LENGTH):
                cosine += weights[k] * products[m + k, v, 0]
                sine += weights[k] * products[m + k, v, 1]
                height += weights[k] * products[m + k, v, 2]
            cosine -= mean[row, 0] * mean[column, 0] + mean[row, 1] * mean[column, 1]
            sine -= mean[row, 0] * mean[column, 1] - mean[row, 1] * mean[column, 0]
            squares = energy[row, 0] + energy[row, 1] + energy[column, 0] + energy[column, 1]
            least = squares - 2.0 * (height + np.sqrt(cosine * cosine + sine * sine))
            cost[m + 1, v + 2] = least if least > _NOTHING else 0.0


@numba.njit(cache=True, nogil=True)
def fill_band_by_pairs(
    cost: NDArray,
    products: NDArray,
    frames: NDArray,
    start: NDArray,
    standing: Standing,
    weights: NDArray,
    band: Band,
) -> None:
    """The same under weights of each pair."""
    clear(cost, band)
    first, other = start[band.base] + band.diagonal, start[band.column]
    for b in range(band.columns + LENGTH - 1):
        begin, end = meeting(band, b, band.rows + LENGTH - 1)
        for v in range(begin, end):
            pair_products(frames, standing, first + v + b, other + b, products[b, v])
    for m in range(band.columns):
        begin, end = meeting(band, m, band.rows)
        for v in range(begin, end):
            least = pair_cost(products[m : m + LENGTH, v], weights)
            cost[m + 1, v + 2] = least if least > _NOTHING else 0.0


@numba.njit(cache=True, nogil=True)
def clear(cost: NDArray, band: Band) -> None:
    """Put infinity wherever a band is, and around it."""
    for m in range(band.columns + 2):
        for v in range(band.diagonals + 4):
            cost[m, v] = np.inf


@numba.njit(cache=True, nogil=True)
def meeting(band: Band, m: int, count: int) -> tuple[int, int]:
    """The first of the diagonals and the one past the last at which the m-th column meets 0..count - 1."""
    begin = min(max(-band.diagonal - m, 0), band.diagonals)
    return begin, max(min(count - band.diagonal - m, band.diagonals), begin)
