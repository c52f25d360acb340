"""The floor of captures: found where feet stand still, turned level and brought to y = 0. Source: convention.

Capture volumes are rarely level: a floor that rises by 1 to 2 % lifts a walker by 5 cm in three metres, which is
more than the height that tells a standing foot from a swinging one. One person's captures share a volume, and their
floor is found together: runners' feet hardly ever stand still, and those that do push their balls centimetres deep,
so that a run by itself would be lifted above the same person's walks.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

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
_CAPTURE_SPREAD = 0.005  # metres, by which one capture is higher or lower than the others of a person
# Feet held still in the air (a kick, a lying body) drop out as the fit closes in on the floor.
_WINDOWS = (0.08, 0.05, 0.03, 0.03)  # metres
_START_PERCENTILE = 20.0
# A capture whose feet typically stand further than this from its person's floor was made on another.
_FURTHEST = 0.08  # metres


@dataclass(frozen=True)
class Floor:
    """A plane: its slopes along x and z, and its height at x = z = 0, metres."""

    slope_x: float
    slope_z: float
    height: float

    def level(
        self, places: NDArray[np.float64], turns: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Places (..., 3) and rotations (..., 4) turned and moved as a whole so that this floor becomes y = 0."""
        turn = quaternion.between([-self.slope_x, 1.0, -self.slope_z], [0.0, 1.0, 0.0])
        return quaternion.rotate(turn, places - [0.0, self.height, 0.0]), quaternion.multiply(turn, turns)


@dataclass(frozen=True, eq=False)
class Footing:
    """Where the feet of one capture stand.

    Args:
        rank: how slow the feet are there: 0 for solid stances, then ever weaker evidence.
        stances: x, z and height above rest, metres, and side: -1 left, 1 right, 0 neither.  # (N, 4), N > 0
    """

    rank: int
    stances: NDArray[np.float64]


def footing_of(body: Skeleton, places: NDArray[np.float64], turns: NDArray[np.float64], fps: float) -> Footing:
    """Where feet keep still, by the strictest test that any of them passes.

    Args:
        body: the common body.
        places: world places of its joints as captured, at its scale, metres.  # (F, J, 3)
        turns: world rotations of its joints.  # (F, J, 4)
        fps: frames a second.

    Returns:
        the stances; for feet that never pause a single one, at a low percentile of their heights.
    """
    for rank, (slowest, shortest) in enumerate(_STILL):
        stances = _stances(body, places, turns, fps, slowest, shortest)
        if len(stances):
            return Footing(rank, stances)
    lowest = np.minimum(*heights_above_rest(body, places, turns)).min(axis=1)
    x, _, z = places[:, 0].mean(axis=0)
    return Footing(len(_STILL), np.array([[x, z, np.percentile(lowest, GROUND_PERCENTILE), 0.0]]))


def floors_under(captures: Sequence[Footing]) -> list[Floor]:
    """The floor of each of one person's captures: one plane for all, each within millimetres of it.

    The captures with the most solid stances give the plane; the others take it. Those that stand off it, made in
    another volume, have a floor each of their own.
    """
    best = min(capture.rank for capture in captures)
    shared = _planes([capture.stances if capture.rank == best else capture.stances[:0] for capture in captures])
    return [
        floor if _stands_on(capture, floor) else _planes([capture.stances])[0]
        for capture, floor in zip(captures, shared, strict=True)
    ]


def _stands_on(capture: Footing, floor: Floor) -> bool:
    heights = capture.stances[:, 2] - capture.stances[:, :2] @ [floor.slope_x, floor.slope_z] - floor.height
    return bool(np.median(np.abs(heights)) < _FURTHEST)


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


def _planes(captures: Sequence[NDArray[np.float64]]) -> list[Floor]:
    """The floor of each capture under its stances (N, 4): slopes in common, heights close to each other.

    Least squares with a prior on each slope, on the feet's difference and on the captures', over the stances near
    the floor so far.
    """
    stances = np.concatenate(captures)
    middle = stances[:, :2].mean(axis=0)
    owners = np.repeat(np.arange(len(captures)), [len(own) for own in captures])
    owned = sparse.csr_array((np.ones(len(stances)), (np.arange(len(stances)), owners)), (len(stances), len(captures)))
    columns = [stances[:, :2] - middle, stances[:, 3:], owned, np.ones((len(stances), 1))]
    design = sparse.csr_array(sparse.hstack(columns))
    spreads = [_SLOPE_SPREAD, _SLOPE_SPREAD, _FOOT_SPREAD, *[_CAPTURE_SPREAD] * len(captures), np.inf]
    prior = np.diag((_HEIGHT_SPREAD / np.array(spreads)) ** 2)
    plane = np.zeros(len(spreads))
    plane[-1] = np.percentile(stances[:, 2], _START_PERCENTILE)
    for window in _WINDOWS:
        near = np.abs(stances[:, 2] - design @ plane) < window
        if not near.any():
            break
        chosen = design[near]
        plane = np.linalg.solve((chosen.T @ chosen).toarray() + prior, chosen.T @ stances[near, 2])
    at_origin = plane[-1] - middle @ plane[:2]
    return [Floor(float(plane[0]), float(plane[1]), float(at_origin + own)) for own in plane[3:-1]]
