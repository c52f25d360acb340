"""How well a character keeps the speeds it is asked for, and how soon it comes to them.

Characters begin at many frames of a behaviour, go straight on, and are asked for one speed.
"""

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations
from footwork.controllers.steering import SteeringController
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.tick import TICK, TICK_RATE
from footwork.runtime.world import World
from footwork.study.measures import Answers
from footwork.study.responsiveness import starts_of

SECONDS = 10.0
"""How long each is asked for."""
SETTLED = 5.0
"""Seconds after which what is kept counts; a speed that is not come to sooner counts as not answered."""
STRIDE = 15
"""Ticks that a speed is the mean of."""
NEAR = 0.1
"""The part of the speed asked for, or of 1 m/s where that is slower, within which it is come to."""


def speed_response(graph: MotionGraph, controller: SteeringController) -> dict[str, list[dict[str, Any]]]:
    """For each behaviour that can be asked for at a speed: what comes of its levels and of the speeds midway.

    ``reached_m_s`` is the mean speed once settled, and ``spread_m_s`` the standard deviation over half seconds;
    ``mean_s`` and ``p95_s`` are the seconds until half a second is near the speed asked for, those not answered
    counting as SETTLED.

    Args:
        graph: where characters are.
        controller: what is asked.
    """
    levels = controller.table.task.speeds
    return {
        name: [_summary(graph, controller, name, speed) for speed in with_midways(levels[name])]
        for name in controller.speeds
    }


def with_midways(levels: tuple[float, ...]) -> list[float]:
    """Rising levels and the speeds half-way between two."""
    midways = [0.5 * (low + high) for low, high in pairwise(levels)]
    return sorted([*levels, *midways])


def _summary(graph: MotionGraph, controller: SteeringController, behaviour: str, speed: float) -> dict[str, Any]:
    speeds = speeds_kept(graph, controller, behaviour, speed)
    settled = speeds[round(SETTLED * TICK_RATE) :]
    summary = _come_to(speeds, speed).summary()
    return {
        "asked_m_s": speed,
        "reached_m_s": float(settled.mean()),
        "spread_m_s": float(settled.std()),
        "mean_s": summary["mean"],
        "p95_s": summary["p95"],
        "answered_share": _come_to(speeds, speed).share,
    }


def _come_to(speeds: NDArray[np.float64], asked: float) -> Answers:
    limit = round(SETTLED * TICK_RATE)
    near = np.abs(speeds[:limit] - asked) <= NEAR * max(asked, 1.0)
    answered = np.any(near, axis=0)
    return Answers(np.where(answered, near.argmax(axis=0) + 1, limit) * TICK, answered)


def speeds_kept(
    graph: MotionGraph, controller: SteeringController, behaviour: str, speed: float
) -> NDArray[np.float64]:
    """The mean speed over the half second up to each tick, m/s, of characters that are asked for one.  # (K, C)

    In the first half second it is that since the beginning.
    """
    places = _ways(graph, controller, behaviour, speed)
    before = np.maximum(np.arange(1, len(places)) - STRIDE, 0)
    ticks = np.arange(1, len(places)) - before
    return np.linalg.norm(places[1:] - places[before], axis=-1) * TICK_RATE / ticks[:, None]


def _ways(graph: MotionGraph, controller: SteeringController, behaviour: str, speed: float) -> NDArray[np.float64]:
    """Where characters are at the beginning and after each tick.  # (K + 1, C, 2)"""
    starts = starts_of(graph, behaviour)
    count, index = len(starts), graph.behaviours.index(behaviour)
    world = World(graph, count, inertialise=False, foot_lock=False)
    for node in starts:
        controller.begin(world.spawn(int(node), 0.0, 0.0, 0.0))
    moves, slots = no_moves(count), np.arange(count)
    heading, asked, wanted = np.zeros(count), np.full(count, index, np.int32), np.full(count, speed)
    places = [world.place[:, :2].copy()]
    for _ in range(round(SECONDS * TICK_RATE)):
        controller.choose(Situations(slots, world.node, world.place, heading, asked, wanted), moves)
        world.step(moves)
        places.append(world.place[:, :2].copy())
    return np.array(places)
