"""The player model: how likely each command of one tick is after each command of the tick before.

A command is a behaviour and a heading; players turn alike whichever way they look, so only the jump of the heading
counts and the model is circulant in it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_shape

_ROUNDING = 1e-9


@dataclass(frozen=True)
class TraceFile:
    """A recording that a model learned from.

    Args:
        name: of the file.
        digest: SHA-256 of the file.
    """

    name: str
    digest: str


@dataclass(frozen=True, eq=False)
class PlayerModel:
    """P(behaviour b, heading u -> b', u + j) = change[b, b', j] (conventions.md 5).

    Args:
        behaviours: what may be asked for.
        change: for each behaviour asked for, the probability of each behaviour and jump of the heading at the next
            tick; jump j is one of j bins to the left, of 2 pi / H each, round the circle.  # (B, B, H)
        learned_from: the recordings that it was learned from.

    Raises:
        InputError: for probabilities of the wrong shape, not finite or below zero, or that do not sum to one.
    """

    behaviours: tuple[str, ...]
    change: NDArray[np.float64]
    learned_from: tuple[TraceFile, ...] = ()
    where: str = "player model"

    def __post_init__(self) -> None:
        object.__setattr__(self, "change", frozen(self.change, np.float64))
        object.__setattr__(self, "learned_from", tuple(self.learned_from))
        count = len(self.behaviours)
        require_shape(self.change, (count, count, None), "change", self.where)
        require_finite(self.change, "change", self.where)
        self._require_probabilities()

    def _require_probabilities(self) -> None:
        if (self.change < 0.0).any():
            raise InputError(f"change holds {self.change.min()}, expected probabilities", self.where)
        sums = self.change.sum(axis=(1, 2))
        wrong = np.flatnonzero(np.abs(sums - 1.0) > _ROUNDING)
        if wrong.size:
            problem = f"probabilities after {self.behaviours[wrong[0]]} sum to {sums[wrong[0]]}, expected 1"
            raise InputError(problem, self.where)

    @property
    def heading_bins(self) -> int:
        """H, how many headings there are round the circle."""
        return self.change.shape[2]

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The row-stochastic matrix from command (b, u) to command (b', u').  # (B H, B H)"""
        count, bins = len(self.behaviours), self.heading_bins
        jump = (np.arange(bins)[None, :] - np.arange(bins)[:, None]) % bins
        return self.change[:, :, jump].transpose(0, 2, 1, 3).reshape(count * bins, count * bins)

    def expected(self, values: NDArray) -> NDArray[np.float64]:
        """W(b, u) = sum over b', u' of P((b, u) -> (b', u')) V(b', u').  # (..., B, H) -> (..., B, H)"""
        flat = np.reshape(values, (*values.shape[:-2], -1)) @ self.matrix.T
        return flat.reshape(values.shape)


def persistent_player(behaviours: tuple[str, ...], heading_bins: int) -> PlayerModel:
    """A player who never changes their mind."""
    change = np.zeros((len(behaviours), len(behaviours), heading_bins))
    change[..., 0] = np.eye(len(behaviours))
    return PlayerModel(behaviours, change)
