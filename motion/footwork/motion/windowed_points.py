"""The points of clips laid end to end, with the window of frames that stands for each frame."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.alignment import Alignment
from footwork.motion.arrays import frozen, require_finite, require_shape
from footwork.motion.window import window_frames

_PAIRS_AT_ONCE = 512


class WindowedPoints:
    """Points of every frame of some clips; a window past a clip's end repeats the end frame.

    Args:
        places: world places of the points of each clip's frames, metres.  # (F, P, 3) each

    Raises:
        InputError: for no clips, a clip with no frames, clips of different points or places that are not finite.
    """

    def __init__(self, places: Sequence[NDArray]) -> None:
        if not places:
            raise InputError("no clips, expected at least one", "metric")
        points = places[0].shape[1]
        for number, clip in enumerate(places):
            require_shape(clip, (None, points, 3), f"places of clip {number}", "metric")
            require_finite(clip, f"places of clip {number}", "metric")
            if not len(clip):
                raise InputError(f"clip {number} is empty, expected at least one frame", "metric")
        self.lengths = tuple(len(clip) for clip in places)
        self.places = frozen(np.concatenate(places), np.float64)  # (N, P, 3)
        self.windows = frozen(window_frames(self.lengths), np.intp)  # (N, LENGTH)

    @property
    def frame_count(self) -> int:
        """The number of frames N."""
        return len(self.places)

    @property
    def point_count(self) -> int:
        """The number of points of a frame P."""
        return self.places.shape[1]

    def window(self, frames: NDArray[np.intp]) -> NDArray[np.float64]:
        """Places of the points of some frames' windows.  # (M,) -> (M, LENGTH, P, 3)"""
        return self.places[self.windows[frames]]

    def centred(self) -> NDArray[np.float64]:
        """Places about each clip's own centre on the ground and one height for all: no cost depends on either, and
        sums of their products stay accurate.  # (N, P, 3)
        """
        starts = np.concatenate([[0], np.cumsum(self.lengths)[:-1]])
        means = np.add.reduceat(self.places.mean(axis=1), starts) / np.array(self.lengths)[:, None]
        means[:, 1] = self.places[..., 1].mean()
        return self.places - np.repeat(means, self.lengths, axis=0)[:, None, :]


def pairs_in_portions(i: ArrayLike, j: ArrayLike) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """The pairs of two lists of frames, some at a time so that their windows fit into memory; at least one portion."""
    first, second = np.broadcast_arrays(*(np.atleast_1d(np.asarray(frames, dtype=np.intp)) for frames in (i, j)))
    for at in range(0, max(len(first), 1), _PAIRS_AT_ONCE):
        yield first[at : at + _PAIRS_AT_ONCE], second[at : at + _PAIRS_AT_ONCE]


def joined(parts: Sequence[Alignment]) -> Alignment:
    """Alignments of portions as one."""
    return Alignment(*(np.concatenate(column) for column in zip(*parts, strict=True)))
