"""The stages of a build: how long each took, and telling whoever watches."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[str, float], None]


class Stages:
    """Runs stages one after the other.

    Attributes:
        seconds: how long each finished stage took, all its parts together, in the order they began.
    """

    def __init__(self, tell: Progress | None = None) -> None:
        self.seconds: dict[str, float] = {}
        self._tell = tell or (lambda stage, share: None)

    @contextmanager
    def __call__(self, name: str) -> Iterator[Callable[[float], None]]:
        """Run a stage and tell its beginning and end; yields what is told the share of it that is done."""
        self._tell(name, 0.0)
        started = time.perf_counter()
        yield lambda share: self._tell(name, share)
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - started
        self._tell(name, 1.0)
