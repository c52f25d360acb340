"""Short single-precision sketches of windows, laid out by sixteen, and the lower bounds of s that they give.

A sketch is a window's first shares and the two lengths of what they leave over. The least distance of two sketches
over all turns is a distance like the root of s itself (it obeys the triangle inequality) and never above it.
Rounding is allowed for by energies that are a little too small: sums of n products of two vectors are off by less than
n eps times the product of their lengths, which is no more than half of the sum of their energies.
"""

from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.window_basis import Shares

WIDTH = 16  # sketches side by side, as many as a processor computes with at once
GROUND, HEIGHT = 8, 6  # shares in a sketch, of x + iz and of y
SIZE = 2 * GROUND + HEIGHT + 2
SLACK = 64 * float(np.finfo(np.float32).eps)  # of the sum of both energies; twice what all sums can be off by


@dataclass(frozen=True, eq=False)
class Sketches:
    """Of R rows, in single precision and units of the root of s.

    Args:
        values: real and imaginary shares, shares of y, what both leave over.  # (R, SIZE)
        energy: sum of squares of each whole window.  # (R,)
    """

    values: NDArray[np.float32]
    energy: NDArray[np.float32]


def sketches_of(shares: Shares) -> Sketches:
    """Sketches from the shares of windows along principal components."""
    ground, height = _filled(shares.ground, GROUND), _filled(shares.height, HEIGHT)
    values = np.concatenate([np.real(ground), np.imag(ground), height, shares.left], axis=1)
    return Sketches(values.astype(np.float32), shares.energy.sum(axis=1).astype(np.float32))


def _filled(shares: NDArray, count: int) -> NDArray:
    """With columns of zeros where there are fewer components than asked for."""
    return np.pad(shares, ((0, 0), (0, count - shares.shape[1])))


def panels_of(values: NDArray[np.float32], slots: NDArray[np.intp]) -> NDArray[np.float32]:
    """Sixteen rows of ``values`` side by side, zeros where a slot is -1.  # (R, K), (16 n,) -> (n, K, WIDTH)"""
    chosen = values[slots] * (slots >= 0)[:, None]
    return np.ascontiguousarray(chosen.reshape(-1, WIDTH, values.shape[1]).swapaxes(1, 2))


@numba.njit(cache=True, nogil=True)
def least_costs(query: NDArray, panels: NDArray, energies: NDArray, panel: int, own: Any, bounds: NDArray) -> None:
    """Lower bounds of s of one row against a panel's members.

    The sums of one member stay in registers while members go side by side.

    Args:
        query: sketch of the one row.  # (SIZE,)
        panels: those of the members.  # (T, SIZE, WIDTH)
        energies: of the members, made smaller by SLACK.  # (T, WIDTH)
        panel: which panel.
        own: energy of the one row, made smaller too, a single-precision number.
        bounds: the result.  # (WIDTH,)
    """
    for v in range(WIDTH):
        real, imaginary, rest = np.float32(0), np.float32(0), np.float32(0)
        for c in range(GROUND):
            real += query[c] * panels[panel, c, v] + query[c + GROUND] * panels[panel, c + GROUND, v]
            imaginary += query[c] * panels[panel, c + GROUND, v] - query[c + GROUND] * panels[panel, c, v]
        for c in range(2 * GROUND, SIZE):
            rest += query[c] * panels[panel, c, v]
        turned = np.sqrt(real * real + imaginary * imaginary)
        bounds[v] = own + energies[panel, v] - np.float32(2) * (rest + turned)
