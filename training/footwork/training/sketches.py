"""Short single-precision sketches of windows, laid out by sixteen, and the lower bounds of s that they give.

A sketch is a window's first shares and the two lengths of what they leave over. The least distance of two sketches
over all turns is a distance like the root of s itself (it obeys the triangle inequality) and never above it.
Rounding is allowed for by energies that are a little too small: sums of n products of two vectors are off by less than
n eps times the product of their lengths, which is no more than half of the sum of their energies.
"""

from dataclasses import dataclass

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


# Products and sums may be one instruction, which rounds less. Several rows go through one call, as what the compiler
# checks before it computes side by side takes as long as the sums of a row.
@numba.njit(cache=True, nogil=True, fastmath={"contract"})
def find_near(query: NDArray, own: NDArray, panel: NDArray, wanted: NDArray, near: NDArray) -> None:
    """Which of a panel's members may be near to some rows: what is above 0 in ``near``.

    A lower bound of s is e - 2 (r + |t|) with e the energies of both, r the product of their shares of y and of what is
    left over, and t that of their other shares; so it is under a limit where |t| > (e - limit) / 2 - r.

    Args:
        query: sketches of R rows, one after the other.  # (R * SIZE,)
        own: half their energies, made smaller by SLACK.  # (R,)
        panel: sketches of the members, side by side.  # (SIZE * WIDTH,)
        wanted: half of the members' energies, made smaller by SLACK, less their limits.  # (WIDTH,)
        near: the result.  # (R * WIDTH,)
    """
    for row in range(len(own)):
        for v in range(WIDTH):
            real, imaginary, rest = np.float32(0), np.float32(0), np.float32(0)
            for c in range(GROUND):
                x, z = panel[c * WIDTH + v], panel[(c + GROUND) * WIDTH + v]
                real += query[row * SIZE + c] * x + query[row * SIZE + c + GROUND] * z
                imaginary += query[row * SIZE + c] * z - query[row * SIZE + c + GROUND] * x
            for c in range(2 * GROUND, SIZE):
                rest += query[row * SIZE + c] * panel[c * WIDTH + v]
            least = max(own[row] + wanted[v] - rest, np.float32(0))
            # a row that needs no product at all is near even where there is none
            turned = real * real + imaginary * imaginary - least * least
            near[row * WIDTH + v] = turned if least > np.float32(0) else np.float32(1)
