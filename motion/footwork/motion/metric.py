"""How unlike two frames are: the distance of their windows' point clouds after the best alignment on the ground."""

from collections.abc import Iterable, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.alignment import Alignment, align
from footwork.motion.all_pairs import all_pairs
from footwork.motion.arrays import frozen, require_shape
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.motion.window import LENGTH, window_weights
from footwork.motion.windowed_points import WindowedPoints, joined, pairs_in_portions

UNIT = 0.05644  # metres: s = 1 is a root mean square distance of this much (conventions.md 2)


class Metric(Protocol):
    """What transitions need of a metric over N frames: every pair at once, chosen pairs, and their alignment."""

    @property
    def frame_count(self) -> int:
        """The number of frames N."""
        ...

    def all_pairs(self) -> NDArray[np.float64]:
        """s of every pair of frames.  # (N, N)"""
        ...

    def pair_costs(self, i: ArrayLike, j: ArrayLike) -> NDArray[np.float64]:
        """s of chosen pairs of frames.  # (M,)"""
        ...

    def align(self, i: ArrayLike, j: ArrayLike) -> Alignment:
        """How frames ``j`` go onto frames ``i``.  # (M,)"""
        ...


class PointCloudMetric:
    """s = sum w |d|^2 / UNIT^2 over the joints of two windows, fixed weights that sum to 1 (conventions.md 1 and 2).

    Frames are numbered through the clips laid end to end; a window past a clip's end repeats the end frame.

    Args:
        places: world places of the points of each clip's frames, metres.  # (F, P, 3) each
        joint_weights: of the points of a frame, scaled to sum 1; equal where not given.  # (P,)

    Raises:
        InputError: for no clips, a clip with no frames, clips of different points, or weights that cannot be scaled.
    """

    def __init__(self, places: Sequence[NDArray], joint_weights: ArrayLike | None = None) -> None:
        self.points = WindowedPoints(places)
        self.joint_weights = scaled_weights(joint_weights, self.points.point_count)

    @classmethod
    def of_clips(cls, clips: Iterable[Clip]) -> "PointCloudMetric":
        """The uniform metric over the joints of clips."""
        return cls([clip_places(clip)[0] for clip in clips])

    @property
    def frame_count(self) -> int:
        """The number of frames N."""
        return self.points.frame_count

    def all_pairs(self) -> NDArray[np.float64]:
        """s of every pair of frames, exact and symmetric.  # (N, N)

        Windowed sums are sums along the diagonals of per-frame products, which are three matrix products; only
        one half of the matrix is computed, in stripes that stay in the cache.
        """
        points = self.points
        return all_pairs(
            points.centred(), points.lengths, points.windows, window_weights(), self.joint_weights, UNIT**-2
        )

    def pair_costs(self, i: ArrayLike, j: ArrayLike) -> NDArray[np.float64]:
        """s of chosen pairs of frames.  # (M,)"""
        return self.align(i, j).square / UNIT**2

    def align(self, i: ArrayLike, j: ArrayLike) -> Alignment:
        """How the windows of frames ``j`` go onto those of frames ``i``, each (M,)."""
        window, weights = self.points.window, self.joint_weights
        return joined([align_windows(window(a), window(b), weights) for a, b in pairs_in_portions(i, j)])


def align_windows(first: ArrayLike, second: ArrayLike, joint_weights: ArrayLike | None = None) -> Alignment:
    """How windows of points, given as arrays (..., LENGTH, P, 3), go onto each other under the fixed weights.

    ``square / UNIT**2`` of the result is s. Joint weights (P,) are scaled to sum 1, equal where not given.

    Raises:
        InputError: for windows of another length or another number of points.
    """
    first, second = (np.asarray(values, dtype=np.float64) for values in (first, second))
    points = first.shape[-2]
    for name, values in (("first", first), ("second", second)):
        require_shape(values, (*[None] * (values.ndim - 3), LENGTH, points, 3), f"{name} window", "metric")
    scaled = scaled_weights(joint_weights, points)
    weights = (window_weights()[:, None] * scaled).ravel()
    flat = (-1, LENGTH * points, 3)
    shape = np.broadcast_shapes(first.shape[:-3], second.shape[:-3])
    found = align(first.reshape(flat), second.reshape(flat), weights)
    return Alignment(*(part.reshape(shape) for part in found))


def scaled_weights(weights: ArrayLike | None, points: int) -> NDArray[np.float64]:
    """Weights of points scaled to sum 1, equal where not given.  # (P,)

    Raises:
        InputError: for another number of weights, one that is negative or not finite, or all of them zero.
    """
    weights = np.ones(points) if weights is None else np.asarray(weights, dtype=np.float64)
    require_shape(weights, (points,), "joint weights", "metric")
    if not (np.isfinite(weights).all() and (weights >= 0).all() and weights.sum() > 0):
        raise InputError("joint weights must be zero or more, not all zero", "metric")
    return frozen(weights / weights.sum(), np.float64)
