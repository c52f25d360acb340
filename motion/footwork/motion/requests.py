"""Requests: what may be asked for as tables number it, each behaviour at any speed and at some speeds (levels).

A command may ask for any speed; between two levels its worth is interpolated, outside them the nearest level is asked
for (convention).
"""

import math
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.player_model import PlayerModel

ANY_SPEED = math.nan
"""In place of a speed: any will do."""


class Requests(NamedTuple):
    """Q requests: the behaviours at any speed in their order, then each behaviour's levels, the slowest first.

    Args:
        behaviour: index of the behaviour asked for.  # (Q,)
        speed: the speed asked for, m/s, ANY_SPEED for none.  # (Q,)
    """

    behaviour: NDArray[np.int32]
    speed: NDArray[np.float64]


class Asked(NamedTuple):
    """What one character is asked for, and the two requests that it lies between.

    Args:
        behaviour: index of the behaviour.
        speed: m/s, within the levels of the behaviour; ANY_SPEED for none.
        low: the request of the level not above the speed.
        high: the request of the next level, ``low`` itself where ``share`` is 0.
        share: how far the speed is from the one to the other, 0 to 1.
    """

    behaviour: int
    speed: float
    low: int
    high: int
    share: float


@numba.njit(cache=True, nogil=True)
def asked_for(requests: Requests, behaviour: int, speed: float) -> Asked:
    """A behaviour at a speed; at any speed where that is ANY_SPEED or the behaviour has no levels."""
    of, level = requests
    within, low, high, share = math.nan, -1, -1, 0.0
    if not math.isnan(speed):
        for request in range(len(of)):
            if of[request] == behaviour and not math.isnan(level[request]):
                if low < 0 or level[request] <= speed:
                    low = request
                high = request
                if level[request] >= speed:
                    break
    if low < 0:
        low = high = behaviour
    else:
        within = min(max(speed, level[low]), level[high])
        if high > low:
            share = (within - level[low]) / (level[high] - level[low])
    return Asked(behaviour, within, low, high, share)


def holding_speed(player: PlayerModel, requests: Requests) -> PlayerModel:
    """How the requests of a player change: a speed is held as long as the behaviour is, then any will do (convention).

    Recorded players hold keys, which ask for no speed, so that there is nothing to learn it from.
    """
    behaviour, speed = requests
    any_speed = np.isnan(speed)
    if any_speed.all():
        return player
    held = np.eye(len(behaviour), dtype=bool)
    possible = np.where(behaviour[:, None] == behaviour, held, any_speed)
    names = [player.behaviours[index] for index in behaviour]
    told = tuple(
        name if free else f"{name} at {metres:g} m/s"
        for name, metres, free in zip(names, speed, any_speed, strict=True)
    )
    change = player.change[behaviour[:, None], behaviour] * possible[..., None]
    return PlayerModel(told, change, player.learned_from, player.where)
