"""The windowed cost of all pairs of frames under fixed weights: matrix products, then sums along diagonals
(conventions.md 1).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion.blocks import BLOCK, filled_in_blocks
from footwork.motion.window import RADIUS
from footwork.motion.window_costs import window_costs


def all_pairs(
    places: NDArray,
    lengths: Sequence[int],
    windows: NDArray,
    weights: NDArray,
    point_weights: NDArray,
    scale: float,
) -> NDArray[np.float64]:
    """``scale`` times the smallest weighted squared distance of every two frames' windows.  # (N, N)

    Exact and symmetric; one half is computed and mirrored.

    Args:
        places: points of each frame, near the origin so that no accuracy is lost.  # (N, P, 3)
        lengths: frames of each clip; they sum to N.
        windows: the frames of each frame's window.  # (N, LENGTH)
        weights: of a window's frames, symmetric, sum 1.  # (LENGTH,)
        point_weights: of a frame's points, sum 1.  # (P,)
        scale: what squared distances are multiplied by.
    """
    mean, energy = _moments(places, windows, weights, point_weights)

    def stretch(frames: slice, padded: NDArray[np.intp]) -> _Stretch:
        return _stretch(places[padded], point_weights, mean[frames], energy[frames])

    def fill(a: _Stretch, b: _Stretch, block: NDArray, mirrored: NDArray) -> None:
        means = (a.mean, b.mean, a.energy, b.energy)
        window_costs(_products(a, b), weights[RADIUS:], *means, scale, np.empty((3, BLOCK)), block, mirrored)

    return filled_in_blocks(lengths, windows, stretch, fill)


@dataclass(frozen=True, eq=False)
class _Stretch:
    """At most BLOCK frames of one clip; the factors of products are over M = these and the context around them."""

    weighted: NDArray[np.float64]  # (M, 2P) x and z times their weights
    weighted_y: NDArray[np.float64]  # (M, P)
    ground: NDArray[np.float64]  # (2P, M) x and z
    crossed: NDArray[np.float64]  # (2P, M) z and -x
    y: NDArray[np.float64]  # (P, M)
    mean: NDArray[np.float64]  # (frames, 2)
    energy: NDArray[np.float64]  # (frames,)


def _stretch(points: NDArray, weights: NDArray, mean: NDArray, energy: NDArray) -> _Stretch:
    x, y, z = np.moveaxis(points, -1, 0)
    return _Stretch(
        weighted=np.concatenate([x * weights, z * weights], axis=1),
        weighted_y=y * weights,
        ground=np.concatenate([x.T, z.T]),
        crossed=np.concatenate([z.T, -x.T]),
        y=np.ascontiguousarray(y.T),
        mean=mean,
        energy=energy,
    )


def _moments(places: NDArray, windows: NDArray, weights: NDArray, point_weights: NDArray) -> tuple[NDArray, NDArray]:
    """Mean x and z of each window (N, 2), and its mean square about it (N,)."""
    frame_mean = point_weights @ places[..., [0, 2]]
    frame_square = np.sum(places**2, axis=-1) @ point_weights
    mean = np.einsum("k,nkc->nc", weights, frame_mean[windows])
    return mean, frame_square[windows] @ weights - np.sum(mean**2, axis=1)


def _products(a: _Stretch, b: _Stretch) -> NDArray[np.float64]:
    """Per-frame sums over points of x x' + z z', x z' - z x' and y y'.  # (3, M of a, M of b)"""
    gram = np.empty((3, len(a.weighted), b.ground.shape[1]))
    np.matmul(a.weighted, b.ground, out=gram[0])
    np.matmul(a.weighted, b.crossed, out=gram[1])
    np.matmul(a.weighted_y, b.y, out=gram[2])
    return gram
