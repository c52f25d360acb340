"""Confidence intervals by drawing the same things again: the percentile bootstrap (Efron 1979)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

DRAWS = 4000
LEVEL = 0.95


class Estimate(NamedTuple):
    """A number and its confidence interval; all None where there was nothing to estimate it from."""

    value: float | None
    low: float | None
    high: float | None

    def words(self, digits: int = 1, unit: str = "") -> str:
        """Such as ``9.0 (8.1 to 10.2) cm``."""
        if self.value is None or self.low is None or self.high is None:
            return "–"
        unit = f" {unit}" if unit else ""
        return f"{self.value:.{digits}f} ({self.low:.{digits}f} to {self.high:.{digits}f}){unit}"


NOTHING = Estimate(None, None, None)


def ratio(amount: ArrayLike, count: ArrayLike, seed: int = 0) -> Estimate:
    """sum(amount) / sum(count) over n things, such as transitions, each drawn whole.

    With counts of one it is the mean. Draws that hold no count at all are left out.

    Args:
        amount: what each thing brings.  # (n,)
        count: by how many, zero or more.  # (n,)
        seed: of the draws.
    """
    amount, count = (np.asarray(values, dtype=np.float64) for values in (amount, count))
    if not count.sum() > 0.0:
        return NOTHING
    drawn = draws(len(count), seed)
    return estimate(amount.sum() / count.sum(), _quotient(drawn @ amount, drawn @ count))


def relative_difference(
    amount: ArrayLike, count: ArrayLike, other_amount: ArrayLike, other_count: ArrayLike, seed: int = 0
) -> Estimate:
    """How much the first ratio lies above the second, as a share of it, over things that may count in both.

    All are (n,); what does not belong to one of the two brings it zero. A thing is drawn into both at once, so what
    they have in common does not widen the interval.
    """
    parts = [np.asarray(values, dtype=np.float64) for values in (amount, count, other_amount, other_count)]
    sums = [float(part.sum()) for part in parts]
    if not min(sums[1:]) > 0.0:
        return NOTHING
    drawn = draws(len(parts[0]), seed)
    first, second = (_quotient(drawn @ parts[at], drawn @ parts[at + 1]) for at in (0, 2))
    return estimate(sums[0] / sums[1] / (sums[2] / sums[3]) - 1.0, _quotient(first, second) - 1.0)


def draws(things: int, seed: int) -> NDArray[np.float64]:
    """How often each of n things comes up when n are drawn with replacement.  # (DRAWS, n)"""
    drawn = np.random.default_rng(seed).integers(0, things, (DRAWS, things))
    numbered = drawn + things * np.arange(DRAWS)[:, None]
    return np.bincount(numbered.ravel(), minlength=DRAWS * things).reshape(DRAWS, things).astype(np.float64)


def _quotient(amounts: NDArray, counts: NDArray) -> NDArray[np.float64]:
    return np.divide(amounts, counts, out=np.full(len(amounts), np.nan), where=counts > 0.0)


def estimate(value: float, drawn: NDArray[np.float64]) -> Estimate:
    """A number with the interval of what it was in each draw.  # drawn (DRAWS,)"""
    tail = 50.0 * (1.0 - LEVEL)
    low, high = np.nanpercentile(drawn, [tail, 100.0 - tail])
    return Estimate(float(value), float(low), float(high))
