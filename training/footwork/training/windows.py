"""The windows of all rows that transitions are looked for among, laid out so that any pair can be compared quickly."""

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.metric import UNIT
from footwork.motion.window import LENGTH, RADIUS, window_weights
from footwork.training.pair_windows import Standing, fixed_standing, standing_of
from footwork.training.row_metric import RowMetric, contacts_of_rows

LANES = 8  # points are laid out in multiples of this, so that a processor adds up eight at a time
_FRINGE = -1


@dataclass(frozen=True, eq=False)
class Windows:
    """R rows: the nodes of chains and, of interpolated ones, the row before the first and after the last node.

    Frames are the chains' rows with the ends repeated, so that each window is LENGTH frames in a row. Places are
    about the middle of their chain on the ground and about one height for all, and scaled by the square root of the
    point's weight over UNIT, so that sums of their products are in units of s.

    Args:
        frames: x, y and z of the points of each frame; P is filled up with zeros.  # (F, 3, P)
        start: first frame of each row's window.  # (R,)
        mean: weighted sum of scaled x and of z over each window, times the points' root weights.  # (R, 2)
        energy: sum of squares of each window: of x and z about the mean, and of y.  # (R, 2)
        node: the node of each row, -1 for the rows before and after.  # (R,)
        first: first row of each row's chain.  # (R,)
        last: last row of each row's chain.  # (R,)
        weights: of a window's frames, sum 1.  # (LENGTH,)
        root_weights: square roots of the points' weights, filled up with zeros.  # (P,)
        standing: what stands at each frame, for a metric whose weights depend on it.
    """

    frames: NDArray[np.float64]
    start: NDArray[np.intp]
    mean: NDArray[np.float64]
    energy: NDArray[np.float64]
    node: NDArray[np.intp]
    first: NDArray[np.intp]
    last: NDArray[np.intp]
    weights: NDArray[np.float64]
    root_weights: NDArray[np.float64]
    standing: Standing

    @property
    def row_count(self) -> int:
        """The number of rows R."""
        return len(self.start)


def windows_of(metric: RowMetric) -> Windows:
    """The windows of the rows of a metric's chains, under the weights that are the same for all pairs."""
    chains = metric.chains
    fringe = np.minimum(chains.context, 1)
    length = chains.length + 2 * fringe
    first = np.cumsum(length) - length
    into = np.arange(length.sum()) - np.repeat(first, length)
    around = np.maximum(RADIUS + fringe - chains.context, 0)  # ends repeated on either side
    frames, first_frame, row_of_frame = _frames(metric, around)
    start = into + np.repeat(first_frame + around + chains.context - fringe - RADIUS, length)
    weights = window_weights()
    root_weights = np.zeros(frames.shape[2])
    root_weights[: len(metric.weights)] = np.sqrt(metric.weights)
    standing = fixed_standing()
    if metric.pair is not None:
        standing = standing_of(contacts_of_rows(chains, row_of_frame), metric.pair, root_weights)
    mean, energy = _moments(frames, start, root_weights, weights)
    end = np.repeat(first + length - 1, length)
    first = np.repeat(first, length)
    rows = np.arange(len(first))
    inner = (rows - first >= np.repeat(fringe, length)) & (end - rows >= np.repeat(fringe, length))
    node = np.where(inner, np.cumsum(inner) - 1, _FRINGE)
    return Windows(frames, start, mean, energy, node, first, end, weights, root_weights, standing)


def _frames(metric: RowMetric, around: NDArray) -> tuple[NDArray[np.float64], NDArray[np.intp], NDArray[np.intp]]:
    """Scaled places of all frames (F, 3, P), the first frame of each chain (C,), and the row of each frame (F,)."""
    chains, points, scale = metric.chains, metric.points, np.sqrt(metric.weights) / UNIT
    rows = chains.length + 2 * chains.context
    count = rows + 2 * around
    begin = np.cumsum(count) - count
    into = np.arange(count.sum()) - np.repeat(begin + around, count)
    source = np.repeat(chains.first_row, count) + np.clip(into, 0, np.repeat(rows - 1, count))
    frames = np.zeros((len(source), 3, -(-points.shape[1] // LANES) * LANES))
    centre = np.add.reduceat(points.mean(axis=1), chains.first_row) / rows[:, None]
    centre[:, 1] = points[..., 1].mean()
    for begun in range(0, len(source), 1 << 14):
        span = slice(begun, begun + (1 << 14))
        chain = np.searchsorted(begin, np.arange(begun, min(begun + (1 << 14), len(source))), side="right") - 1
        places = (points[source[span]] - centre[chain][:, None]) * scale[:, None]
        frames[span, :, : points.shape[1]] = places.transpose(0, 2, 1)
    return frames, begin, source


def _moments(
    frames: NDArray, start: NDArray, root_weights: NDArray, weights: NDArray
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    frame_mean = frames[:, ::2] @ root_weights
    mean = np.zeros((len(start), 2))
    for k in range(LENGTH):
        mean += weights[k] * frame_mean[start + k]
    energy = np.empty((len(start), 2))
    _fill_energies(frames, start, mean, weights, energy)
    return mean, energy


@numba.njit(cache=True, nogil=True)
def _fill_energies(frames: NDArray, start: NDArray, mean: NDArray, weights: NDArray, energy: NDArray) -> None:
    for row in range(len(start)):
        energy[row, 0], energy[row, 1] = -(mean[row, 0] ** 2) - mean[row, 1] ** 2, 0.0
        for k in range(len(weights)):
            ground, _, height = frame_products(frames, start[row] + k, start[row] + k)
            energy[row, 0] += weights[k] * ground
            energy[row, 1] += weights[k] * height


# Sums may be taken in any order here, with products in one instruction, which makes this four times faster.
@numba.njit(cache=True, nogil=True, fastmath={"reassoc", "contract"})
def frame_products(frames: NDArray, a: int, b: int) -> tuple[float, float, float]:
    """Sums over points of x x' + z z', x z' - z x' and y y' of two frames."""
    cosine, sine, height = 0.0, 0.0, 0.0
    for p in range(frames.shape[2]):
        cosine += frames[a, 0, p] * frames[b, 0, p] + frames[a, 2, p] * frames[b, 2, p]
        sine += frames[a, 0, p] * frames[b, 2, p] - frames[a, 2, p] * frames[b, 0, p]
        height += frames[a, 1, p] * frames[b, 1, p]
    return cosine, sine, height
