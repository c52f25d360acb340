"""The dynamics-based metric of Matsunaga and Zordan (2007): what is heavy, or stands, must not move far."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.alignment import Alignment, align
from footwork.motion.arrays import frozen, require_shape
from footwork.motion.metric import UNIT
from footwork.motion.pair_all_pairs import pair_all_pairs
from footwork.motion.pair_weights import PairWeights
from footwork.motion.window import LENGTH, window_weights
from footwork.motion.windowed_points import WindowedPoints, joined, pairs_in_portions


class DynamicsMetric:
    """s = sum w |d|^2 / UNIT^2 over the points of two windows, weights of each pair (conventions.md 1, 2 and 8).

    Each frame of a window brings its own friction. Where nothing stands, the mass part of the weights is left, which
    sums to 1 like the weights of the other metrics; s under that part alone is never more than s.

    Args:
        places: world places of the points of each clip's frames, metres.  # (F, P, 3) each
        contacts: which feet stand at them.  # (F, feet) each
        weights: of a pair's points.

    Raises:
        InputError: for no clips, a clip with no frames, and shapes that do not fit each other.
    """

    def __init__(self, places: Sequence[NDArray], contacts: Sequence[NDArray], weights: PairWeights) -> None:
        self.points = WindowedPoints(places)
        self.weights = weights
        if self.points.point_count != len(weights.mass):
            raise InputError(f"{self.points.point_count} points, expected {len(weights.mass)} by the weights", "metric")
        if len(contacts) != len(places):
            raise InputError(f"contacts of {len(contacts)} clips, expected {len(places)}", "metric")
        for number, (clip, feet) in enumerate(zip(places, contacts, strict=True)):
            require_shape(feet, (len(clip), len(weights.friction)), f"contacts of clip {number}", "metric")
        self._contacts = frozen(np.concatenate(contacts), np.bool_)

    @property
    def frame_count(self) -> int:
        """The number of frames N."""
        return self.points.frame_count

    def all_pairs(self) -> NDArray[np.float64]:
        """s of every pair of frames, exact and symmetric.  # (N, N)"""
        points = self.points
        shape = (points.lengths, points.windows, window_weights())
        return pair_all_pairs(points.centred(), self._contacts, *shape, self.weights, UNIT**-2)

    def pair_costs(self, i: ArrayLike, j: ArrayLike) -> NDArray[np.float64]:
        """s of chosen pairs of frames.  # (M,)"""
        return self.align(i, j).square / UNIT**2

    def align(self, i: ArrayLike, j: ArrayLike) -> Alignment:
        """How the windows of frames ``j`` go onto those of frames ``i``, each (M,)."""
        return joined([self._align(first, second) for first, second in pairs_in_portions(i, j)])

    def _align(self, first: NDArray[np.intp], second: NDArray[np.intp]) -> Alignment:
        points, windows = self.points, self.points.windows
        standing = self._contacts[windows[first]], self._contacts[windows[second]]
        return align_pair_windows(points.window(first), points.window(second), *standing, self.weights)


def align_pair_windows(
    first: ArrayLike,
    second: ArrayLike,
    first_contacts: ArrayLike,
    second_contacts: ArrayLike,
    weights: PairWeights,
) -> Alignment:
    """How windows of points go onto each other; ``square / UNIT**2`` of the result is s.

    Args:
        first: places of the points of the first windows, metres.  # (..., LENGTH, P, 3)
        second: those of the second windows.  # (..., LENGTH, P, 3)
        first_contacts: which feet stand at the frames of the first windows.  # (..., LENGTH, feet)
        second_contacts: which stand at those of the second.  # (..., LENGTH, feet)
        weights: of a pair's points.

    Raises:
        InputError: for windows of another length or another number of points or feet.
    """
    first, second = (np.asarray(values, dtype=np.float64) for values in (first, second))
    feet, points = weights.friction.shape
    for name, values, held in (("first", first, first_contacts), ("second", second, second_contacts)):
        leading = (None,) * (values.ndim - 3)
        require_shape(values, (*leading, LENGTH, points, 3), f"{name} window", "metric")
        require_shape(np.asarray(held), (*leading, LENGTH, feet), f"{name} contacts", "metric")
    of_points = window_weights()[:, None] * weights.of_pairs(first_contacts, second_contacts)
    flat = LENGTH * points
    p, q = (values.reshape(*values.shape[:-3], flat, 3) for values in (first, second))
    return align(p, q, of_points.reshape(*of_points.shape[:-2], flat))
