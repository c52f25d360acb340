"""Orders: what every character was last asked for, and one-shot behaviours waiting until they are entered."""

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import NONE, Command

LATCH_TICKS = 30
"""How long a one-shot behaviour waits to be entered: 1 s (convention)."""
HOLD_TICKS = 10
"""How long it is asked for once it is entered, 0.33 s: a policy that can leave it at once shall not (convention)."""


class Orders:
    """The commands in force, as arrays over characters, ready for ``SteeringController.choose``.

    A one-shot behaviour is latched when its key goes down: it is asked for in place of the lasting behaviour until
    the character has shown it for ``HOLD_TICKS``, or for ``LATCH_TICKS`` if it never does. It is ignored while the
    character shows it already, and a key that stays down asks once.

    Args:
        capacity: how many characters there is room for.

    Attributes:
        heading: wanted yaw in the world, radians.  # (capacity,) float64
        lasting: index of the behaviour to go on with.  # (capacity,) int32
        asked: what to ask for at this tick, as of the last ``at_tick``.  # (capacity,) int32
    """

    def __init__(self, capacity: int) -> None:
        self.heading = np.zeros(capacity)
        self.lasting = np.zeros(capacity, dtype=np.int32)
        self.asked = np.zeros(capacity, dtype=np.int32)
        self._latched = np.full(capacity, NONE, dtype=np.int32)
        self._held = np.full(capacity, NONE, dtype=np.int32)
        self._ticks_left = np.zeros(capacity, dtype=np.int32)
        self._entered = np.zeros(capacity, dtype=np.bool_)

    def begin(self, slot: int, heading: float, behaviour: int) -> None:
        """Forget what the slot was asked for before; a new character begins with this."""
        self.heading[slot] = heading
        self.lasting[slot] = self.asked[slot] = behaviour
        self._latched[slot] = self._held[slot] = NONE
        self._ticks_left[slot], self._entered[slot] = 0, False

    def give(self, slot: int, command: Command, shown: int) -> None:
        """Put a command into force.

        Args:
            slot: whose it is.
            command: what is asked for.
            shown: index of the behaviour that the character shows now, -1 for none.
        """
        self.heading[slot] = command.heading
        if command.behaviour != NONE:
            self.lasting[slot] = command.behaviour
        once, held = command.one_shot, self._held[slot]
        self._held[slot] = once
        if once not in (NONE, held, shown):
            self._latched[slot] = once
            self._ticks_left[slot], self._entered[slot] = LATCH_TICKS, False

    def at_tick(self, shown: NDArray) -> NDArray[np.int32]:
        """The behaviour to ask for at this tick, once a tick before edges are chosen.

        Args:
            shown: index of the behaviour that each character shows now, -1 for none.  # (capacity,)

        Returns:
            ``asked``, which the next call writes over.
        """
        shows = (self._latched == shown) & (self._latched != NONE)
        self._ticks_left[shows & ~self._entered] = HOLD_TICKS
        self._latched[(self._entered & ~shows) | (self._ticks_left == 0)] = NONE
        self._entered = shows
        self.asked[:] = np.where(self._latched == NONE, self.lasting, self._latched)
        self._ticks_left[self._latched != NONE] -= 1
        return self.asked
