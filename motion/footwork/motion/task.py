"""What a player may ask for: the axes of the command space and the reward of being where one is."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.angle import wrapped

BEHAVIOUR_OF_LABEL = {"idle": "stop", "walk": "walk", "turn": "walk", "run": "run", "jump": "jump"}
HEADED = ("walk", "run")
ONE_SHOT = ("jump",)
BEHAVIOURS = ("stop", "walk", "run", "jump")


@dataclass(frozen=True)
class SteeringTask:
    """Relative heading x behaviour (conventions.md 5).

    Args:
        behaviours: what may be asked for.
        heading_bins: how many relative headings the values are tabulated at.
        heading_sigma: width of the Gaussian that judges the heading, radians.
        smoothness_sigma: sigma of a transition's smoothness exp(-s / sigma).
        discount: the worth of the next tick's reward against this one's.

    Raises:
        InputError: for no behaviours, fewer than four headings, widths not above zero or a discount outside [0, 1).
    """

    behaviours: tuple[str, ...] = BEHAVIOURS
    heading_bins: int = 36
    heading_sigma: float = math.radians(30.0)
    smoothness_sigma: float = 1.0
    discount: float = 0.98

    def __post_init__(self) -> None:
        if not self.behaviours:
            raise InputError("no behaviours, expected at least one", "task")
        if self.heading_bins < 4:
            raise InputError(f"{self.heading_bins} heading bins, expected at least 4", "task")
        for name in ("heading_sigma", "smoothness_sigma"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise InputError(f"{name} is {getattr(self, name)}, expected a positive number", "task")
        if not 0.0 <= self.discount < 1.0:
            raise InputError(f"discount is {self.discount}, expected 0 <= discount < 1", "task")

    @property
    def headings(self) -> NDArray[np.float64]:
        """The tabulated relative headings, evenly from -pi on, radians.  # (H,)"""
        return -np.pi + 2.0 * np.pi * np.arange(self.heading_bins) / self.heading_bins

    @property
    def headed(self) -> NDArray[np.bool_]:
        """Which behaviours are judged by their heading too.  # (B,)"""
        return np.array([behaviour in HEADED for behaviour in self.behaviours])

    def control_quality(self, delta: NDArray, wanted: NDArray, shown: NDArray) -> NDArray[np.float64]:
        """qc = 1[behaviour as wanted] exp(-(delta / sigma)^2 / 2), the Gaussian for headed behaviours only.

        Args:
            delta: wanted heading less facing, radians.  # (...)
            wanted: index of the behaviour asked for.  # (...)
            shown: index of the behaviour of the frame judged, -1 for none.  # (...)
        """
        heading = np.where(self.headed[wanted], np.exp(-0.5 * (wrapped(delta) / self.heading_sigma) ** 2), 1.0)
        return np.where(np.equal(wanted, shown), heading, 0.0)
