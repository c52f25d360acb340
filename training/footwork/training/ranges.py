"""Stretches of consecutive numbers laid end to end."""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def ranges(starts: ArrayLike, counts: ArrayLike) -> NDArray[np.intp]:
    """starts[0], starts[0] + 1, ... counts[0] of them, then those from starts[1], and so on.  # (sum(counts),)"""
    starts, counts = np.asarray(starts, dtype=np.intp), np.asarray(counts, dtype=np.intp)
    ahead = np.cumsum(counts) - counts
    return np.arange(counts.sum()) + np.repeat(starts - ahead, counts)
