"""The windowed cost of every pair of frames at once: matrix products, then sums along their diagonals (papers.md 1)."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.motion.window import RADIUS
from footwork.motion.window_costs import window_costs

THREADS = 2
_CHUNK = 128  # frames: large enough for fast matrix products, small enough that a stripe of them stays in the cache


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
        windows: the frames of each frame's window.  # (N, K)
        weights: of a window's frames, sum 1.  # (K,)
        point_weights: of a frame's points, sum 1.  # (P,)
        scale: what squared distances are multiplied by.
    """
    job = _Job(
        _chunks(lengths),
        weights,
        *_moments(places, windows, weights, point_weights),
        scale,
        np.empty((len(places), len(places))),
    )
    factors = _factors(places, windows, job.chunks, point_weights)
    with ThreadPoolExecutor(THREADS) as pool:
        for number in range(len(job.chunks.first)):
            _fill_stripe(pool, number, factors, job)
    return job.costs


class _Chunks(NamedTuple):
    """Stretches of at most _CHUNK frames of one clip each, and where their padded rows begin."""

    first: NDArray[np.intp]  # (C,)
    frames: NDArray[np.intp]  # (C,)
    column: NDArray[np.intp]  # (C,)


def _chunks(lengths: Sequence[int]) -> _Chunks:
    counts: list[int] = []
    for length in lengths:
        whole, rest = divmod(length, _CHUNK)
        counts += [_CHUNK] * whole + [rest] * (rest > 0)
    count = np.array(counts, dtype=np.intp)
    first = np.cumsum(count) - count
    return _Chunks(first, count, first + 2 * RADIUS * np.arange(len(count)))


class _Job(NamedTuple):
    """What every stripe needs; letters as in ``window_costs``."""

    chunks: _Chunks
    weights: NDArray[np.float64]
    mean: NDArray[np.float64]
    energy: NDArray[np.float64]
    scale: float
    costs: NDArray[np.float64]


class _Factors(NamedTuple):
    """What the three products are made of, over padded frames M; the left ones carry the weights."""

    left: NDArray[np.float64]  # (M, 2P) x and z
    left_y: NDArray[np.float64]  # (M, P)
    same: NDArray[np.float64]  # (2P, M) x and z
    crossed: NDArray[np.float64]  # (2P, M) z and -x
    same_y: NDArray[np.float64]  # (P, M)


def _factors(places: NDArray, windows: NDArray, chunks: _Chunks, weights: NDArray) -> _Factors:
    rows = [_padded(windows[first : first + count]) for first, count in zip(chunks.first, chunks.frames, strict=True)]
    x, y, z = np.moveaxis(places[np.concatenate(rows)], -1, 0)
    left = np.concatenate([x * weights, z * weights], axis=1)
    same, crossed = np.concatenate([x, z], axis=1).T, np.concatenate([z, -x], axis=1).T
    return _Factors(left, y * weights, *(np.ascontiguousarray(part) for part in (same, crossed, y.T)))


def _padded(windows: NDArray) -> NDArray[np.intp]:
    """The frames of a chunk with the context before and after it, from the windows of its frames."""
    return np.concatenate([windows[0, :RADIUS], windows[:, RADIUS], windows[-1, RADIUS + 1 :]])


def _moments(places: NDArray, windows: NDArray, weights: NDArray, point_weights: NDArray) -> tuple[NDArray, NDArray]:
    """Mean x and z of each window (N, 2), and its mean square about it (N,)."""
    frame_mean = point_weights @ places[..., [0, 2]]
    frame_square = np.sum(places**2, axis=-1) @ point_weights
    mean = np.einsum("k,nkc->nc", weights, frame_mean[windows])
    return mean, frame_square[windows] @ weights - np.sum(mean**2, axis=1)


def _fill_stripe(pool: ThreadPoolExecutor, number: int, factors: _Factors, job: _Job) -> None:
    """Costs of the frames of one chunk with all frames of the same and later chunks, on all threads."""
    first, count, column = job.chunks
    begin, rows = column[number], count[number]
    gram = _products(factors, slice(begin, begin + rows + 2 * RADIUS), begin)

    def fill(part: NDArray) -> None:
        others = (first[part], count[part], column[part] - begin)
        sums = np.empty((3, _CHUNK))
        window_costs(gram, job.weights, first[number], rows, *others, job.mean, job.energy, job.scale, sums, job.costs)

    later = np.arange(number, len(first))
    list(pool.map(fill, (later[thread::THREADS] for thread in range(THREADS))))


def _products(factors: _Factors, rows: slice, begin: int) -> NDArray[np.float64]:
    """The products of some padded frames with all from ``begin`` on.  # (3, rows, M - begin)"""
    gram = np.empty((3, rows.stop - rows.start, factors.same.shape[1] - begin))
    np.matmul(factors.left[rows], factors.same[:, begin:], out=gram[0])
    np.matmul(factors.left[rows], factors.crossed[:, begin:], out=gram[1])
    np.matmul(factors.left_y[rows], factors.same_y[:, begin:], out=gram[2])
    return gram
