"""What a controller costs at run time: microseconds for each character and tick."""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.motion.asked import asked_of, going_on, spawn_behaviour
from footwork.motion.moves import no_moves
from footwork.motion.trace import Trace
from footwork.study.showing import Showing

CHARACTERS = 256
TICKS = 300
_FIRST = 30  # ticks that are not counted: all characters begin alike


def times_of(microseconds: NDArray) -> dict[str, float]:
    """Mean, median and 99th percentile."""
    p50, p99 = np.percentile(microseconds, [50, 99])
    return {"mean": float(microseconds.mean()), "p50": float(p50), "p99": float(p99)}


def pace(
    traces: Sequence[Trace],
    controller: Controller,
    showing: Showing | None = None,
    characters: int = CHARACTERS,
    ticks: int = TICKS,
) -> dict[str, Any]:
    """Many characters in one world, each somewhere else in the traces, evenly; microseconds a character and tick.

    ``decision_us`` is the controller's choice, ``tick_us`` choice, step and show; percentiles are over ticks.

    Args:
        traces: the players, played one after the other without end.
        controller: what chooses moves for all of them.
        showing: what is done to poses.
        characters: how many.
        ticks: how many are timed.

    Raises:
        InputError: as ``asked_of``.
    """
    heading, asked = _endless(traces, controller)
    world = (showing or Showing()).world(controller.graph, characters)
    at = np.linspace(0, len(heading), characters, endpoint=False).astype(int)
    start = controller.start_node(spawn_behaviour(controller.present))
    for place in at:
        controller.begin(world.spawn(start, 0.0, 0.0, float(heading[place])))
    moves, slots, clock = no_moves(characters), np.arange(characters), time.perf_counter_ns
    decision, whole = (np.empty(_FIRST + ticks) for _ in range(2))
    for tick in range(_FIRST + ticks):
        now = (at + tick) % len(heading)
        wanted, behaviour = heading[now], asked[now]
        began = clock()
        controller.choose(Situations(slots, world.node, world.place, wanted, behaviour), moves)
        chosen = clock()
        world.step(moves)
        world.show(1.0)
        whole[tick], decision[tick] = clock() - began, chosen - began
    scale = 1e3 * characters
    return {
        "characters": characters,
        "decision_us": times_of(decision[_FIRST:] / scale),
        "tick_us": times_of(whole[_FIRST:] / scale),
    }


def _endless(traces: Sequence[Trace], controller: Controller) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Headings and askable behaviours of all traces, one after the other.  # (K,), (K,)"""
    first = controller.graph.behaviours.index(spawn_behaviour(controller.present))
    parts = [asked_of(trace, controller.graph, controller.present) for trace in traces]
    heading = np.concatenate([commands.heading for commands, _ in parts])
    return heading, going_on(np.concatenate([asked for _, asked in parts]), first)
