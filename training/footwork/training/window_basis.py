"""Windows in few numbers: their shares along principal components, and how much of each window is left over.

With u = x + iz about the mean, H of two windows is the sum over an orthonormal basis of conj(a_i) a_j. The product of
the first shares of it is off by no more than the product of what is left over of the two windows (Cauchy-Schwarz), and
likewise for the heights; so few shares bound s from below and from above (conventions.md 1).
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.threads import THREADS
from footwork.motion.window import LENGTH
from footwork.training.windows import Windows

_SAMPLE = 4096  # windows that the components are found from
_AT_ONCE = 512


@dataclass(frozen=True, eq=False)
class Shares:
    """Shares of R windows along components, greatest first, in units of the root of s.

    Args:
        ground: of x + iz; turned so that each row's first share is real and positive.  # (R, G) complex
        height: of y less its mean window.  # (R, Y)
        energy: sum of squares of each whole window, of x + iz and of y less its mean window.  # (R, 2)
    """

    ground: NDArray[np.complex128]
    height: NDArray[np.float64]
    energy: NDArray[np.float64]

    @property
    def left(self) -> NDArray[np.float64]:
        """Length of what the components leave over of each window, of x + iz and of y.  # (R, 2)"""
        ground, height = np.sum(np.abs(self.ground) ** 2, axis=1), np.sum(self.height**2, axis=1)
        return np.sqrt(np.maximum(self.energy - np.column_stack([ground, height]), 0.0))


def shares_of(windows: Windows, ground: int, height: int) -> Shares:
    """Shares along the first ``ground`` and ``height`` principal components (all there are, if fewer).

    The components are those of at most _SAMPLE windows taken evenly; any basis gives valid bounds.
    """
    sample = np.unique(np.linspace(0, windows.row_count - 1, _SAMPLE).astype(np.intp))
    u, y = _flat_windows(windows, sample)
    mean = y.mean(axis=0)
    ground_basis = _principal(u, ground)
    height_basis = _principal(y - mean, height)
    shares = Shares(*_projected(windows, ground_basis, height_basis, mean))
    first = shares.ground[:, 0]
    size = np.abs(first)
    turn = np.divide(first.conj(), size, out=np.ones_like(first), where=size > 0.0)
    shares.ground[...] *= turn[:, None]
    return shares


def _flat_windows(windows: Windows, rows: NDArray) -> tuple[NDArray, NDArray]:
    """u about its mean and y of some windows, times the root of each frame's weight.  # (n, LENGTH * P) each"""
    frames = windows.frames[windows.start[rows][:, None] + np.arange(LENGTH)]
    roots = np.sqrt(windows.weights)[:, None]
    u = (frames[:, :, 0] + 1j * frames[:, :, 2]) * roots
    # the mean is a multiple of one direction, that of equal places of all points
    u -= (windows.mean @ [1.0, 1j])[:, None, None][rows] * (roots * windows.root_weights)
    return u.reshape(len(rows), -1), (frames[:, :, 1] * roots).reshape(len(rows), -1)


def _principal(samples: NDArray, count: int) -> NDArray:
    """The directions of the greatest squares of samples (n, D), as columns.  # (D, count)"""
    _, directions = np.linalg.eigh(samples.conj().T @ samples)
    return np.ascontiguousarray(directions[:, ::-1][:, :count])


def _projected(
    windows: Windows, ground_basis: NDArray, height_basis: NDArray, mean: NDArray
) -> tuple[NDArray, NDArray, NDArray]:
    """Shares of all windows, from products of each frame by itself summed over the frames of a window."""
    points = len(windows.root_weights)
    roots = np.sqrt(windows.weights)[:, None]
    ground = ground_basis.shape[1]
    columns = _frame_columns(roots, ground_basis, np.column_stack([height_basis, mean]))
    spread = (roots * windows.root_weights).ravel() @ ground_basis
    spans = [slice(at, at + _AT_ONCE) for at in range(0, windows.row_count, _AT_ONCE)]

    def project(span: slice) -> NDArray[np.float64]:
        start = windows.start[span]
        frames = windows.frames[start[0] : start[-1] + LENGTH].reshape(-1, 3 * points)
        found = np.empty((len(start), columns.shape[2]))
        _sum_windows(frames @ columns.reshape(len(columns), -1), start - start[0], found)
        return found

    with ThreadPoolExecutor(THREADS) as pool:
        found = np.concatenate(list(pool.map(project, spans)))
    share = found[:, :ground] + 1j * found[:, ground : 2 * ground]
    share -= (windows.mean @ [1.0, 1j])[:, None] * spread
    along_mean = found[:, -1]
    energy = windows.energy.copy()
    energy[:, 1] += mean @ mean - 2.0 * along_mean
    return share, found[:, 2 * ground : -1] - mean @ height_basis, energy


def _frame_columns(roots: NDArray, ground: NDArray, height: NDArray) -> NDArray[np.float64]:
    """What the x, y and z of a frame are multiplied by, for each place it can have in a window.  # (3P, LENGTH, K)"""
    real = np.real(ground).reshape(LENGTH, -1, ground.shape[1]) * roots[:, :, None]
    imaginary = np.imag(ground).reshape(real.shape) * roots[:, :, None]
    height = height.reshape(LENGTH, -1, height.shape[1]) * roots[:, :, None]
    none = np.zeros_like(height)
    x = np.concatenate([real, imaginary, none], axis=2)
    y = np.concatenate([np.zeros_like(real), np.zeros_like(real), height], axis=2)
    z = np.concatenate([-imaginary, real, none], axis=2)
    return np.ascontiguousarray(np.concatenate([x, y, z], axis=1).swapaxes(0, 1))


@numba.njit(cache=True, nogil=True)
def _sum_windows(products: NDArray, start: NDArray, found: NDArray) -> None:
    """Sum each window's own share of its frames' products, (F, LENGTH * K) into (R, K)."""
    count = found.shape[1]
    for row in range(len(start)):
        line = found[row]
        line[:] = 0.0
        for k in range(LENGTH):
            part = products[start[row] + k, k * count : (k + 1) * count]
            for column in range(count):
                line[column] += part[column]
