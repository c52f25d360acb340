"""What a player may ask for: the axes of the command space and the reward of being where one is."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.angle import wrapped

BEHAVIOUR_OF_LABEL = {"idle": "stop", "walk": "walk", "turn": "walk", "run": "run", "jump": "jump"}
HEADED = ("walk", "run")
ONE_SHOT = ("jump",)
BEHAVIOURS = ("stop", "walk", "run", "jump")
REWARDS = ("product", "sum")
MOST_WARP = math.radians(6.0)
WARP_SHARES = {"stop": 0.25, "walk": 1.0, "run": 1.0, "jump": 0.5}
MOST_LEVELS = 25
MOST_TICKS = 30


@dataclass(frozen=True)
class SteeringTask:
    """Relative heading x behaviour, by edges and extra turns (conventions.md 5).

    Args:
        behaviours: what may be asked for.
        heading_bins: how many relative headings the values are tabulated at.
        heading_sigma: width of the Gaussian that judges the heading, radians.
        smoothness_sigma: sigma of a transition's smoothness exp(-s / sigma).
        discount: the worth of the next tick's reward against this one's.
        reward: what control quality qc and transition quality qt make together: "product", qc qt, or "sum",
            qc + weight (qt - 1), which is how the product of their means changes where weight is mean qc / mean qt.
        weight: of the transition quality in a sum.
        warp: the largest extra turn of a tick, radians.
        warp_share: the part of it that frames of each behaviour may be turned by; none of it for those not named.
        warp_levels: among how many extra turns, evenly spread, the policy chooses.
        segment_ticks: for how many ticks a decision holds; natural edges are followed in between.

    Raises:
        InputError: for no behaviours, fewer than four headings, widths or a weight not above zero, a discount outside
            [0, 1), an unknown reward, a warp outside 0..6 degrees, shares outside 0..1, an even number of levels or
            more than 25, or segments of no tick or more than 30.
    """

    behaviours: tuple[str, ...] = BEHAVIOURS
    heading_bins: int = 36
    heading_sigma: float = math.radians(30.0)
    smoothness_sigma: float = 1.0
    discount: float = 0.98
    reward: str = "product"
    weight: float = 1.0
    warp: float = 0.0
    warp_share: Mapping[str, float] = field(default_factory=lambda: dict(WARP_SHARES))
    warp_levels: int = 5
    segment_ticks: int = 1

    def __post_init__(self) -> None:
        _require(len(self.behaviours) > 0, "no behaviours, expected at least one")
        _require(self.heading_bins >= 4, f"{self.heading_bins} heading bins, expected at least 4")
        for name in ("heading_sigma", "smoothness_sigma", "weight"):
            value = getattr(self, name)
            _require(math.isfinite(value) and value > 0.0, f"{name} is {value}, expected a positive number")
        _require(0.0 <= self.discount < 1.0, f"discount is {self.discount}, expected 0 <= discount < 1")
        _require(self.reward in REWARDS, f"reward is {self.reward!r}, expected one of {', '.join(REWARDS)}")
        _require(
            1 <= self.segment_ticks <= MOST_TICKS, f"{self.segment_ticks} segment ticks, expected 1 to {MOST_TICKS}"
        )
        self._check_warp()

    def _check_warp(self) -> None:
        degrees = math.degrees(self.warp)
        _require(0.0 <= self.warp <= MOST_WARP * (1.0 + 1e-9), f"warp is {degrees:g} degrees, expected 0 to 6")
        odd = 1 <= self.warp_levels <= MOST_LEVELS and self.warp_levels % 2 == 1
        _require(odd, f"{self.warp_levels} warp levels, expected an odd number up to {MOST_LEVELS}")
        for name, share in self.warp_share.items():
            _require(0.0 <= share <= 1.0, f"the warp share of {name} is {share}, expected 0 to 1")

    @property
    def headings(self) -> NDArray[np.float64]:
        """The tabulated relative headings, evenly from -pi on, radians.  # (H,)"""
        return -np.pi + 2.0 * np.pi * np.arange(self.heading_bins) / self.heading_bins

    @property
    def headed(self) -> NDArray[np.bool_]:
        """Which behaviours are judged by their heading too.  # (B,)"""
        return np.array([behaviour in HEADED for behaviour in self.behaviours])

    @property
    def additive(self) -> bool:
        """Whether the reward is the sum."""
        return self.reward == "sum"

    @property
    def turn_levels(self) -> NDArray[np.float64]:
        """The extra turns to choose among as shares of the largest, by size, so that of equals the least comes first.

        One where there is no warp.  # (L,)
        """
        if self.warp == 0.0:
            return np.zeros(1)
        steps = self.warp_levels // 2
        levels = np.arange(-steps, steps + 1) / max(steps, 1)
        return levels[np.argsort(np.abs(levels), kind="stable")]

    def turn_limit(self, behaviour: NDArray) -> NDArray[np.float64]:
        """The largest extra turn, radians, of frames by the index of their behaviour, -1 for none.  # (...)"""
        shares = [self.warp_share.get(name, 0.0) for name in self.behaviours]
        return self.warp * np.array([*shares, 0.0])[behaviour]

    def control_quality(self, delta: NDArray, wanted: NDArray, shown: NDArray) -> NDArray[np.float64]:
        """qc = 1[behaviour as wanted] exp(-(delta / sigma)^2 / 2), the Gaussian for headed behaviours only.

        Args:
            delta: wanted heading less facing, radians.  # (...)
            wanted: index of the behaviour asked for.  # (...)
            shown: index of the behaviour of the frame judged, -1 for none.  # (...)
        """
        heading = np.where(self.headed[wanted], np.exp(-0.5 * (wrapped(delta) / self.heading_sigma) ** 2), 1.0)
        return np.where(np.equal(wanted, shown), heading, 0.0)


def _require(holds: bool, problem: str) -> None:
    if not holds:
        raise InputError(problem, "task")
