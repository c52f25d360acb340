"""The windowed cost of all pairs of frames at once: matrix products, then sums along diagonals (conventions.md 1)."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from footwork.motion.threads import THREADS
from footwork.motion.window import RADIUS
from footwork.motion.window_costs import window_costs

# Frames a block is long and wide: its products stay in the cache, and are small enough that the linear algebra
# library computes each on the thread that asks for it, so that our threads never wait for the library's.
_BLOCK = 64


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
    stretches = [
        _stretch(slice(begin, end), places[_padded(windows[begin:end])], point_weights, mean, energy)
        for begin, end in _cuts(lengths)
    ]
    costs = np.empty((len(places), len(places)))

    def fill_rows(number: int) -> None:
        a, scratch = stretches[number], np.empty((3, _BLOCK))
        for b in stretches[number:]:
            block, mirrored = costs[a.frames, b.frames], costs[b.frames, a.frames]
            means = (a.mean, b.mean, a.energy, b.energy)
            window_costs(_products(a, b), weights[RADIUS:], *means, scale, scratch, block, mirrored)

    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(fill_rows, range(len(stretches))))
    return costs


@dataclass(frozen=True, eq=False)
class _Stretch:
    """At most _BLOCK frames of one clip; the factors of products are over M = these and the context around them."""

    frames: slice
    weighted: NDArray[np.float64]  # (M, 2P) x and z times their weights
    weighted_y: NDArray[np.float64]  # (M, P)
    ground: NDArray[np.float64]  # (2P, M) x and z
    crossed: NDArray[np.float64]  # (2P, M) z and -x
    y: NDArray[np.float64]  # (P, M)
    mean: NDArray[np.float64]  # (frames, 2)
    energy: NDArray[np.float64]  # (frames,)


def _cuts(lengths: Sequence[int]) -> list[tuple[int, int]]:
    """Begin and end of stretches: each clip cut evenly into as few as there can be."""
    cuts: list[tuple[int, int]] = []
    start = 0
    for length in lengths:
        edges = np.linspace(start, start + length, -(-length // _BLOCK) + 1).round().astype(int).tolist()
        cuts += pairwise(edges)
        start += length
    return cuts


def _padded(windows: NDArray) -> NDArray[np.intp]:
    """The frames of a stretch with the context before and after it, from the windows of its frames."""
    return np.concatenate([windows[0, :RADIUS], windows[:, RADIUS], windows[-1, RADIUS + 1 :]])


def _stretch(frames: slice, points: NDArray, weights: NDArray, mean: NDArray, energy: NDArray) -> _Stretch:
    x, y, z = np.moveaxis(points, -1, 0)
    return _Stretch(
        frames=frames,
        weighted=np.concatenate([x * weights, z * weights], axis=1),
        weighted_y=y * weights,
        ground=np.concatenate([x.T, z.T]),
        crossed=np.concatenate([z.T, -x.T]),
        y=np.ascontiguousarray(y.T),
        mean=mean[frames],
        energy=energy[frames],
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
