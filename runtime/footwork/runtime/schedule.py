"""Commands with the ticks that they are for, as an array that kernels read."""

import math
from collections.abc import Iterable, Iterator
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import Command
from footwork.errors import InputError
from footwork.runtime.recording import LONGEST_GAP

Schedule = NDArray[np.float64]
"""K commands in the order in which they come into force: before which tick of a run, from 0; whose, a slot; heading,
radians; behaviour; one-shot behaviour; speed, m/s, ANY_SPEED where any will do. One array, since each that is handed to
a kernel costs as much as what the kernel does with it.  # (K, 6)"""
_COLUMNS = 6


def schedule_of(given: Iterable[tuple[int, int, Command]]) -> Schedule:
    """A schedule of (tick, slot, command), those of one tick in the order given."""
    ordered = sorted(given, key=itemgetter(0))
    rows = [
        (tick, slot, command.heading, command.behaviour, command.one_shot, command.asked_speed)
        for tick, slot, command in ordered
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, _COLUMNS)


def commands_in(schedule: Schedule) -> Iterator[tuple[int, int, float, int, int, float]]:
    """The commands one by one: tick, slot, heading, behaviour, one-shot behaviour and speed."""
    for tick, slot, heading, behaviour, one_shot, speed in schedule.tolist():
        yield int(tick), int(slot), heading, int(behaviour), int(one_shot), speed


def require_within(ticks: int, given: Iterable[tuple[int, int, Command]]) -> None:
    """Refuse a run that is too long to be recorded, and commands (tick, slot, command) that are not for its ticks.

    Raises:
        InputError: for such.
    """
    if not 0 <= ticks <= LONGEST_GAP:
        raise InputError(f"{ticks} ticks, expected 0 to {LONGEST_GAP}", "resimulate")
    for tick, slot, _ in given:
        if not 0 <= tick < ticks:
            raise InputError(f"a command to {slot} before tick {tick}, expected 0 to {ticks - 1}", "resimulate")


def rows_of(schedule: Schedule) -> tuple[tuple, ...]:
    """The commands one by one, with None in place of ANY_SPEED."""
    return tuple((*whole, None if math.isnan(speed) else speed) for *whole, speed in commands_in(schedule))


NOTHING = schedule_of(())
