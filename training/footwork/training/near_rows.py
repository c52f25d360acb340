"""The rows that may be less unlike some rows than a threshold, from a tree of balls."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.ball_tree import BallTree
from footwork.training.sketches import SIZE, SLACK, WIDTH, find_near

BLOCK = 64  # rows
_TOGETHER = 4  # rows that look for others at once
_ROWS = 64  # as many as a mask has bits


class Forest(NamedTuple):
    """The arrays of a BallTree for compiled code, T panels.

    ``wanted`` are halves of the energies, made smaller for lower bounds, less what members have to be under to be
    looked at: the threshold for rows, and for balls the square of its root and the radius together. It is infinite
    where there is no member.
    """

    panels: NDArray[np.float32]  # (T, SIZE * WIDTH)
    wanted: NDArray[np.float32]  # (T, WIDTH)
    highest: NDArray[np.int32]  # (T, WIDTH)
    level: NDArray[np.intp]


def forest_of(tree: BallTree, threshold: float) -> Forest:
    """A tree made ready for a threshold."""
    # a little more than in double precision, so that rounding to single precision leaves nobody out
    reach = (np.sqrt(threshold) + tree.radius.astype(np.float64)) ** 2 * (1.0 + 1e-6)
    limit = np.where(tree.radius < 0.0, -np.inf, np.minimum(reach, np.finfo(np.float32).max))
    wanted = 0.5 * (tree.energy * np.float32(1.0 - SLACK) - limit)
    return Forest(tree.panels.reshape(len(tree.panels), -1), wanted.astype(np.float32), tree.highest, tree.level)


@numba.njit(cache=True, nogil=True)
def near_masks(
    begin: int,
    asking: int,
    sketch: NDArray,
    energy: NDArray,
    forest: Forest,
    front: NDArray,
    masks: NDArray,
    touched: NDArray,
) -> None:
    """Find what may be under the threshold against some rows in a row, a panel for all of them at a time.

    Args:
        begin: the row of bit 0 in masks.
        asking: bits of the rows that look for others.
        sketch: of all rows.  # (R, SIZE)
        energy: of all rows.  # (R,)
        forest: where to look.
        front: scratch.  # (2, 2, T)
        masks: by row, gets the bits of the rows that it is near to; only rows above ``begin`` do.  # (R,)
        touched: set for each block of BLOCK rows that got some.  # (R // BLOCK + 1,)
    """
    # to compiled code, each look into a tuple of arrays counts references: it is done once
    panels, wanted, highest, starts = forest
    query, own = np.zeros(_ROWS * SIZE, np.float32), np.zeros(_ROWS, np.float32)
    for row in range(begin, min(begin + _ROWS, len(energy))):
        query[(row - begin) * SIZE : (row - begin + 1) * SIZE] = sketch[row]
        own[row - begin] = np.float32(0.5) * (energy[row] * np.float32(1.0 - SLACK))
    near, child = np.empty(_TOGETHER * WIDTH, np.float32), np.empty(WIDTH, np.int64)
    here, there = front[0], front[1]
    level = len(starts) - 2
    size = starts[level + 1] - starts[level]
    for n in range(size):
        here[0, n], here[1, n] = starts[level] + n, asking
    while level >= 0:
        begun, below, count = starts[level], starts[max(level - 1, 0)], 0
        for n in range(size):
            panel = here[0, n]
            _near_members(query, own, here[1, n], panels[panel], wanted[panel], near, child)
            for v in range(WIDTH):
                row = highest[panel, v]
                if child[v] == 0 or row <= begin:
                    continue
                if level:
                    there[0, count], there[1, count] = below + (panel - begun) * WIDTH + v, child[v]
                    count += 1
                else:
                    masks[row] |= child[v]
                    touched[row // BLOCK] = True
        here, there, size, level = there, here, count, level - 1


@numba.njit(cache=True, nogil=True)
def _near_members(
    query: NDArray, own: NDArray, asking: int, panel: NDArray, wanted: NDArray, near: NDArray, child: NDArray
) -> None:
    """For each member of a panel the bits of the rows that it may be near to."""
    child[:] = 0
    for first in range(0, _ROWS, _TOGETHER):
        bits = (asking >> first) & ((1 << _TOGETHER) - 1)
        if bits:
            past = first + _TOGETHER
            find_near(query[first * SIZE : past * SIZE], own[first:past], panel, wanted, near)
            for v in range(WIDTH):
                found = 0
                for n in range(_TOGETHER):
                    found |= (near[n * WIDTH + v] > np.float32(0)) << n
                child[v] |= (found & bits) << first
        if asking >> first < (1 << _TOGETHER):
            return
