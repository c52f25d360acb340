"""Flights: while no foot stands, the centre of mass falls at exactly g, whatever the limbs do.

Before and after a flight the height of the centre of mass runs along fifth-degree curves that leave the ground
with the flight's speed and with -g, so that the force of the ground grows from nothing and ends in nothing.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from footwork.motion.skeleton import Skeleton
from footwork.training.embedded.balance import centre_of_mass
from footwork.training.embedded.curves import quintic
from footwork.training.embedded.footsteps import FPS, Plan

GRAVITY = 9.81  # m/s^2
_PUSH, _ABSORB = 0.26, 0.32  # time of the last push and of the first landing, seconds
_ROUNDS = 6


def fly(
    plan: Plan,
    body: Skeleton,
    root: NDArray[np.float64],
    pose: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> NDArray[np.float64]:
    """The root (F, 3), moved up and down so that the centre of mass obeys gravity in every flight.

    ``pose`` gives the local rotations for a root: the feet stay where they are, so moving the root bends the legs,
    which moves the centre of mass in turn; a few rounds settle it.
    """
    flights = plan.flights()
    if not flights:
        return root
    height = centre_of_mass(body, root, pose(root))[:, 1]
    target = _target(plan, flights, height)
    root = root.copy()
    for _ in range(_ROUNDS):
        root[:, 1] += target - centre_of_mass(body, root, pose(root))[:, 1]
    return root


def _target(plan: Plan, flights: list[tuple[float, float]], height: NDArray[np.float64]) -> NDArray[np.float64]:
    times, target = plan.times, height.copy()
    speed = np.gradient(height, 1.0 / FPS)
    ends = [(start, end, height[0] + _extra(plan, end)) for start, end in flights]
    for start, end, level in ends:
        airborne = (times >= start) & (times <= end)
        target[airborne] = level + 0.5 * GRAVITY * (times[airborne] - start) * (end - times[airborne])
    for before, after in zip([None, *ends], [*ends, None], strict=True):
        begin = _landing(before) if before else None
        finish = _leaving(after) if after else None
        if begin and finish and finish[0] - begin[0] < _PUSH + _ABSORB:
            _fill(times, target, begin, finish)
            continue
        if begin:
            _fill(times, target, begin, _on_base(times, height, speed, begin[0] + _ABSORB))
        if finish:
            _fill(times, target, _on_base(times, height, speed, finish[0] - _PUSH), finish)
    return target


State = tuple[float, float, float, float]  # time, height, speed, acceleration


def _landing(flight: tuple[float, float, float]) -> State:
    start, end, level = flight
    return end, level, -0.5 * GRAVITY * (end - start), -GRAVITY


def _leaving(flight: tuple[float, float, float]) -> State:
    start, end, level = flight
    return start, level, 0.5 * GRAVITY * (end - start), -GRAVITY


def _on_base(times: NDArray[np.float64], height: NDArray[np.float64], speed: NDArray[np.float64], at: float) -> State:
    return at, float(np.interp(at, times, height)), float(np.interp(at, times, speed)), 0.0


def _extra(plan: Plan, landing: float) -> float:
    """The height above standing of the flight that ends at ``landing``."""
    return min(plan.takeoffs, key=lambda takeoff: abs(takeoff[0] - landing))[1]


def _fill(times: NDArray[np.float64], target: NDArray[np.float64], start: State, end: State) -> None:
    inside = (times > start[0]) & (times < end[0])
    target[inside] = quintic(start, end, times[inside])
