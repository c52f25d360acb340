"""How soon a character does what it is told: from many frames at once, one new command, time until it is done.

Beside each time stands the shortest that the graph allows from the same frames (``shortest_times``).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations, headed_of, one_shots_of
from footwork.motion.angle import wrapped
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.tick import TICK
from footwork.runtime.world import World
from footwork.study.breadth_first import UNREACHED
from footwork.study.measures import STEP, Answers
from footwork.study.shortest_times import ticks_to_behaviour, ticks_to_turn

SAMPLES = 64
PATIENCE = 5.0
"""Seconds after which a command counts as not answered."""
TURNS = (45, 90, 135, 180)
"""Degrees; each to both sides but the last."""
_TICKS = round(PATIENCE / TICK)


def evenly(nodes: NDArray, count: int = SAMPLES) -> NDArray[np.int32]:
    """Up to ``count`` of the nodes, evenly spread."""
    return nodes[np.linspace(0, len(nodes) - 1, min(count, len(nodes))).astype(int)].astype(np.int32)


def turn_times(graph: MotionGraph, controller: Controller, behaviour: str, radians: float) -> Answers:
    """Time to turn by ``radians`` (positive left) to within 15 degrees, from frames of ``behaviour``, doing it on."""
    index = graph.behaviours.index(behaviour)

    def done(world: World) -> NDArray[np.bool_]:
        faces = np.abs(wrapped(radians - world.place[:, 2])) <= STEP
        return faces & (graph.behaviour[world.node] == index)

    return _until(graph, controller, starts_of(graph, behaviour), radians, index, done)


def change_times(graph: MotionGraph, controller: Controller, before: str, after: str) -> Answers:
    """Time until a frame of ``after`` is shown, from frames of ``before``, going straight on."""
    index = graph.behaviours.index(after)
    return _until(
        graph, controller, starts_of(graph, before), 0.0, index, lambda world: graph.behaviour[world.node] == index
    )


def starts_of(graph: MotionGraph, behaviour: str) -> NDArray[np.int32]:
    """The frames of a behaviour that commands are given at."""
    return evenly(np.flatnonzero(graph.behaviour == graph.behaviours.index(behaviour)))


def responsiveness(
    graph: MotionGraph, controller: Controller, turn_limit: NDArray | None = None
) -> dict[str, dict[str, dict[str, float | None]]]:
    """Mean and 95th percentile of the seconds that turns and changes of behaviour take, and the share answered.

    ``turns`` has 45, 90 and 135 degrees left and right and 180 for each behaviour that has a heading; ``changes`` has
    each pair of behaviours that the graph shows. Times of what was not answered count as PATIENCE. ``shortest_s`` is
    the mean of the shortest times from the same frames.

    Args:
        graph: where characters are.
        controller: what is asked.
        turn_limit: the largest extra turn on arriving at each node, radians; none where not given.  # (N,)
    """
    limit = np.zeros(graph.node_count) if turn_limit is None else turn_limit
    headed = [name for name in controller.present if name in headed_of(controller)]
    sides = [degrees for turn in TURNS for degrees in ((turn, -turn) if turn < 180 else (turn,))]
    turns = {
        f"{name} {degrees:+d}": _turned(graph, controller, name, np.radians(degrees), limit)
        for name in headed
        for degrees in sides
    }
    lasting = [name for name in controller.present if name not in one_shots_of(controller)]
    changes = {
        f"{before} to {after}": _changed(graph, controller, before, after)
        for before in lasting
        for after in controller.present
        if before != after
    }
    return {"turns": turns, "changes": changes}


def _turned(
    graph: MotionGraph, controller: Controller, behaviour: str, radians: float, limit: NDArray
) -> dict[str, float | None]:
    index = graph.behaviours.index(behaviour)
    shortest = ticks_to_turn(graph, index, radians, STEP, limit, _TICKS)
    answers = turn_times(graph, controller, behaviour, radians)
    return _summary(answers, shortest[starts_of(graph, behaviour)])


def _changed(graph: MotionGraph, controller: Controller, before: str, after: str) -> dict[str, float | None]:
    shortest = ticks_to_behaviour(graph, graph.behaviours.index(after))
    answers = change_times(graph, controller, before, after)
    return _summary(answers, shortest[starts_of(graph, before)])


def _summary(answers: Answers, shortest: NDArray[np.int32]) -> dict[str, float | None]:
    summary = answers.summary()
    ticks = np.where(shortest == UNREACHED, _TICKS, np.minimum(shortest, _TICKS))
    return {
        "mean_s": summary["mean"],
        "p95_s": summary["p95"],
        "answered_share": answers.share,
        "shortest_s": float(ticks.mean() * TICK),
    }


def _until(
    graph: MotionGraph,
    controller: Controller,
    starts: NDArray[np.int32],
    heading: float,
    behaviour: int,
    done: Callable[[World], NDArray[np.bool_]],
) -> Answers:
    count = len(starts)
    world = World(graph, count, inertialise=False, foot_lock=False)
    for node in starts:
        controller.begin(world.spawn(int(node), 0.0, 0.0, 0.0))
    moves, slots = no_moves(count), np.arange(count)
    wanted, asked = np.full(count, heading), np.full(count, behaviour, np.int32)
    taken = np.full(count, _TICKS)
    for tick in range(_TICKS):
        controller.choose(Situations(slots, world.node, world.place, wanted, asked), moves)
        world.step(moves)
        taken[done(world) & (taken == _TICKS)] = tick
        if (taken < _TICKS).all():
            break
    answered = taken < _TICKS
    return Answers(np.where(answered, taken + 1, _TICKS) * TICK, answered)
