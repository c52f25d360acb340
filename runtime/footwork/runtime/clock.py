"""Absolute deadlines: frame k is due at start + k / rate, however long the frames before it took.

Nothing ever sleeps a period, so errors of one frame do not add up. The clock is the monotonic one, which a change of
the time of day does not touch.
"""

import time

SECOND = 1_000_000_000

now_ns = time.monotonic_ns


class FrameClock:
    """Deadlines in whole nanoseconds.

    What happens after a stall: deadlines missed by less than ``patience`` are caught up with, frames following one
    another at once. Beyond that the deadlines between are given up and counted in ``skipped``; no tick is left out,
    the world only runs on later than it would have.

    Args:
        rate: frames a second.
        start: when frame 0 is due, monotonic nanoseconds.
        patience: how far behind is still caught up with, seconds.
    """

    def __init__(self, rate: int, start: int, patience: float = 0.25) -> None:
        self.rate = rate
        self.skipped = 0
        self._start = start
        self._index = 0
        self._patience = round(patience * rate)

    @property
    def deadline(self) -> int:
        """When the frame to come is due, monotonic nanoseconds."""
        return self._start + self._index * SECOND // self.rate

    @property
    def period(self) -> int:
        """The time between two frames, nanoseconds."""
        return SECOND // self.rate

    def advance(self, now: int) -> None:
        """Go on to the next deadline, or past those given up."""
        self._index += 1
        behind = (now - self.deadline) * self.rate // SECOND
        if behind > self._patience:
            self._index += behind
            self.skipped += behind
