"""What a player may ask for: the axes of the command space and the reward of being where one is."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.angle import wrapped
from footwork.motion.requests import ANY_SPEED, Requests

BEHAVIOUR_OF_LABEL = {"idle": "stop", "walk": "walk", "turn": "walk", "run": "run", "jump": "jump"}
HEADED = ("walk", "run")
ONE_SHOT = ("jump",)
BEHAVIOURS = ("stop", "walk", "run", "jump")
REWARDS = ("product", "sum")
MOST_WARP = math.radians(6.0)
WARP_SHARES = {"stop": 0.25, "walk": 1.0, "run": 1.0, "jump": 0.5}
MOST_LEVELS = 25
MOST_TICKS = 30
MOST_SPEED = 20.0
MOST_SPEED_LEVELS = 16
SLOW = 1.0
"""Speeds under this, m/s, are judged as it is."""


@dataclass(frozen=True)
class SteeringTask:
    """Relative heading x behaviour, at any speed or some, by edges and extra turns (conventions.md 5).

    Args:
        behaviours: what may be asked for.
        heading_bins: how many relative headings the values are tabulated at.
        heading_sigma: width of the Gaussian that judges the heading, radians.
        smoothness_sigma: sigma of a transition's smoothness exp(-s / sigma).
        discount: the worth of the next tick's reward against this one's.
        reward: what control quality qc and transition quality qt make together: "product", qc qt, or "sum",
            qc + weight (qt - 1), which is how the product of their means changes where weight is mean qc / mean qt.
        weight: of the transition quality in a sum.
        transition_price: the part of qt that a policy takes any transition to lose besides, however smooth, so that a
            character does not go round and round among frames that are alike.
        warp: the largest extra turn of a tick, radians.
        warp_share: the part of it that frames of each behaviour may be turned by; none of it for those not named.
        warp_levels: among how many extra turns, evenly spread, the policy chooses.
        segment_ticks: for how many ticks a decision holds; natural edges are followed in between.
        speeds: levels, m/s, of the behaviours that may be asked for at a speed; none for those not named.
        speed_sigma: width of the Gaussian that judges a speed, as a part of the one asked for or of 1 m/s where that
            is slower.
        speed_weight: the part of control quality that hangs on the speed where one is asked for.
        facing: those behaviours that are judged by the heading too; names that are not asked for are passed over.
        one_shot: those that are done once when they are asked for; likewise.

    Raises:
        InputError: for no behaviours, fewer than four headings, widths or a weight not above zero, a discount or a
            price outside [0, 1), an unknown reward, a warp outside 0..6 degrees, shares outside 0..1, an even number of
            levels or more than 25, segments of no tick or more than 30, and speeds of behaviours that have no heading,
            outside 0..20 m/s, that do not rise or are more than 16.
    """

    behaviours: tuple[str, ...] = BEHAVIOURS
    heading_bins: int = 36
    heading_sigma: float = math.radians(30.0)
    smoothness_sigma: float = 1.0
    discount: float = 0.98
    reward: str = "product"
    weight: float = 1.0
    transition_price: float = 0.0
    warp: float = 0.0
    warp_share: Mapping[str, float] = field(default_factory=lambda: dict(WARP_SHARES))
    warp_levels: int = 5
    segment_ticks: int = 1
    speeds: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    speed_sigma: float = 0.1
    speed_weight: float = 0.75
    facing: tuple[str, ...] = HEADED
    one_shot: tuple[str, ...] = ONE_SHOT

    def __post_init__(self) -> None:
        _require(len(self.behaviours) > 0, "no behaviours, expected at least one")
        _require(self.heading_bins >= 4, f"{self.heading_bins} heading bins, expected at least 4")
        for name in ("heading_sigma", "smoothness_sigma", "weight", "speed_sigma"):
            value = getattr(self, name)
            _require(math.isfinite(value) and value > 0.0, f"{name} is {value}, expected a positive number")
        _require(0.0 <= self.discount < 1.0, f"discount is {self.discount}, expected 0 <= discount < 1")
        price = self.transition_price
        _require(0.0 <= price < 1.0, f"transition_price is {price}, expected 0 <= price < 1")
        _require(self.reward in REWARDS, f"reward is {self.reward!r}, expected one of {', '.join(REWARDS)}")
        _require(
            1 <= self.segment_ticks <= MOST_TICKS, f"{self.segment_ticks} segment ticks, expected 1 to {MOST_TICKS}"
        )
        self._check_warp()
        self._check_speeds()

    def _check_warp(self) -> None:
        degrees = math.degrees(self.warp)
        _require(0.0 <= self.warp <= MOST_WARP * (1.0 + 1e-9), f"warp is {degrees:g} degrees, expected 0 to 6")
        odd = 1 <= self.warp_levels <= MOST_LEVELS and self.warp_levels % 2 == 1
        _require(odd, f"{self.warp_levels} warp levels, expected an odd number up to {MOST_LEVELS}")
        for name, share in self.warp_share.items():
            _require(0.0 <= share <= 1.0, f"the warp share of {name} is {share}, expected 0 to 1")

    def _check_speeds(self) -> None:
        _require(0.0 <= self.speed_weight <= 1.0, f"speed_weight is {self.speed_weight}, expected 0 to 1")
        headed = [name for name in self.behaviours if name in self.facing]
        for name, levels in self.speeds.items():
            _require(name in headed, f"speeds of {name!r}, expected only of {', '.join(headed) or 'no behaviour'}")
            many = 1 <= len(levels) <= MOST_SPEED_LEVELS
            _require(many, f"{len(levels)} speeds of {name}, expected 1 to {MOST_SPEED_LEVELS}")
            within = all(0.0 <= level <= MOST_SPEED for level in levels)  # NaN is not
            rising = all(low < high for low, high in pairwise(levels))
            told = ", ".join(f"{level:g}" for level in levels)
            _require(within and rising, f"speeds of {name} are {told}, expected rising ones of 0 to {MOST_SPEED:g} m/s")

    @property
    def requests(self) -> Requests:
        """What may be asked for: every behaviour at any speed, then the levels of each."""
        behaviour, speed = list(range(len(self.behaviours))), [ANY_SPEED] * len(self.behaviours)
        for index, name in enumerate(self.behaviours):
            levels = self.speeds.get(name, ())
            behaviour += [index] * len(levels)
            speed += levels
        return Requests(np.array(behaviour, np.int32), np.array(speed))

    @property
    def headings(self) -> NDArray[np.float64]:
        """The tabulated relative headings, evenly from -pi on, radians.  # (H,)"""
        return -np.pi + 2.0 * np.pi * np.arange(self.heading_bins) / self.heading_bins

    @property
    def headed(self) -> NDArray[np.bool_]:
        """Which behaviours are judged by their heading too.  # (B,)"""
        return np.array([behaviour in self.facing for behaviour in self.behaviours])

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

    def speed_quality(self, speed: NDArray, wanted: NDArray) -> NDArray[np.float64]:
        """What qc is multiplied by: 1 - w + w exp(-((speed - wanted) / sigma)^2 / 2), 1 where any speed will do.

        w is ``speed_weight`` and sigma is ``speed_sigma`` times the speed wanted, of 1 m/s at least (convention).

        Args:
            speed: of the frame judged, m/s (``node_speeds``).  # (...)
            wanted: the speed asked for, m/s, ANY_SPEED for none.  # (...)
        """
        sigma = self.speed_sigma * np.maximum(wanted, SLOW)
        near = np.exp(-0.5 * ((speed - wanted) / sigma) ** 2)
        return np.where(np.isnan(wanted), 1.0, 1.0 - self.speed_weight + self.speed_weight * near)


def _require(holds: bool, problem: str) -> None:
    if not holds:
        raise InputError(problem, "task")
