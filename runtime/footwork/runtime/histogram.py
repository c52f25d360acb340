"""How often measurements fell between bounds; nothing is allocated when one is added."""

from bisect import bisect_left
from collections.abc import Sequence

TICK_SECONDS = (0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.016, 0.025, 0.033, 0.05, 0.1)


class Histogram:
    """Counts between ascending bounds.

    Args:
        bounds: upper bounds, each belonging to the part below it; a last part without one is added.

    Attributes:
        total: sum of what was added.
    """

    def __init__(self, bounds: Sequence[float] = TICK_SECONDS) -> None:
        self.bounds = tuple(bounds)
        self.total = 0.0
        self._counts = [0] * (len(self.bounds) + 1)

    def add(self, value: float) -> None:
        """Count a measurement."""
        self._counts[bisect_left(self.bounds, value)] += 1
        self.total += value

    def up_to(self) -> list[tuple[float, int]]:
        """Each bound and how many measurements were at most that; the last bound is infinite."""
        counts, sums = list(self._counts), []
        for count in counts:
            sums.append(count + (sums[-1] if sums else 0))
        return list(zip((*self.bounds, float("inf")), sums, strict=True))
