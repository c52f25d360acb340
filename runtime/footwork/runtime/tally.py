"""What is counted of a match, and the list of what happened in it."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

BEGUN, HIT, MISSED, EVADING, ROUND = 0, 1, 2, 3, 4
EVENTS = ("attack", "hit", "miss", "evade", "round")
"""Kinds of events by number."""
NOBODY = -1


COUNTS = np.dtype(
    [
        ("shadow_ticks", "i8"),  # spent in each activity
        ("attack_ticks", "i8"),
        ("evade_ticks", "i8"),
        ("decisions", "i8"),  # made
        ("forced_ticks", "i8"),  # after decisions that left no choice: nothing reasonable, and one way on
        ("attacks", "i8"),  # begun
        ("strikes", "i8"),  # that came to their contact
        ("hits", "i8"),  # of those, the ones that landed
        ("evades", "i8"),  # begun
        ("evaded", "i8"),  # strikes of the opponent that missed while the fighter was evading
        ("rounds", "i8"),  # won
        ("dealt", "f8"),  # damage
    ]
)
CLOCK = np.dtype([("round_ticks", "i8"), ("rounds", "i8"), ("ticks", "i8")])


class Tally(NamedTuple):
    """Counts.

    Args:
        of: each fighter, COUNTS.  # (2,)
        clock: CLOCK: ticks of the round under way, rounds that ended, ticks made.  # (1,)
    """

    of: NDArray[np.void]
    clock: NDArray[np.void]


def new_tally() -> Tally:
    """Nothing counted yet."""
    return Tally(np.zeros(2, dtype=COUNTS), np.zeros(1, dtype=CLOCK))


class Track(NamedTuple):
    """What is written down tick by tick, T of them, and events, M at most.

    Args:
        node: of both after each tick.  # (T, 2) int32
        place: of both.  # (T, 2, 3) float64
        activity: of both.  # (T, 2) int8
        natural: whether the tick followed the capture.  # (T, 2) bool
        event: tick, kind, who (NOBODY for a drawn round), limb or goal, target struck.  # (M, 5) int64
        worth: of events: damage, or metres that a strike missed by.  # (M,) float64
        events: how many there are.  # (1,) int64
    """

    node: NDArray[np.int32]
    place: NDArray[np.float64]
    activity: NDArray[np.int8]
    natural: NDArray[np.bool_]
    event: NDArray[np.int64]
    worth: NDArray[np.float64]
    events: NDArray[np.int64]


def new_track(ticks: int) -> Track:
    """Room for so many ticks and all that can happen in them: a decision and a strike of each, and a round's end."""
    most = 5 * ticks
    return Track(
        node=np.zeros((ticks, 2), dtype=np.int32),
        place=np.zeros((ticks, 2, 3)),
        activity=np.zeros((ticks, 2), dtype=np.int8),
        natural=np.zeros((ticks, 2), dtype=np.bool_),
        event=np.zeros((most, 5), dtype=np.int64),
        worth=np.zeros(most),
        events=np.zeros(1, dtype=np.int64),
    )


@numba.njit(cache=True, nogil=True)
def note(track: Track, tick: int, kind: int, who: int, what: int, target: int, worth: float) -> None:
    """Write an event down."""
    at = track.events[0]
    row = track.event[at]
    row[0], row[1], row[2], row[3], row[4] = tick, kind, who, what, target
    track.worth[at] = worth
    track.events[0] = at + 1
