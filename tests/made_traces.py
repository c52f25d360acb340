"""Players made up for tests."""

import numpy as np

from footwork.motion.trace import Trace


def trace(name: str = "made.csv", ticks: int = 140, forward: int = 1, turn: float = 0.0, attack: int = 0) -> Trace:
    """One who holds the same keys all the time and turns evenly, radians a tick; ``attack`` holds that key too."""
    none = np.zeros(ticks, dtype=bool)
    ahead, aside = np.full(ticks, forward, np.int8), np.zeros(ticks, np.int8)
    return Trace(name, ahead, aside, none, np.full(ticks, turn), np.full(ticks, attack > 0), none)
