"""Duels: characters in pairs of slots, one whom a player steers in the first and its opponent in the second."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ACTIVITIES
from footwork.controllers.bundle_controller import STEERING
from footwork.controllers.fighters import BY_ITSELF, FIGHTER, NO_GOAL, new_fighters
from footwork.controllers.state_steering import StateSteering
from footwork.controllers.stepping import Stepping
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.runtime.match import FightGround, fight_ground
from footwork.runtime.opponent import Opponent
from footwork.runtime.tally import CLOCK, COUNTS

SPEEDS = (0.0, 1.0)
"""Metres a second: the slowest and the fastest that footwork may be asked for."""
_BEYOND = 1e9


class Duel(NamedTuple):
    """What is remembered of duels besides where their fighters are, a row for each slot; pairs begin at even ones.

    Args:
        fighters: FIGHTER.  # (C,)
        counts: COUNTS.  # (C,)
        clock: CLOCK of the pair, in the row of its first slot.  # (C,)
    """

    fighters: NDArray[np.void]
    counts: NDArray[np.void]
    clock: NDArray[np.void]


def _no_duels(capacity: int) -> Duel:
    return Duel(np.zeros(capacity, FIGHTER), np.zeros(capacity, COUNTS), np.zeros(capacity, CLOCK))


class DuelSteering(StateSteering):
    """What the two in a duel decide by, and what is remembered of all duels.

    Args:
        bundle: what they move on.
        opponent: who the second of each pair is.

    Attributes:
        opponent: that.
        ground: what matches on the bundle share.
        stepping: footwork of those whom players steer.
        company: how many characters come together.

    Raises:
        InputError: for a bundle that nobody can fight with.
    """

    company = 2

    def __init__(self, bundle: Bundle, opponent: Opponent) -> None:
        self.ground: FightGround = fight_ground(bundle)
        if bundle.annotation is None:
            raise InputError("no states", bundle.graph.where)
        super().__init__(bundle.graph, bundle.table(STEERING), bundle.annotation)
        self.opponent = opponent
        self.stepping = Stepping(self.ground.hops)
        self._duel = _no_duels(0)
        self._met = 0

    @property
    def speeds(self) -> dict[str, tuple[float, float]]:
        """Of footwork."""
        return {self.behaviours[0]: SPEEDS}

    @property
    def duel(self) -> Duel:
        """What is remembered, as of the last ``memory``."""
        return self._duel

    def memory(self, capacity: int) -> tuple[NDArray, ...]:
        """What steering remembers, and Duel; with room for whole pairs."""
        if len(self._duel.fighters) < capacity:
            self._duel = _no_duels(capacity)
        return (*super().memory(capacity), *self._duel)

    @property
    def opening(self) -> int:
        """Where in the footwork the opponent of the next duel begins, by the seed: a node."""
        segments = self.ground.world.segments
        last = segments["last"][segments["state"] == 0]
        return int(last[np.random.default_rng([self.opponent.seed, self._met]).integers(len(last))])

    def meet(self, slot: int) -> None:
        """A duel begins in a slot and the one after it; each has another share of chance by the seed."""
        both = slice(slot, slot + 2)
        seed = np.random.SeedSequence([self.opponent.seed, self._met]).generate_state(1, np.uint64)[0]
        self._duel.fighters[both] = new_fighters(int(seed))
        self._duel.counts[both], self._duel.clock[both] = 0, 0
        self._met += 1

    def forget(self) -> None:
        """Begin with the first duel of the seed again."""
        self._met = 0

    def sound(self, slots: Iterable[int]) -> bool:
        """Whether what memory holds of some slots can be: numbers that index are in range, the others bounded."""
        fighters, segments = self._duel.fighters[list(slots)], len(self.ground.world.segments)
        bounds = {
            "activity": (0, len(ACTIVITIES) - 1),
            "chosen_activity": (BY_ITSELF, len(ACTIVITIES) - 1),
            "goal": (NO_GOAL, segments - 1),
            "chosen_goal": (BY_ITSELF, segments - 1),
            "rest": (0, _BEYOND),
            "calm": (0, _BEYOND),
            "health": (-_BEYOND, _BEYOND),
            "stamina": (-_BEYOND, _BEYOND),
        }
        return all(((low <= fighters[name]) & (fighters[name] <= high)).all() for name, (low, high) in bounds.items())
