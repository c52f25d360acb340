"""Flights: while no foot stands, the centre of mass flies a parabola, whatever the limbs do.

Before and after a flight the centre of mass runs along fifth-degree curves that have the flight's speed and
acceleration at its ends, so that the force of the ground grows from nothing and ends in nothing. A flight itself is
such a curve too: with gravity at both ends it is the parabola.
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
    """The root (F, 3), moved so that the centre of mass flies a parabola in every flight.

    ``pose`` gives the local rotations for a root: the feet stay where they are, so moving the root bends the legs,
    which moves the centre of mass in turn; a few rounds settle it.
    """
    flights = plan.flights()
    if not flights:
        return root
    centre = centre_of_mass(body, root, pose(root))
    target = np.stack([_target(plan, _along(plan, flights, centre, axis), centre[:, axis]) for axis in range(3)], -1)
    root = root.copy()
    for _ in range(_ROUNDS):
        root += target - centre_of_mass(body, root, pose(root))
    return root


State = tuple[float, float, float, float]  # time, place, speed, acceleration: along one axis


def _along(
    plan: Plan, flights: list[tuple[float, float]], centre: NDArray[np.float64], axis: int
) -> list[tuple[State, State]]:
    """Each flight's start and end along one axis: level ends and gravity upright, even speed on the ground."""
    states = []
    for start, end in flights:
        if axis == 1:
            level, speed = centre[0, 1] + _extra(plan, end), 0.5 * GRAVITY * (end - start)
            states.append(((start, level, speed, -GRAVITY), (end, level, -speed, -GRAVITY)))
        else:
            first, last = np.interp([start, end], plan.times, centre[:, axis])
            speed = (last - first) / (end - start)
            states.append(((start, first, speed, 0.0), (end, last, speed, 0.0)))
    return states


def _target(plan: Plan, flights: list[tuple[State, State]], base: NDArray[np.float64]) -> NDArray[np.float64]:
    """``base`` (F,) with the flights in it, and smooth ways into and out of them."""
    times, target = plan.times, base.copy()
    speed = np.gradient(base, 1.0 / FPS)

    def on_base(at: float) -> State:
        return at, float(np.interp(at, times, base)), float(np.interp(at, times, speed)), 0.0

    for takeoff, landing in flights:
        _fill(times, target, takeoff, landing)
    for before, after in zip([None, *flights], [*flights, None], strict=True):
        if before and after and after[0][0] - before[1][0] < _PUSH + _ABSORB:
            _fill(times, target, before[1], after[0])
            continue
        if before:
            _fill(times, target, before[1], on_base(before[1][0] + _ABSORB))
        if after:
            _fill(times, target, on_base(after[0][0] - _PUSH), after[0])
    return target


def _extra(plan: Plan, landing: float) -> float:
    """The height above standing of the flight that ends at ``landing``."""
    return min(plan.takeoffs, key=lambda takeoff: abs(takeoff[0] - landing))[1]


def _fill(times: NDArray[np.float64], target: NDArray[np.float64], start: State, end: State) -> None:
    inside = (times >= start[0]) & (times <= end[0])
    target[inside] = quintic(start, end, times[inside])
