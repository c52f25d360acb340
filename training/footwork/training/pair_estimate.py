"""How many transitions a search will find, from looking at a few stretches of rows first."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from footwork.training.room import require_room

_STRETCHES = 64
_FEWEST = 128  # rows in a stretch
# of a pair of frames, with the two edges it becomes, while these are sorted
_BYTES_PER_PAIR = 150


def estimated_pairs(count: Callable[[int, int], int], starts: ArrayLike, rows: int) -> float:
    """About as many pairs as a search over all rows finds, from stretches of whole chains spread over all of them.

    Exact where there are so few rows that the stretches are all of them.

    Args:
        count: how many pairs the rows begin..end - 1 have with later rows.
        starts: first row of each chain, ascending from 0.  # (C,)
        rows: how many rows there are.
    """
    starts = np.asarray(starts)
    aims = np.linspace(0, rows, max(rows // _FEWEST, 1) + 1)[:-1]
    cuts = np.append(np.unique(starts[np.searchsorted(starts, aims, side="right") - 1]), rows)
    chosen = np.unique(np.linspace(0, len(cuts) - 2, _STRETCHES).round().astype(int))
    begin, end = cuts[chosen], cuts[chosen + 1]
    found = sum(count(int(first), int(past)) for first, past in zip(begin, end, strict=True))
    # rows later than each: a row is compared with those
    compared = ((end - begin) * (rows - (begin + end - 1) / 2.0)).sum()
    return found / compared * (rows * (rows + 1) / 2.0)


def require_room_for_pairs(estimate: float) -> None:
    """Raise InputError where memory has no room for so many pairs and the edges they become."""
    what = f"about {estimate:.2g} transitions"
    require_room(_BYTES_PER_PAIR * estimate, what, "use a lower threshold, fewer clips or fewer weights", "threshold")
