"""A simulation in which every character fights an opponent that comes with it."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import NONE, Command, Vocabulary
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.runtime.duel_ticks import DuelTicks, Happening
from footwork.runtime.duels import SPEEDS, DuelSteering
from footwork.runtime.opponent import Opponent
from footwork.runtime.recorder import Recorder
from footwork.runtime.simulation import Simulation
from footwork.runtime.world_errors import WorldFull


class FightVocabulary(Vocabulary):
    """Reads the commands of those who fight: no key held is to stand, a key of travel is to step that way."""

    def of_keys(self, view_yaw: float, forward: float, strafe: float, run: bool, one_shot: str = "") -> Command:
        """The command of held keys; see ``Vocabulary.of_keys``."""
        moving = forward != 0.0 or strafe != 0.0
        return replace(super().of_keys(view_yaw, forward, strafe, run, one_shot), speed=SPEEDS[moving])


class Arena(Simulation):
    """Characters of players in even slots, each with its opponent in the slot after.

    Both are in a match of their own: they push one another apart, strike, tire and win rounds as in any. A player's
    heading is where to step, with the face to the opponent; attacks and evasions are chosen by the match's own rules
    from those that can be reached.

    Args:
        bundle: of fighters.
        capacity: how many characters there is room for, opponents among them.
        opponent: who they are.
        inertialise: whether transitions are smoothed.
        foot_lock: whether feet that stand stay where they are shown.

    Raises:
        InputError: for a bundle that nobody can fight with, or one without a converged steering table; for a capacity
            under two.
    """

    def __init__(
        self, bundle: Bundle, capacity: int, *, opponent: Opponent, inertialise: bool = True, foot_lock: bool = True
    ) -> None:
        if capacity < DuelSteering.company:
            raise InputError(f"room for {capacity} characters, expected 2 or more for a fight", "arena")
        self._duels = DuelSteering(bundle, opponent)
        super().__init__(bundle, capacity, inertialise=inertialise, foot_lock=foot_lock, controller=self._duels)
        self.opponent = opponent
        self.shown = self.shown._replace(health=self.health, stamina=self.stamina)
        self.vocabulary = FightVocabulary(
            self.world.graph.behaviours, self.behaviours, self.speeds, one_shot=self._one_shot, rest=self.behaviours[0]
        )
        self._warm()

    def _warm(self) -> None:
        """Compile, or load from the cache, all that a tick runs."""
        slot = self.spawn(0.0, 0.0, 0.0)
        self.play(1, 1)
        self.remove(slot)
        self.tick = 0
        self._duels.forget()

    @property
    def company(self) -> int:
        """How many characters come with a spawn."""
        return DuelSteering.company

    @property
    def full(self) -> bool:
        """Whether there is no room for another two."""
        return self.world.capacity - len(self.world.slots) < self.company

    @property
    def happened(self) -> Sequence[Happening]:
        """What happened in the tick last made."""
        return self._ticks.happened if isinstance(self._ticks, DuelTicks) else ()

    @property
    def health(self) -> NDArray[np.float64]:
        """Of each slot's character, 1 at the beginning of a round.  # (capacity,)"""
        return self._duels.duel.fighters["health"]

    @property
    def stamina(self) -> NDArray[np.float64]:
        """Of each slot's character, 1 when rested.  # (capacity,)"""
        return self._duels.duel.fighters["stamina"]

    def opponent_of(self, slot: int) -> int:
        """The slot of the one who is fought from a slot."""
        return slot ^ 1

    def spawn(self, x: float, z: float, yaw: float, behaviour: str = "", *, node: int = -1, held: int = NONE) -> int:
        """Put a character into the world, in footwork whatever its behaviour, and its opponent before it.

        Raises:
            UnknownBehaviour: for a behaviour that the bundle lacks.
            WorldFull: where there is no room for both.
        """
        if self.full:
            raise WorldFull(f"all {self.world.capacity} characters are taken; remove one first")
        if behaviour:
            self.vocabulary.index(behaviour)
        slot = super().spawn(x, z, yaw, node=node, held=held)
        apart = self.opponent.rules.start
        there = x + apart * math.sin(yaw), z + apart * math.cos(yaw), yaw + math.pi
        self.orders.begin(self.world.spawn(self._duels.opening, *there), there[2], 0)
        self.orders.in_force.speed[slot] = SPEEDS[0]
        self._duels.meet(slot)
        return slot

    def remove(self, slot: int) -> None:
        """Take a player's character and its opponent out of the world.

        Raises:
            InputError: for an opponent.
        """
        self._require_players(slot)
        super().remove(slot)
        self.world.remove(slot + 1)

    def give(self, slot: int, command: Command) -> None:
        """Put a command to a player's character into force, from the next tick on.

        Raises:
            InputError: for an opponent, and as of ``Simulation.give``.
        """
        self._require_players(slot)
        super().give(slot, command)

    def stand(self, slot: int) -> None:
        """Let a player's character stop where it is; it does not stop its opponent."""
        self.give(slot, Command(self.world.place[slot, 2].item(), 0, speed=SPEEDS[0]))

    def record(self, recorder: Recorder) -> None:
        """Tell a recorder, from when nobody is here yet, what takes effect until ``end_recording``."""
        recorder.add(self.opponent.record(self.tick + 1))
        super().record(recorder)

    def _require_players(self, slot: int) -> None:
        self.world.require(slot)
        if slot % 2:
            raise InputError(f"character {slot} is an opponent, which decides for itself", "arena")

    def _rows(self, slots: Sequence[int]) -> NDArray[np.intp]:
        rows = super()._rows(slots)
        players, opponents = rows[::2], rows[1::2]
        if len(players) != len(opponents) or (players % 2).any() or (opponents != players + 1).any():
            raise InputError(f"slots {', '.join(map(str, slots))}, expected each player's and its opponent's", "arena")
        return rows
