"""How much somebody may say: so many at once, and so many more a second."""


class Allowance:
    """A bucket that fills steadily and is emptied by what is said.

    Args:
        rate: how many a second.
        burst: how many at once.
        now: seconds, of a clock that never goes back.
    """

    def __init__(self, rate: float, burst: float, now: float) -> None:
        self._rate, self._burst, self._left, self._then = rate, burst, burst, now

    def take(self, now: float) -> bool:
        """Whether one more is allowed; if so it is counted."""
        self._left = min(self._burst, self._left + self._rate * (now - self._then))
        self._then = now
        allowed = self._left >= 1.0
        self._left -= allowed
        return allowed
