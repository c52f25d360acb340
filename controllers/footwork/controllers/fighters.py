"""What is remembered of the fighters of a match besides where they are: plans, strength, and their share of chance."""

import numba
import numpy as np
from numpy.typing import NDArray

NO_GOAL = -1
BY_ITSELF = -1
"""Instead of an activity or a goal that somebody else chose."""
FIGHTER = np.dtype(
    [
        ("activity", "i8"),  # what it does
        ("goal", "i8"),  # the segment that its queued way leads to, NO_GOAL once it is there or where there is none
        ("until", "i8"),  # the last node of the action that it is in or on the way to, NO_GOAL for none
        ("rest", "i8"),  # segments of footwork to come before another attack
        ("calm", "i8"),  # decisions to shadow since the last action
        ("health", "f8"),  # 1 at the beginning of a round, 0 when beaten
        ("stamina", "f8"),  # 1 when rested
        ("chosen_activity", "i8"),  # what somebody else lets it do, BY_ITSELF where nobody does
        ("chosen_goal", "i8"),  # the segment that somebody else sends it to, BY_ITSELF where nobody does
        ("chance", "u8"),  # the state of its random numbers
    ],
    align=True,
)
_GOLDEN, _MIX, _STIR = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_UNIT = 2.0**-53


def new_fighters(seed: int) -> NDArray[np.void]:
    """Two rested fighters who shadow.  # (2,) FIGHTER"""
    fighters = np.zeros(2, dtype=FIGHTER)
    fighters["goal"], fighters["until"] = NO_GOAL, NO_GOAL
    fighters["chosen_activity"], fighters["chosen_goal"] = BY_ITSELF, BY_ITSELF
    fighters["health"], fighters["stamina"] = 1.0, 1.0
    fighters["chance"] = np.random.SeedSequence(seed).generate_state(2, np.uint64)
    return fighters


@numba.njit(cache=True, nogil=True)
def draw(fighter) -> float:
    """The next random number of a fighter, from 0 up to 1: SplitMix64 (Steele, Lea and Flood 2014)."""
    fighter.chance = fighter.chance + _GOLDEN
    mixed = fighter.chance
    mixed = (mixed ^ (mixed >> np.uint64(30))) * _MIX
    mixed = (mixed ^ (mixed >> np.uint64(27))) * _STIR
    mixed ^= mixed >> np.uint64(31)
    return float(mixed >> np.uint64(11)) * _UNIT
