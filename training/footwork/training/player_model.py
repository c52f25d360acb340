"""Learning a player model from recorded players: how often they change their mind, and to what (conventions.md 5)."""

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.angle import wrapped
from footwork.motion.asked import askable
from footwork.motion.player_model import PlayerModel, TraceFile
from footwork.motion.task import SteeringTask
from footwork.motion.trace import Trace, steering_commands

ADDED_CHANGES = 1.0
"""Changes of mind added to those seen after each behaviour, spread evenly over all commands with a behaviour that was
asked for, so that none of them is impossible; one among hundreds does not drown what was seen."""
_UNTURNED = 1e-9


def learned(traces: Sequence[Trace], task: SteeringTask, present: Collection[str]) -> PlayerModel:
    """The player model of recorded players, over the behaviours and headings of a task.

    Of each behaviour asked for: the hazard of a change in a tick, and a histogram over the behaviour and the jump of
    the heading that a change leads to. A jump between two bins counts for both, in proportion, so that the mean turn
    is kept. A behaviour that is never asked for does not come, and where it is asked for all the same it stays.

    Args:
        traces: the recordings, with the digests of their files.
        task: the behaviours and headings of the model.
        present: the behaviours that the graph shows; the others are not asked of a character.

    Raises:
        InputError: for no traces, or no behaviour present.
    """
    if not traces:
        raise InputError("no traces, expected at least one", "player model")
    if not set(present) & set(task.behaviours):
        raise InputError("no frame shows any behaviour, expected at least one", "player model")
    counted = [_counted(trace, task, present) for trace in traces]
    changed, unchanged = (np.sum(part, axis=0) for part in zip(*counted, strict=True))
    files = tuple(TraceFile(trace.name, trace.digest) for trace in traces)
    return PlayerModel(task.behaviours, _probabilities(changed, unchanged), files)


def _counted(
    trace: Trace, task: SteeringTask, present: Collection[str]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Changes by behaviour before, behaviour after and jump, and ticks without a change.  # (B, B, H), (B,)"""
    commands = steering_commands(trace, 0.0, present)
    asked = askable(commands.behaviour, task.behaviours, present)
    jump = wrapped(np.diff(commands.heading))
    before, after = asked[:-1], asked[1:]
    moved = (before != after) | (np.abs(jump) > _UNTURNED)
    count, bins = len(task.behaviours), task.heading_bins
    place = jump[moved] * (bins / (2.0 * np.pi))
    low = np.floor(place)
    changed = np.zeros((count, count, bins))
    for whole, share in ((low, 1.0 - (place - low)), (low + 1.0, place - low)):
        np.add.at(changed, (before[moved], after[moved], whole.astype(np.intp) % bins), share)
    return changed, np.bincount(before[~moved], minlength=count).astype(np.float64)


def _probabilities(changed: NDArray[np.float64], unchanged: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rows of probabilities from counts.  # (B, B, H)"""
    changes = changed.sum(axis=(1, 2))
    hazard = changes / np.maximum(changes + unchanged, 1.0)
    asked = (changes + unchanged + changed.sum(axis=(0, 2))) > 0.0
    added = ADDED_CHANGES * asked[:, None] / (np.count_nonzero(asked) * changed.shape[2])
    histogram = (changed + added) / (changes + ADDED_CHANGES)[:, None, None]
    change = hazard[:, None, None] * histogram
    own = np.arange(len(changed))
    change[own, own, 0] += 1.0 - hazard
    return change
