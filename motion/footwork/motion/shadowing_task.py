"""Shadowing: keeping one's distance from an opponent and facing it; what every tick of it costs."""

import math
from dataclasses import dataclass

from footwork.errors import InputError

MOST_BINS = 1024


@dataclass(frozen=True)
class ShadowingTask:
    """The cost of a tick and the axes of the values.

    A tick that ends with the opponent at distance d and bearing phi, its direction less one's own facing, costs
    |d - distance| / distance_scale + |phi| / facing_scale (after Chiu, Zordan and Wu 2007; figures are conventions.md
    11). The opponent is expected to stand where it is.

    Args:
        distance: to be kept, metres.
        distance_scale: an error of the distance that costs 1, metres.
        facing_scale: an error of the facing that costs 1, radians.
        discount: the worth of the next tick's cost against this one's.
        farthest: from there on all distances are worth the same, metres.
        distance_bins: distances with a value, evenly from 0 to ``farthest``.
        bearing_bins: bearings with a value, evenly from -pi on.

    Raises:
        InputError: for a number out of range.
    """

    distance: float = 1.2
    distance_scale: float = 0.3
    facing_scale: float = math.radians(30.0)
    discount: float = 0.98
    farthest: float = 6.0
    distance_bins: int = 31
    bearing_bins: int = 36

    def __post_init__(self) -> None:
        for name in ("distance", "distance_scale", "facing_scale", "farthest"):
            value = getattr(self, name)
            _require(math.isfinite(value) and value > 0.0, f"{name} is {value}, expected a positive number")
        _require(0.0 <= self.discount < 1.0, f"discount is {self.discount}, expected 0 <= discount < 1")
        _require(2 <= self.distance_bins <= MOST_BINS, f"{self.distance_bins} distance bins, expected 2 to {MOST_BINS}")
        _require(4 <= self.bearing_bins <= MOST_BINS, f"{self.bearing_bins} bearing bins, expected 4 to {MOST_BINS}")


def _require(holds: bool, problem: str) -> None:
    if not holds:
        raise InputError(problem, "shadowing task")
