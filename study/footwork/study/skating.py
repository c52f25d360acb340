"""How much feet skate by two measures that need no contacts: the skating ratio and the sum weighted by height.

The skating ratio is the share of frames that skate, as it is measured of generated motion: a foot under 5 cm at two
frames in turn, at over 0.5 m/s on average over five frames of 20 Hz (a quarter of a second). The weighted sum is that
of Zhang, Starke, Komura and Saito (2018): horizontal speed times 2 - 2^(h / H), h up to H = 2.5 cm.
Convention: feet are the balls, heights are above ``ground``, the height of a ball that stands.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion.clip import Clip
from footwork.motion.contacts import GROUND_PERCENTILE
from footwork.motion.kinematics import clip_places
from footwork.motion.tick import TICK_RATE

LOW = 0.05  # metres
FAST = 0.5  # metres a second
WINDOW = 7  # steps of 30 Hz: the odd number nearest to a quarter of a second
HIGHEST = 0.025  # metres


def standing_height(clips: list[Clip] | tuple[Clip, ...]) -> float:
    """Height of the balls of the feet while they stand: a low percentile over all clips, metres."""
    feet = clips[0].skeleton.feet[:, 1]
    return float(np.percentile(np.concatenate([clip_places(clip)[0][:, feet, 1] for clip in clips]), GROUND_PERCENTILE))


def skating_steps(balls: ArrayLike, ground: float) -> NDArray[np.bool_]:
    """At which steps from frame to frame a foot skates.  # (..., F, feet, 3) -> (..., F - 1, feet)

    Speeds are means over the steps of a window round each, of fewer at the ends.
    """
    balls = np.asarray(balls, dtype=np.float64)
    low = balls[..., 1] - ground < LOW
    speed = _smoothed(step_speeds(balls))
    return low[..., :-1, :] & low[..., 1:, :] & (speed > FAST)


def weighted_speeds(balls: ArrayLike, ground: float) -> NDArray[np.float64]:
    """Speed at each step, weighted by height, m/s: all of it on the ground, none from H up.  # as ``skating_steps``"""
    balls = np.asarray(balls, dtype=np.float64)
    height = 0.5 * (balls[..., :-1, :, 1] + balls[..., 1:, :, 1]) - ground
    return step_speeds(balls) * (2.0 - 2.0 ** np.clip(height / HIGHEST, 0.0, 1.0))


def step_speeds(balls: NDArray) -> NDArray[np.float64]:
    """Horizontal speed from each frame to the next, m/s.  # (..., F, feet, 3) -> (..., F - 1, feet)"""
    return np.linalg.norm(np.diff(balls, axis=-3)[..., [0, 2]], axis=-1) * TICK_RATE


def _smoothed(speeds: NDArray) -> NDArray[np.float64]:
    """Means over a window of steps along the last axis but one."""
    sums = np.cumsum(np.concatenate([np.zeros_like(speeds[..., :1, :]), speeds], axis=-2), axis=-2)
    steps, half = speeds.shape[-2], WINDOW // 2
    first = np.maximum(np.arange(steps) - half, 0)
    last = np.minimum(np.arange(steps) + half + 1, steps)
    return (sums[..., last, :] - sums[..., first, :]) / (last - first)[:, None]
