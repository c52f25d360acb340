"""What a trace asks of a character that can do only some of it."""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.task import BEHAVIOURS
from footwork.motion.trace import SteeringCommands, Trace, steering_commands

UNANSWERABLE = -1
"""In place of the behaviour asked for: one that no frame shows."""


def asked_of(trace: Trace, graph: MotionGraph, present: tuple[str, ...]) -> tuple[SteeringCommands, NDArray[np.int32]]:
    """The commands of a trace, and each tick's behaviour as an index into the graph's, UNANSWERABLE for none.  # (K,)

    Raises:
        InputError: where nothing can be asked for.
    """
    if not present:
        raise InputError("no frame shows any behaviour, expected at least one", graph.where)
    commands = steering_commands(trace, 0.0, present)
    index = [graph.behaviours.index(name) if name in present else UNANSWERABLE for name in BEHAVIOURS]
    asked = np.array(index, np.int32)[commands.behaviour]
    if (asked == UNANSWERABLE).all():
        wanted = ", ".join(sorted({BEHAVIOURS[number] for number in commands.behaviour}))
        raise InputError(f"asks only for {wanted}; the frames show {', '.join(present)}", trace.name)
    return commands, asked


def going_on(asked: NDArray[np.int32], first: int) -> NDArray[np.int32]:
    """What a controller is asked for: at ticks that no frame can answer what it was asked for before.  # (K,)"""
    known = np.maximum.accumulate(np.where(asked != UNANSWERABLE, np.arange(1, len(asked) + 1), 0))
    return np.concatenate([[first], asked])[known].astype(np.int32)


def spawn_behaviour(present: tuple[str, ...]) -> str:
    """What characters do when they are spawned: they stand, where some frame shows it."""
    return "stop" if "stop" in present else present[0]
