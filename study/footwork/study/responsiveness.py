"""How soon a character can do what it is told: from many frames at once, one new command, time until it is done."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.motion.angle import wrapped
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.task import HEADED, ONE_SHOT
from footwork.motion.tick import TICK
from footwork.runtime.world import World
from footwork.study.measures import STEP, Answers

SAMPLES = 64
PATIENCE = 5.0
"""Seconds after which a command counts as not answered."""


def evenly(nodes: NDArray, count: int = SAMPLES) -> NDArray[np.int32]:
    """Up to ``count`` of the nodes, evenly spread."""
    return nodes[np.linspace(0, len(nodes) - 1, min(count, len(nodes))).astype(int)].astype(np.int32)


def turn_times(graph: MotionGraph, controller: Controller, behaviour: str, radians: float) -> Answers:
    """Time to turn by ``radians`` (positive left) to within 15 degrees, from frames of ``behaviour``, doing it on."""
    index = graph.behaviours.index(behaviour)
    starts = evenly(np.flatnonzero(graph.behaviour == index))

    def done(world: World) -> NDArray[np.bool_]:
        return np.abs(wrapped(radians - world.place[:, 2])) <= STEP

    return _until(graph, controller, starts, radians, index, done)


def change_times(graph: MotionGraph, controller: Controller, before: str, after: str) -> Answers:
    """Time until a frame of ``after`` is shown, from frames of ``before``, going straight on."""
    index = graph.behaviours.index(after)
    starts = evenly(np.flatnonzero(graph.behaviour == graph.behaviours.index(before)))
    return _until(graph, controller, starts, 0.0, index, lambda world: graph.behaviour[world.node] == index)


def responsiveness(graph: MotionGraph, controller: Controller) -> dict[str, dict[str, dict[str, float | None]]]:
    """Mean and 95th percentile of the seconds that turns and changes of behaviour take, and the share answered.

    ``turns`` has 90 degrees left and right and 180 for each behaviour that has a heading; ``changes`` has each
    pair of behaviours that the graph shows. Times of what was not answered count as PATIENCE.
    """
    headed = [name for name in controller.present if name in HEADED]
    turns = {
        f"{name} {degrees:+d}": _summary(turn_times(graph, controller, name, np.radians(degrees)))
        for name in headed
        for degrees in (90, -90, 180)
    }
    lasting = [name for name in controller.present if name not in ONE_SHOT]
    changes = {
        f"{before} to {after}": _summary(change_times(graph, controller, before, after))
        for before in lasting
        for after in controller.present
        if before != after
    }
    return {"turns": turns, "changes": changes}


def _summary(answers: Answers) -> dict[str, float | None]:
    summary = answers.summary()
    return {"mean_s": summary["mean"], "p95_s": summary["p95"], "answered_share": answers.share}


def _until(
    graph: MotionGraph,
    controller: Controller,
    starts: NDArray[np.int32],
    heading: float,
    behaviour: int,
    done: Callable[[World], NDArray[np.bool_]],
) -> Answers:
    count = len(starts)
    world = World(graph, count, inertialise=False)
    for node in starts:
        controller.begin(world.spawn(int(node), 0.0, 0.0, 0.0))
    moves, slots = no_moves(count), np.arange(count)
    wanted, asked = np.full(count, heading), np.full(count, behaviour, np.int32)
    ticks = round(PATIENCE / TICK)
    taken = np.full(count, ticks)
    for tick in range(ticks):
        controller.choose(Situations(slots, world.node, world.place, wanted, asked), moves)
        world.step(moves)
        taken[done(world) & (taken == ticks)] = tick
        if (taken < ticks).all():
            break
    answered = taken < ticks
    return Answers(np.where(answered, taken + 1, ticks) * TICK, answered)
