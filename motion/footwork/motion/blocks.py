"""A symmetric matrix over all pairs of frames, filled block by block on all threads, one half computed and mirrored."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from footwork.motion.threads import THREADS
from footwork.motion.window import RADIUS

# Frames a block is long and wide: its products stay in the cache, and are small enough that the linear algebra
# library computes each on the thread that asks for it, so that our threads never wait for the library's.
BLOCK = 64

Stretch = TypeVar("Stretch")


def filled_in_blocks(
    lengths: Sequence[int],
    windows: NDArray,
    stretch: Callable[[slice, NDArray[np.intp]], Stretch],
    fill: Callable[[Stretch, Stretch, NDArray, NDArray], None],
) -> NDArray[np.float64]:
    """A matrix whose blocks ``fill`` computes from what ``stretch`` knows of two stretches of frames.  # (N, N)

    Args:
        lengths: frames of each clip; they sum to N.
        windows: the frames of each frame's window.  # (N, LENGTH)
        stretch: given at most BLOCK frames of one clip and the numbers of these with RADIUS frames of context
            before and after them (M,), what the blocks of these frames need.
        fill: given two stretches of A and B frames, fills their block (A, B) and its mirror image (B, A), which
            are the same array where the stretches are.
    """
    cuts = _cuts(lengths)
    parts = [stretch(frames, _padded(windows[frames])) for frames in cuts]
    matrix = np.empty((len(windows), len(windows)))

    def fill_rows(number: int) -> None:
        rows = cuts[number]
        for columns, part in zip(cuts[number:], parts[number:], strict=True):
            fill(parts[number], part, matrix[rows, columns], matrix[columns, rows])

    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(fill_rows, range(len(cuts))))
    return matrix


def _cuts(lengths: Sequence[int]) -> list[slice]:
    """Stretches: each clip cut evenly into as few as there can be."""
    cuts: list[slice] = []
    start = 0
    for length in lengths:
        edges = np.linspace(start, start + length, -(-length // BLOCK) + 1).round().astype(int).tolist()
        cuts += [slice(*ends) for ends in pairwise(edges)]
        start += length
    return cuts


def _padded(windows: NDArray) -> NDArray[np.intp]:
    """The frames of a stretch with the context before and after it, from the windows of its frames."""
    return np.concatenate([windows[0, :RADIUS], windows[:, RADIUS], windows[-1, RADIUS + 1 :]])
