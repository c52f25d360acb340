"""Rows in balls of sixteen, these in balls of sixteen balls and so on, so that whole balls can be passed over."""

import math
from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.sketches import GROUND, SIZE, WIDTH, Sketches, panels_of

NOBODY = -1
_ROUNDING = 1e-5  # added to radii, more than what single precision takes off distances of a few roots of s


@dataclass(frozen=True, eq=False)
class BallTree:
    """Panels of WIDTH members, level by level: those of level 0 are rows, those of level n + 1 balls.

    Member m of level n + 1 is the ball round the members of panel m of level n. Distances are those of
    sketches, the root of s at most.

    Args:
        panels: sketches of the members, of rows or of the middles of balls.  # (T, SIZE, WIDTH)
        energy: sums of squares: of whole windows for rows, of sketches for middles.  # (T, WIDTH)
        radius: of the balls, 0 for rows, less than 0 where there is no member.  # (T, WIDTH)
        highest: the highest row in each ball, a row itself at level 0, NOBODY where there is no member.  # (T, WIDTH)
        level: first panel of each level, and T.  # (levels + 1,)
    """

    panels: NDArray[np.float32]
    energy: NDArray[np.float32]
    radius: NDArray[np.float32]
    highest: NDArray[np.int32]
    level: NDArray[np.intp]


def tree_of(sketches: Sketches, rows: NDArray[np.intp]) -> BallTree:
    """The tree over some rows, at least one."""
    slots = _padded(_ordered(sketches.values, rows), NOBODY)
    levels = [(panels_of(sketches.values, slots), np.where(slots >= 0, 0.0, -1.0), slots)]
    while len(levels[-1][0]) > WIDTH:
        levels.append(_balls(sketches.values, slots, WIDTH ** len(levels), levels[-1]))
    panels, radius, highest = (np.concatenate(parts) for parts in zip(*levels, strict=True))
    energy = np.sum(panels.astype(np.float64) ** 2, axis=1)
    leaves = len(slots) // WIDTH
    energy[:leaves] = sketches.energy[slots].reshape(-1, WIDTH)
    return BallTree(
        panels=panels,
        energy=energy.astype(np.float32),
        radius=radius.reshape(-1, WIDTH).astype(np.float32),
        highest=highest.reshape(-1, WIDTH).astype(np.int32),
        level=np.cumsum([0, *(len(level[0]) for level in levels)]),
    )


def _balls(
    values: NDArray, slots: NDArray, size: int, below: tuple[NDArray, NDArray, NDArray]
) -> tuple[NDArray, NDArray, NDArray]:
    """Panels, radii and highest rows of the level above; a ball holds ``size`` slots."""
    panels, radius, highest = below
    there = (radius >= 0.0).reshape(-1, 1, WIDTH)
    middles = (panels * there).sum(axis=2, dtype=np.float64) / np.maximum(there.sum(axis=2), 1)
    middles = middles.astype(np.float32)
    radii = np.empty(len(middles))
    _fill_radii(values, slots, size, middles, radii)
    members = _padded(np.arange(len(middles)), NOBODY)
    return (
        panels_of(middles, members),
        _padded(radii + _ROUNDING, -1.0),
        _padded(highest.reshape(-1, WIDTH).max(axis=1), NOBODY),
    )


def _padded(values: NDArray, filling: float) -> NDArray:
    """Filled up to a multiple of WIDTH."""
    return np.pad(values, (0, -len(values) % WIDTH), constant_values=filling)


@numba.njit(cache=True, nogil=True)
def _ordered(values: NDArray, rows: NDArray) -> NDArray:
    """Rows in an order in which WIDTH^n in a row are alike: halved again and again where they differ most."""
    order = rows.copy()
    begins, ends = [0], [len(rows)]
    while len(begins):
        begin, end = begins.pop(), ends.pop()
        if end - begin <= WIDTH:
            continue
        half = WIDTH
        while 2 * half < end - begin:
            half *= 2
        part = order[begin:end]
        _halve(part, values[:, _widest(values, part)][part], half)
        begins.append(begin)
        ends.append(begin + half)
        begins.append(begin + half)
        ends.append(end)
    return order


@numba.njit(cache=True, nogil=True)
def _widest(values: NDArray, rows: NDArray) -> int:
    """The column in which rows differ most."""
    total, square = np.zeros(values.shape[1]), np.zeros(values.shape[1])
    for row in rows:
        for column in range(values.shape[1]):
            value = values[row, column]
            total[column] += value
            square[column] += value * value
    return int(np.argmax(square - total * total / len(rows)))


@numba.njit(cache=True, nogil=True)
def _halve(rows: NDArray, values: NDArray, half: int) -> None:
    """Reorder rows so that the ``half`` of the least values come first (Hoare's selection).

    Written out because numpy's takes a quarter of all the time that compiling a search takes.
    """
    low, high = 0, len(rows) - 1
    while low < high:
        pivot, up, down = values[(low + high) // 2], low, high
        while up <= down:
            while values[up] < pivot:
                up += 1
            while values[down] > pivot:
                down -= 1
            if up <= down:
                values[up], values[down] = values[down], values[up]
                rows[up], rows[down] = rows[down], rows[up]
                up, down = up + 1, down - 1
        if half <= down:
            high = down
        elif half >= up:
            low = up
        else:
            return


@numba.njit(cache=True, nogil=True)
def _fill_radii(values: NDArray, slots: NDArray, size: int, middles: NDArray, radii: NDArray) -> None:
    """The furthest row of each ball from its middle, over the best turn of each."""
    for ball in range(len(middles)):
        furthest = 0.0
        for row in slots[ball * size : (ball + 1) * size]:
            if row >= 0:
                furthest = max(furthest, _square_distance(values[row], middles[ball]))
        radii[ball] = math.sqrt(furthest)


@numba.njit(cache=True, nogil=True)
def _square_distance(a: NDArray, b: NDArray) -> float:
    real, imaginary, rest = 0.0, 0.0, 0.0
    for c in range(GROUND):
        x, z, x2, z2 = float(a[c]), float(a[c + GROUND]), float(b[c]), float(b[c + GROUND])
        real += x * x2 + z * z2
        imaginary += x * z2 - z * x2
        rest += x * x + z * z + x2 * x2 + z2 * z2
    for c in range(2 * GROUND, SIZE):
        difference = float(a[c]) - float(b[c])
        rest += difference * difference
    return max(rest - 2.0 * math.sqrt(real * real + imaginary * imaginary), 0.0)
