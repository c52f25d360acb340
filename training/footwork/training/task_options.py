"""What a policy is asked to do, as it is said on the command line: angles in degrees."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from footwork.errors import InputError

if TYPE_CHECKING:  # at run time it is imported where it is needed, so that --help answers at once
    from footwork.motion.task import SteeringTask


@dataclass(frozen=True)
class TaskOptions:
    """The reward of a policy and what it may do.

    Args:
        discount: The worth of the next tick's reward against this one's.
        reward: What control and smoothness make together: product, or sum for control + weight (smoothness - 1).
        weight: The weight of smoothness in a sum.
        transition_price: The part of smoothness that every transition loses besides, so that a character which stands
            goes on along its clip and does not go round among frames that are alike.
        warp: The most, in degrees a tick, that a character may be turned by more or less than its capture, 0 to 6.
        warp_stop: The part of that for frames that stand.
        warp_jump: The part of that for frames that jump.
        warp_levels: Among how many extra turns the policy chooses, an odd number.
        heading_bins: At how many headings the policy is tabulated.
        segment_ticks: For how many ticks a decision holds.
        speed_levels: For how many speeds of walk and of run the policy is solved, spread over those that the frames
            show; between them it interpolates. With none, no speed can be asked for.
        speeds: Speeds of a behaviour in m/s in place of those, such as walk=0.8,1.2,1.6; may be given for each.
        speed_sigma: How far off a speed may be, as a part of it or of 1 m/s where that is slower.
        speed_weight: The part of control that hangs on the speed where one is asked for.
    """

    discount: float = 0.98
    reward: str = "product"
    weight: float = 1.0
    transition_price: float = 0.001
    warp: float = 0.0
    warp_stop: float = 0.25
    warp_jump: float = 0.5
    warp_levels: int = 5
    heading_bins: int = 36
    segment_ticks: int = 1
    speed_levels: int = 0
    speeds: tuple[str, ...] = ()
    speed_sigma: float = 0.1
    speed_weight: float = 0.75

    def task(self) -> SteeringTask:
        """The steering task, but for ``speed_levels``: which those are only the frames can tell.

        Raises:
            InputError: for what no task can have.
        """
        from footwork.motion.task import SteeringTask

        return SteeringTask(
            heading_bins=self.heading_bins,
            discount=self.discount,
            reward=self.reward,
            weight=self.weight,
            transition_price=self.transition_price,
            warp=math.radians(self.warp),
            warp_share={"stop": self.warp_stop, "walk": 1.0, "run": 1.0, "jump": self.warp_jump},
            warp_levels=self.warp_levels,
            segment_ticks=self.segment_ticks,
            speeds=dict(_levels(text) for text in self.speeds),
            speed_sigma=self.speed_sigma,
            speed_weight=self.speed_weight,
        )


def _levels(text: str) -> tuple[str, tuple[float, ...]]:
    """A behaviour and its speeds from ``behaviour=speed,speed...``."""
    behaviour, _, speeds = text.partition("=")
    try:
        return behaviour, tuple(float(speed) for speed in speeds.split(","))
    except ValueError:
        raise InputError(f"{text!r}, expected such as walk=0.8,1.2,1.6", "--speeds") from None
