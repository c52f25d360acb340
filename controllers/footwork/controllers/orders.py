"""Orders: what every character was last asked for, and one-shot behaviours waiting until they are entered."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import NONE, Command
from footwork.motion.requests import ANY_SPEED

LATCH_TICKS = 30
"""How long a one-shot behaviour waits to be entered: 1 s (convention)."""
HOLD_TICKS = 10
"""How long it is asked for once it is entered, 0.33 s: a policy that can leave it at once shall not (convention)."""


class InForce(NamedTuple):
    """The commands in force, a row for each slot.

    Args:
        heading: wanted yaw in the world, radians.  # (C,) float64
        lasting: index of the behaviour to go on with.  # (C,) int32
        asked: what was asked for at the last tick.  # (C,) int32
        latched: index of the one-shot behaviour that waits or is being done, -1 for none.  # (C,) int32
        held: index of the one-shot behaviour whose key is held, -1 for none.  # (C,) int32
        ticks_left: how much longer the latched one is asked for.  # (C,) int32
        entered: whether the character showed it at the last tick.  # (C,) bool
        speed: that of the behaviour to go on with, m/s, ANY_SPEED where any will do.  # (C,) float64
        asked_speed: the speed that was asked for at the last tick.  # (C,) float64
    """

    heading: NDArray[np.float64]
    lasting: NDArray[np.int32]
    asked: NDArray[np.int32]
    latched: NDArray[np.int32]
    held: NDArray[np.int32]
    ticks_left: NDArray[np.int32]
    entered: NDArray[np.bool_]
    speed: NDArray[np.float64]
    asked_speed: NDArray[np.float64]


@numba.njit(cache=True, nogil=True)
def put_in_force(
    slot: int, heading: float, behaviour: int, one_shot: int, speed: float, shown: int, in_force: InForce
) -> None:
    """Put a command into force for a character that shows the behaviour ``shown`` now, -1 for none."""
    in_force.heading[slot] = heading
    if behaviour != NONE:
        in_force.lasting[slot], in_force.speed[slot] = behaviour, speed
    held = in_force.held[slot]
    in_force.held[slot] = one_shot
    if one_shot != NONE and one_shot != held and one_shot != shown:
        in_force.latched[slot] = one_shot
        in_force.ticks_left[slot], in_force.entered[slot] = LATCH_TICKS, False


# A handful of numbers: to Python they take less by themselves than the way into compiled code.
_put_one = getattr(put_in_force, "py_func", put_in_force)


@numba.njit(cache=True, nogil=True)
def ask(slots: NDArray, shown: NDArray, in_force: InForce) -> None:
    """Write what to ask of characters at this tick into ``asked``, once a tick before edges are chosen.

    Args:
        slots: rows of the characters.  # (n,)
        shown: index of the behaviour that each of them shows now, -1 for none, row for row with ``slots``.  # (n,)
        in_force: their commands.
    """
    _, lasting, asked, latched, _, ticks_left, entered, speed, asked_speed = in_force
    for row in range(slots.shape[0]):
        who = slots[row]
        shows = latched[who] == shown[row] and latched[who] != NONE
        if shows and not entered[who]:
            ticks_left[who] = HOLD_TICKS
        if (entered[who] and not shows) or ticks_left[who] == 0:
            latched[who] = NONE
        entered[who] = shows
        asked[who], asked_speed[who] = lasting[who], speed[who]
        if latched[who] != NONE:
            asked[who], asked_speed[who] = latched[who], ANY_SPEED
            ticks_left[who] -= 1


class Orders:
    """The commands in force, ready for ``SteeringController.choose``.

    A one-shot behaviour is latched when its key goes down: it is asked for in place of the lasting behaviour until
    the character has shown it for ``HOLD_TICKS``, or for ``LATCH_TICKS`` if it never does. It is ignored while the
    character shows it already, and a key that stays down asks once.

    Args:
        capacity: how many characters there is room for.

    Attributes:
        in_force: all that is remembered of them.
        heading: of those.  # (capacity,)
        asked: of those: what to ask for at this tick, as of the last ``at_tick``.  # (capacity,)
    """

    def __init__(self, capacity: int) -> None:
        self.in_force = InForce(
            heading=np.zeros(capacity),
            lasting=np.zeros(capacity, dtype=np.int32),
            asked=np.zeros(capacity, dtype=np.int32),
            latched=np.full(capacity, NONE, dtype=np.int32),
            held=np.full(capacity, NONE, dtype=np.int32),
            ticks_left=np.zeros(capacity, dtype=np.int32),
            entered=np.zeros(capacity, dtype=np.bool_),
            speed=np.full(capacity, ANY_SPEED),
            asked_speed=np.full(capacity, ANY_SPEED),
        )
        self.heading, self.asked = self.in_force.heading, self.in_force.asked
        self._slots = np.arange(capacity)

    def begin(self, slot: int, heading: float, behaviour: int, held: int = NONE) -> None:
        """Forget what the slot was asked for before; a new character begins with this.

        The one-shot behaviour ``held`` has been asked for already: a command that goes on asking does not ask again.
        """
        in_force = self.in_force
        _, lasting, asked, latched, _, ticks_left, entered, speed, asked_speed = in_force
        self.heading[slot] = heading
        lasting[slot] = asked[slot] = behaviour
        speed[slot] = asked_speed[slot] = ANY_SPEED
        latched[slot], in_force.held[slot] = NONE, held
        ticks_left[slot], entered[slot] = 0, False

    def give(self, slot: int, command: Command, shown: int) -> None:
        """Put a command into force.

        Args:
            slot: whose it is.
            command: what is asked for.
            shown: index of the behaviour that the character shows now, -1 for none.
        """
        heading, speed = float(command.heading), command.asked_speed
        _put_one(slot, heading, command.behaviour, command.one_shot, speed, shown, self.in_force)

    def at_tick(self, shown: NDArray) -> NDArray[np.int32]:
        """The behaviour to ask for at this tick, once a tick before edges are chosen.

        Args:
            shown: index of the behaviour that each character shows now, -1 for none.  # (capacity,)

        Returns:
            ``asked``, which the next call writes over.
        """
        ask(self._slots, shown, self.in_force)
        return self.asked
