"""What a trace asks of a character that can do only some of it."""

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.task import BEHAVIOURS
from footwork.motion.trace import SteeringCommands, Trace, steering_commands

UNANSWERABLE = -1
"""In place of the behaviour asked for: one that no frame shows."""


def askable(behaviour: NDArray[np.int32], numbered: Sequence[str], present: Collection[str]) -> NDArray[np.int32]:
    """What to ask of a character at each tick, where not every behaviour asked for can be shown.

    It goes on with what it was last asked for and can show; at first it stops, or does the first it can.

    Args:
        behaviour: what the player asks for, an index into ``task.BEHAVIOURS``.  # (K,)
        numbered: the behaviours that the result numbers, as of ``MotionGraph.behaviours``.
        present: those that can be shown, one at least.

    Returns:
        An index into ``numbered`` for each tick.  # (K,)
    """
    first = spawn_behaviour(tuple(name for name in numbered if name in present))
    return going_on(_numbered(behaviour, numbered, present), numbered.index(first))


def asked_of(trace: Trace, graph: MotionGraph, present: tuple[str, ...]) -> tuple[SteeringCommands, NDArray[np.int32]]:
    """The commands of a trace, and each tick's behaviour as an index into the graph's, UNANSWERABLE for none.  # (K,)

    Raises:
        InputError: where nothing can be asked for.
    """
    if not present:
        raise InputError("no frame shows any behaviour, expected at least one", graph.where)
    commands = steering_commands(trace, 0.0, present)
    asked = _numbered(commands.behaviour, graph.behaviours, present)
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


def _numbered(behaviour: NDArray[np.int32], numbered: Sequence[str], present: Collection[str]) -> NDArray[np.int32]:
    """Indices into ``task.BEHAVIOURS`` as indices into ``numbered``, UNANSWERABLE for what is not present.  # (K,)"""
    index = [numbered.index(name) if name in present else UNANSWERABLE for name in BEHAVIOURS]
    return np.array(index, np.int32)[behaviour]
