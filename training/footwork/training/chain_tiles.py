"""s of all pairs of some rows in a row with some rows of one other chain, a tile of pairs at a time.

A frame's products with the frames of the other rows are computed side by side, as many as a processor takes at once,
and serve all pairs whose windows hold it. What a tile needs fits in the cache.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.window import LENGTH
from footwork.training.pair_windows import PRODUCTS, Standing, pair_cost, pair_products

STRETCH = 60  # rows of a chain that are dealt with together: with one before and one after, bits of an integer
COLUMNS = 48  # rows of the other chain in a tile, at most
_ROWS = STRETCH + 2
_FRAMES = _ROWS + LENGTH - 1
# Frames of the other chain side by side: COLUMNS, those around them, and up to a multiple of _AT_ONCE.
_WIDTH = 64
_AT_ONCE = 8  # frames that are computed together, and points that are added up before sums are put away
_LINE = 3 * _WIDTH
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


class Tile(NamedTuple):
    """Room for the pairs of a tile.

    ``cost`` has s of the tile's n-th row and column m at [n + 1, m + 1], and infinity around these.
    """

    cost: NDArray[np.float64]  # (_ROWS + 2, _WIDTH + 2)
    own: NDArray[np.float64]  # (_FRAMES, 3P) x, y, z of each point of the rows' frames
    others: NDArray[np.float64]  # (3P * _WIDTH,) those of the columns' frames, these side by side
    moments: NDArray[np.float64]  # (3 * _WIDTH,) means and energies of the columns' windows, likewise
    products: NDArray[np.float64]  # (_FRAMES * _LINE,) of frames, or of pairs of frames (_FRAMES * _WIDTH * PRODUCTS,)


@numba.njit(cache=True, nogil=True)
def new_tile(compared: Compared) -> Tile:
    """Room for a tile of any size."""
    points = compared.frames.shape[2]
    kinds = PRODUCTS if compared.standing.times.size else 3
    return Tile(
        np.full((_ROWS + 2, _WIDTH + 2), np.inf),
        np.zeros((_FRAMES, 3 * points)),
        np.zeros(3 * points * _WIDTH),
        np.zeros(3 * _WIDTH),
        np.zeros((_FRAMES + 1) * kinds * _WIDTH),
    )


@numba.njit(cache=True, nogil=True)
def set_rows(tile: Tile, compared: Compared, begin: int, count: int) -> None:
    """Make ready for tiles of the rows begin..begin + count - 1 of a chain."""
    frames, first = compared.frames, compared.start[begin]
    for a in range(count + LENGTH - 1):
        own = tile.own[a]
        for p in range(frames.shape[2]):
            for c in range(3):
                own[3 * p + c] = frames[first + a, c, p]


@numba.njit(cache=True, nogil=True)
def fill_tile(tile: Tile, compared: Compared, base: int, row: int, rows: int, column: int, columns: int) -> None:
    """Compute s of some rows with some others of one chain.

    Args:
        tile: made ready for the rows from ``base`` on; gets the result.
        compared: the rows.
        base: the first row that the tile was made ready for.
        row: first of the rows.
        rows: how many.
        column: first of the others.
        columns: how many, at most COLUMNS.
    """
    if compared.standing.times.size:
        _fill_by_pairs(tile, compared, row, rows, column, columns)
    else:
        _set_columns(tile, compared, column, columns)
        lanes = _whole(columns + LENGTH - 1)
        for a in range(rows + LENGTH - 1):
            _multiply(tile.own[row - base + a], tile.others, tile.products[a * _LINE : (a + 1) * _LINE], lanes)
        for n in range(rows):
            products = tile.products[n * _LINE : (n + LENGTH) * _LINE]
            mean, energy = compared.mean[row + n], compared.energy[row + n]
            into = tile.cost[n + 1, 1:]
            _add_up(products, compared.weights, mean, energy[0] + energy[1], tile.moments, into, _whole(columns))
    tile.cost[rows + 1] = np.inf
    tile.cost[: rows + 1, columns + 1] = np.inf


@numba.njit(cache=True, nogil=True)
def _whole(count: int) -> int:
    return (count + _AT_ONCE - 1) // _AT_ONCE * _AT_ONCE


@numba.njit(cache=True, nogil=True)
def _set_columns(tile: Tile, compared: Compared, column: int, columns: int) -> None:
    frames, first = compared.frames, compared.start[column]
    for p in range(frames.shape[2]):
        for c in range(3):
            line = tile.others[(3 * p + c) * _WIDTH : (3 * p + c + 1) * _WIDTH]
            for v in range(columns + LENGTH - 1):
                line[v] = frames[first + v, c, p]
    for v in range(columns):
        tile.moments[v], tile.moments[_WIDTH + v] = compared.mean[column + v]
        tile.moments[2 * _WIDTH + v] = compared.energy[column + v, 0] + compared.energy[column + v, 1]


@numba.njit(cache=True, nogil=True)
def _multiply(own: NDArray, others: NDArray, line: NDArray, lanes: int) -> None:
    """Sums over points of x x' + z z', x z' - z x' and y y' of a frame with others, each _WIDTH long in ``line``."""
    line[:] = 0.0
    for p in range(0, len(own) // 3, _AT_ONCE):
        _multiply_points(own[3 * p :], others[3 * p * _WIDTH :], line, lanes)


# Products and sums may be one instruction. Offsets are constants, so that the compiler sees what may be side by side.
@numba.njit(cache=True, nogil=True, fastmath={"contract"})
def _multiply_points(own: NDArray, others: NDArray, line: NDArray, lanes: int) -> None:
    for v in range(lanes):
        cosine, sine, height = line[v], line[_WIDTH + v], line[2 * _WIDTH + v]
        for p in range(_AT_ONCE):
            x, y, z = own[3 * p], own[3 * p + 1], own[3 * p + 2]
            at = 3 * p * _WIDTH + v
            other_x, other_y, other_z = others[at], others[at + _WIDTH], others[at + 2 * _WIDTH]
            cosine += x * other_x + z * other_z
            sine += x * other_z - z * other_x
            height += y * other_y
        line[v], line[_WIDTH + v], line[2 * _WIDTH + v] = cosine, sine, height


@numba.njit(cache=True, nogil=True, fastmath={"contract"})
def _add_up(
    products: NDArray, weights: NDArray, mean: NDArray, energy: float, moments: NDArray, cost: NDArray, lanes: int
) -> None:
    """s of a row with others, in closed form from the products of their windows' frames (conventions.md 1)."""
    own_x, own_z = mean
    for v in range(lanes):
        cosine, sine, height = 0.0, 0.0, 0.0
        for k in range(LENGTH):
            at = k * (_LINE + 1) + v
            cosine += weights[k] * products[at]
            sine += weights[k] * products[at + _WIDTH]
            height += weights[k] * products[at + 2 * _WIDTH]
        x, z = moments[v], moments[_WIDTH + v]
        cosine -= own_x * x + own_z * z
        sine -= own_x * z - own_z * x
        least = energy + moments[2 * _WIDTH + v] - 2.0 * (height + np.sqrt(cosine * cosine + sine * sine))
        cost[v] = least if least > _NOTHING else 0.0


@numba.njit(cache=True, nogil=True)
def _fill_by_pairs(tile: Tile, compared: Compared, row: int, rows: int, column: int, columns: int) -> None:
    """The same under weights of each pair."""
    first, other = compared.start[row], compared.start[column]
    products = tile.products.reshape(-1, _WIDTH, PRODUCTS)
    for a in range(rows + LENGTH - 1):
        for b in range(columns + LENGTH - 1):
            pair_products(compared.frames, compared.standing, first + a, other + b, products[a, b])
    window = np.empty((LENGTH, PRODUCTS))
    for n in range(rows):
        for m in range(columns):
            for k in range(LENGTH):
                window[k] = products[n + k, m + k]
            cost = pair_cost(window, compared.weights)
            tile.cost[n + 1, m + 1] = cost if cost > _NOTHING else 0.0
