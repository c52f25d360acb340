"""The rows that may be less unlike some rows than a threshold, from a tree of balls."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.ball_tree import BallTree
from footwork.training.sketches import SLACK, WIDTH, least_costs

BLOCK = 64  # rows


class Forest(NamedTuple):
    """The arrays of a BallTree for compiled code, and what its members have to be under to be looked at.

    ``shrunk`` are the energies, made smaller for lower bounds. ``limit`` is the threshold for rows, and for balls the
    square of its root and the radius together; nothing is under it where there is no member.  # (T, WIDTH)
    """

    panels: NDArray[np.float32]
    shrunk: NDArray[np.float32]
    limit: NDArray[np.float32]
    highest: NDArray[np.int32]
    level: NDArray[np.intp]


def forest_of(tree: BallTree, threshold: float) -> Forest:
    """A tree made ready for a threshold."""
    # a little more than in double precision, so that rounding to single precision leaves nobody out
    reach = (np.sqrt(threshold) + tree.radius.astype(np.float64)) ** 2 * (1.0 + 1e-6)
    limit = np.where(tree.radius < 0.0, -np.inf, np.minimum(reach, np.finfo(np.float32).max))
    shrunk = tree.energy * np.float32(1.0 - SLACK)
    return Forest(tree.panels, shrunk, limit.astype(np.float32), tree.highest, tree.level)


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
    bounds, child = np.empty(WIDTH, np.float32), np.empty(WIDTH, np.int64)
    here, there = front[0], front[1]
    level = len(forest.level) - 2
    size = forest.level[level + 1] - forest.level[level]
    for n in range(size):
        here[0, n], here[1, n] = forest.level[level] + n, asking
    while level >= 0:
        begun, below, count = forest.level[level], forest.level[max(level - 1, 0)], 0
        for n in range(size):
            panel = here[0, n]
            _near_members(begin, here[1, n], sketch, energy, forest, panel, bounds, child)
            for v in range(WIDTH):
                row = forest.highest[panel, v]
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
    begin: int,
    asking: int,
    sketch: NDArray,
    energy: NDArray,
    forest: Forest,
    panel: int,
    bounds: NDArray,
    child: NDArray,
) -> None:
    """For each member of a panel the bits of the rows that it may be near to."""
    child[:] = 0
    row = begin
    while asking:
        if asking & 1:
            own = energy[row] * np.float32(1.0 - SLACK)
            least_costs(sketch[row], forest.panels, forest.shrunk, panel, own, bounds)
            bit = 1 << (row - begin)
            for v in range(WIDTH):
                child[v] |= bit * (bounds[v] < forest.limit[panel, v])
        asking >>= 1
        row += 1
