"""The embedded clips for fighting: a guard with steps, and strikes and evasions out of it.

Labels are those of a state-annotated graph: locomotion, attack, evade. Every clip begins and ends in the guard.
"""

import math
from collections.abc import Callable
from functools import cache

from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.training.embedded import strikes
from footwork.training.embedded.figure import animate
from footwork.training.embedded.footsteps import GUARD_STEP, LEFT, RIGHT, Planner
from footwork.training.embedded.strikes import Move

# left and right foot beside the path: left, ahead, yaw
_HOMES = ((0.10, 0.26, math.radians(-6)), (-0.12, -0.13, math.radians(-52)))
_MOVING, _ATTACK, _EVADE = "locomotion", "attack", "evade"
_REST = 0.4
Written = tuple[Planner, list[tuple[float, Move]]]


def fighting_clips() -> list[Clip]:
    """The clips for fighting, at 30 Hz on the common body, labelled, with the contacts they were planned with."""
    return list(_animated())


@cache
def _animated() -> tuple[Clip, ...]:
    """They take a second to make, and are asked for again and again."""
    body = default_body()
    clips = []
    for name, write in _clips().items():
        planner, moves = write()
        clips.append(animate(name, planner.plan(), body, strikes.gesture_of(moves, planner.now)))
    return tuple(clips)


def _clips() -> dict[str, Callable[[], Written]]:
    return {
        "guard": lambda: (_planner().stand(3.2, _MOVING), []),
        "guard_forward": lambda: _steps(LEFT, 0.30, 0.0),
        "guard_back": lambda: _steps(RIGHT, -0.30, 0.0),
        "guard_left": lambda: _steps(LEFT, 0.0, 0.28),
        "guard_right": lambda: _steps(RIGHT, 0.0, -0.28),
        "guard_circle_left": lambda: _steps(LEFT, 0.05, 0.26, -20.0),
        "guard_circle_right": lambda: _steps(RIGHT, 0.05, -0.26, 20.0),
        "jab": lambda: _standing(_ATTACK, strikes.jab()),
        "cross": lambda: _standing(_ATTACK, strikes.cross()),
        "jab_cross": _jab_cross,
        "jab_step": _jab_step,
        "front_kick": _front_kick,
        "block": lambda: _standing(_EVADE, strikes.block()),
        "duck": lambda: _standing(_EVADE, strikes.duck()),
        "step_back": _step_back,
    }


def _planner() -> Planner:
    return Planner(homes=_HOMES, smoothing=0.3)


def _pair(planner: Planner, first: int, ahead: float, left: float, turn: float = 0.0, label: str = _MOVING) -> None:
    """The foot on the side of the way steps, the other one follows."""
    for foot, seconds in ((first, 0.28), (1 - first, 0.26)):
        planner.step(
            foot, seconds, 0.5 * ahead, 0.5 * left, math.radians(0.5 * turn), GUARD_STEP, swing=0.22, label=label
        )


def _steps(first: int, ahead: float, left: float, turn: float = 0.0) -> Written:
    planner = _planner().stand(_REST, _MOVING)
    for _ in range(2):
        _pair(planner, first, ahead, left, turn)
        planner.stand(0.12, _MOVING)
    return planner.stand(_REST, _MOVING), []


def _standing(label: str, timed: tuple[Move, float]) -> Written:
    move, seconds = timed
    planner = _planner().stand(_REST, _MOVING)
    start = planner.now
    return planner.stand(seconds, label).stand(_REST, _MOVING), [(start, move)]


def _jab_cross() -> Written:
    planner = _planner().stand(_REST, _MOVING)
    start, (cross, seconds) = planner.now, strikes.cross()
    # the right fist leaves while the left one comes back
    moves = [(start, strikes.jab()[0]), (start + 0.34, cross)]
    return planner.stand(0.34 + seconds, _ATTACK).stand(_REST, _MOVING), moves


def _jab_step() -> Written:
    planner = _planner().stand(_REST, _MOVING)
    start = planner.now
    _pair(planner, LEFT, 0.32, 0.0, label=_ATTACK)
    return planner.stand(0.12, _ATTACK).stand(_REST, _MOVING), [(start, strikes.jab()[0])]


def _front_kick() -> Written:
    move, seconds = strikes.front_kick()
    planner = _planner().stand(_REST, _MOVING)
    start = planner.now
    planner.swing(RIGHT, start + 0.14, start + 0.86, GUARD_STEP)
    return planner.stand(seconds, _ATTACK).stand(_REST, _MOVING), [(start, move)]


def _step_back() -> Written:
    planner = _planner().stand(_REST, _MOVING)
    start = planner.now
    _pair(planner, RIGHT, -0.42, 0.0, label=_EVADE)
    return planner.stand(0.25, _EVADE).stand(_REST, _MOVING), [(start, strikes.sway_back()[0])]
