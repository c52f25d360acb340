"""Commands with the ticks that they are for, as arrays that kernels read."""

import math
from collections.abc import Iterable
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import Command
from footwork.errors import InputError
from footwork.runtime.recording import LONGEST_GAP


class Schedule(NamedTuple):
    """K commands in the order in which they come into force.

    Args:
        tick: before which tick of a run, from 0.  # (K,) int64
        slot: whose.  # (K,) int64
        heading: of the commands, radians.  # (K,) float64
        behaviour: of the commands.  # (K,) int64
        one_shot: of the commands.  # (K,) int64
        speed: of the commands, m/s, ANY_SPEED where any will do.  # (K,) float64
    """

    tick: NDArray[np.int64]
    slot: NDArray[np.int64]
    heading: NDArray[np.float64]
    behaviour: NDArray[np.int64]
    one_shot: NDArray[np.int64]
    speed: NDArray[np.float64]


_KINDS = (np.int64, np.int64, np.float64, np.int64, np.int64, np.float64)
_ROW = np.dtype(list(zip(Schedule._fields, _KINDS, strict=True)))


def schedule_of(given: Iterable[tuple[int, int, Command]]) -> Schedule:
    """A schedule of (tick, slot, command), those of one tick in the order given."""
    ordered = sorted(given, key=itemgetter(0))
    rows = [
        (tick, slot, command.heading, command.behaviour, command.one_shot, command.asked_speed)
        for tick, slot, command in ordered
    ]
    table = np.array(rows, dtype=_ROW)
    return Schedule(*(table[name] for name in Schedule._fields))


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
    rows = zip(*(column.tolist() for column in schedule), strict=True)
    return tuple((*whole, None if math.isnan(speed) else speed) for *whole, speed in rows)


NOTHING = schedule_of(())
