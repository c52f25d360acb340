"""The frames around a frame that stand for its dynamics: a centred window with quadratic weights (conventions.md 1)."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

RADIUS = 5
LENGTH = 2 * RADIUS + 1


def window_weights() -> NDArray[np.float64]:
    """W_k = 1 - (k / (L + 1))^2 for k = -L..L, normalised to sum 1, L = 5.  # (LENGTH,)

    Source: conventions.md 1 (convention).
    """
    k = np.arange(-RADIUS, RADIUS + 1)
    weights = 1.0 - (k / (RADIUS + 1)) ** 2
    return weights / weights.sum()


def window_frames(lengths: Sequence[int]) -> NDArray[np.intp]:
    """The frames of each frame's window, over clips laid end to end.  # (N, LENGTH)

    A window never leaves its clip: places past an end hold the end frame, so that a clip of one frame is a still
    pose.

    Args:
        lengths: frames of each clip, each at least one; they sum to N.
    """
    around = np.arange(-RADIUS, RADIUS + 1)
    first = np.concatenate([[0], np.cumsum(lengths)[:-1]]).astype(np.intp)
    inside = [np.clip(np.arange(length)[:, None] + around, 0, length - 1) for length in lengths]
    return np.concatenate([frames + start for frames, start in zip(inside, first, strict=True)])
