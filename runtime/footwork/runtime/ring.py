"""The last measurements of something, kept without allocating."""

import numpy as np


class Ring:
    """The last ``size`` numbers added.

    Args:
        size: how many are kept.
    """

    def __init__(self, size: int = 1 << 15) -> None:
        self._values = np.zeros(size)
        self.count = 0

    def add(self, value: float) -> None:
        """Keep a number, in the place of the oldest once full."""
        self._values[self.count % len(self._values)] = value
        self.count += 1

    def percentile(self, share: float) -> float:
        """The number that ``share`` percent of those kept do not exceed (linear interpolation); 0 while empty."""
        kept = self._values[: min(self.count, len(self._values))]
        return float(np.percentile(kept, share)) if len(kept) else 0.0
