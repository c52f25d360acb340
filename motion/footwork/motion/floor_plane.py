"""The floor of a capture: found where feet stand still, turned level and brought to y = 0. Source: convention.

Capture volumes are rarely level: a floor that rises by 1 to 2 % lifts a walker by 5 cm in three metres, which is
more than the height that tells a standing foot from a swinging one.
"""

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.body import FEET
from footwork.motion.contacts import GROUND_PERCENTILE, ON_SPEED, SHORTEST_RUN, drop_short_runs
from footwork.motion.grounding import ball_places, heights_above_rest
from footwork.motion.kinematics import central_velocity
from footwork.motion.skeleton import Skeleton

# How slow a ball must be, for how many frames, to stand. Runners at 30 Hz are never still for three frames: the
# wider tests serve where the first finds nothing.
_STILL = ((ON_SPEED, SHORTEST_RUN), (2.5 * ON_SPEED, 2), (5.0 * ON_SPEED, 1))  # metres a second, frames
# A foot whose ball is this much lower than its ankle, above rest, stands on its toes, and only the ball counts.
_TIPTOE = 0.045  # metres
_HEIGHT_SPREAD = 0.015  # metres, of one stance about the floor
_SLOPE_SPREAD = 0.015  # of a capture's floor: what a fit over a short way is held to
_FOOT_SPREAD = 0.01  # metres, by which one foot is captured higher than the middle, the other lower
# Feet held still in the air (a kick, a lying body) drop out as the fit closes in on the floor.
_WINDOWS = (0.08, 0.05, 0.03, 0.03)  # metres
_START_PERCENTILE = 20.0


def level_floor(
    body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64], fps: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The motion turned and moved as a whole so that standing feet are on the level floor y = 0.

    Args:
        body: the common body.
        places: world places of its joints as captured, at its scale, metres.  # (F, J, 3)
        turns: world rotations of its joints.  # (F, J, 4)
        fps: frames a second.

    Returns:
        places (F, J, 3) and rotations (F, J, 4).
    """
    stances = next((found for test in _STILL if len(found := _stances(body, places, turns, fps, *test))), None)
    if stances is None:
        lowest = np.minimum(*heights_above_rest(body, places, turns)).min(axis=1)
        return places - [0.0, float(np.percentile(lowest, GROUND_PERCENTILE)), 0.0], turns
    slope_x, slope_z, height = _plane(stances)
    level = quaternion.between([-slope_x, 1.0, -slope_z], [0.0, 1.0, 0.0])
    middle = np.array([*stances[:, :2].mean(axis=0), height])[[0, 2, 1]]
    turned = quaternion.rotate(level, places - middle) + middle * [1.0, 0.0, 1.0]
    return turned, quaternion.multiply(level, turns)


def _stances(
    body: Skeleton,
    places: NDArray[np.float64],
    turns: NDArray[np.float64],
    fps: float,
    slowest: float,
    shortest: int,
) -> NDArray[np.float64]:
    """For each run of frames in which a foot keeps still: x, z, height above rest and side, -1 or 1.  # (N, 4)"""
    ankles, balls = heights_above_rest(body, places, turns)
    heights = np.where(ankles - balls < _TIPTOE, 0.5 * (ankles + balls), balls)
    points = ball_places(body, places, turns)
    still = drop_short_runs(np.linalg.norm(central_velocity(points, fps), axis=-1) < slowest, shortest)
    found = []
    for foot in range(len(FEET)):
        edges = np.flatnonzero(np.diff(still[:, foot], prepend=False, append=False))
        for start, end in edges.reshape(-1, 2):
            x, _, z = points[start:end, foot].mean(axis=0)
            found.append((x, z, np.median(heights[start:end, foot]), 2.0 * foot - 1.0))
    return np.array(found).reshape(-1, 4)


def _plane(stances: NDArray[np.float64]) -> tuple[float, float, float]:
    """Slopes along x and z, and height in the middle of the stances, of the floor under them.

    Least squares with a prior on each slope and on the feet's difference, over the stances near the plane so far.
    """
    sides = np.stack([stances[:, 3], np.ones(len(stances))], axis=-1)
    design = np.concatenate([stances[:, :2] - stances[:, :2].mean(axis=0), sides], axis=-1)
    spreads = np.array([_SLOPE_SPREAD, _SLOPE_SPREAD, _FOOT_SPREAD, np.inf])
    prior = np.diag((_HEIGHT_SPREAD / spreads) ** 2)
    plane = np.array([0.0, 0.0, 0.0, np.percentile(stances[:, 2], _START_PERCENTILE)])
    for window in _WINDOWS:
        near = np.abs(stances[:, 2] - design @ plane) < window
        if not near.any():
            break
        plane = np.linalg.solve(design[near].T @ design[near] + prior, design[near].T @ stances[near, 2])
    return float(plane[0]), float(plane[1]), float(plane[3])
