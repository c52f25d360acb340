"""Phrases of walking and running from which clips are put together: start, go on, turn, stop."""

import math
from typing import NamedTuple

from footwork.training.embedded.footsteps import RUN, SHUFFLE, Planner


class Pace(NamedTuple):
    """Seconds and metres a step."""

    seconds: float
    ahead: float


# speed 1.1, 1.35 and 1.6 m/s at 109, 115 and 122 steps a minute, and a run at 2.5 and 3.1 m/s
SLOW, NORMAL, FAST = Pace(0.55, 0.60), Pace(0.52, 0.70), Pace(0.49, 0.79)
JOG, SPRINT = Pace(0.36, 0.90), Pace(0.34, 1.05)


def other(foot: int) -> int:
    """The other foot."""
    return 1 - foot


def start_walk(planner: Planner, foot: int, pace: Pace = NORMAL) -> int:
    """The first step from standing, with ``foot``; returns the foot to go on with."""
    planner.step(foot, 0.6, 0.5 * pace.ahead, swing=0.42)
    return other(foot)


def walk(planner: Planner, foot: int, steps: int, pace: Pace = NORMAL, turn: float = 0.0, label: str = "walk") -> int:
    """Steps at a pace, each turning the heading by ``turn`` degrees; returns the foot to go on with."""
    for _ in range(steps):
        planner.step(foot, *pace, turn=math.radians(turn), label=label)
        foot = other(foot)
    return foot


def stop_walk(planner: Planner, foot: int, pace: Pace = NORMAL) -> None:
    """A shorter step and the other foot beside it."""
    planner.step(foot, pace.seconds, 0.75 * pace.ahead)
    planner.step(other(foot), 0.55, 0.15 * pace.ahead, gait=SHUFFLE, swing=0.42)


def start_run(planner: Planner, foot: int) -> int:
    """Two quickening steps from standing into a run."""
    planner.step(foot, 0.44, 0.38, swing=0.36)
    planner.step(other(foot), 0.38, 0.70, swing=0.36, label="run")
    return foot


def quicken(planner: Planner, foot: int) -> int:
    """One step from a walk into a run."""
    planner.step(foot, 0.44, 0.85, swing=0.38)
    return other(foot)


def run(planner: Planner, foot: int, steps: int, pace: Pace = SPRINT, turn: float = 0.0) -> int:
    """Running steps, each turning by ``turn`` degrees; returns the foot to go on with."""
    for _ in range(steps):
        planner.step(foot, *pace, turn=math.radians(turn), gait=RUN, label="run")
        foot = other(foot)
    return foot


def slow_down(planner: Planner, foot: int) -> int:
    """Two steps from a run into a walk."""
    planner.step(foot, 0.40, 0.82, swing=0.42, label="run")
    planner.step(other(foot), 0.47, 0.74)
    return foot


def stop_run(planner: Planner, foot: int) -> None:
    """A braking step from a run, and the other foot beside it."""
    planner.step(foot, 0.38, 0.66, swing=0.40, label="run")
    planner.step(other(foot), 0.46, 0.16, gait=SHUFFLE, swing=0.40)


def turn_on_the_spot(planner: Planner, foot: int, steps: int, turn: float) -> None:
    """Small steps on the spot that turn by ``turn`` degrees in all, the inner ``foot`` first."""
    for _ in range(steps):
        planner.step(foot, 0.44, turn=math.radians(turn / steps), gait=SHUFFLE, swing=0.38, label="turn")
        foot = other(foot)
