"""What every controller is: it is shown situations, and fills in moves."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.moves import Moves
from footwork.motion.task import HEADED, ONE_SHOT


@dataclass(frozen=True, eq=False)
class Situations:
    """Where each of C characters is before a tick, and what it is asked for.

    Args:
        slot: which character it is, by which a controller may remember it.  # (C,)
        node: the frame that it shows.  # (C,) int32
        place: planar places (x, z, yaw) in the world, metres and radians.  # (C, 3)
        heading: wanted yaw in the world, radians.  # (C,)
        behaviour: index into the graph's behaviours of what is asked for.  # (C,) int32
        speed: the speed asked for, m/s, ANY_SPEED where any will do; None where none is asked of anyone.  # (C,)
    """

    slot: NDArray[np.intp]
    node: NDArray[np.int32]
    place: NDArray[np.float64]
    heading: NDArray[np.float64]
    behaviour: NDArray[np.int32]
    speed: NDArray[np.float64] | None = None


class Controller(Protocol):
    """Chooses what characters do next on one motion graph; the world carries it out.

    Whatever it remembers of a character it remembers by slot, and forgets when another begins there.
    """

    @property
    def graph(self) -> MotionGraph:
        """What its characters move on."""
        ...

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame shows."""
        ...

    def start_node(self, behaviour: str = "stop") -> int:
        """Where to spawn."""
        ...

    def begin(self, slot: int) -> None:
        """A new character has come into this slot."""
        ...

    def memory(self, capacity: int) -> tuple[NDArray, ...]:
        """All that it remembers, arrays with a row for each slot, with room for so many slots.

        They stay its own for as long as slots are under ``capacity``: whoever writes a row puts a character back.
        """
        ...

    def choose(self, situations: Situations, moves: Moves) -> None:
        """Write the move that each character shall make into ``moves``, row for row.

        A call of the same situations after the same calls gives the same moves.
        """
        ...


def speeds_of(controller: Controller) -> dict[str, tuple[float, float]]:
    """The slowest and the fastest, m/s, that behaviours can be asked for; none of a controller that takes no speeds."""
    return getattr(controller, "speeds", {})


def headed_of(controller: Controller) -> tuple[str, ...]:
    """The behaviours that a heading counts in; the usual ones of a controller that does not say."""
    return getattr(controller, "headed", HEADED)


def one_shots_of(controller: Controller) -> tuple[str, ...]:
    """The behaviours that are done once when they are asked for; the usual ones of a controller that does not say."""
    return getattr(controller, "one_shot", ONE_SHOT)


def present_behaviours(graph: MotionGraph) -> tuple[str, ...]:
    """The behaviours that some frame of a graph shows, in the graph's order."""
    shown = set(graph.behaviour.tolist())
    return tuple(name for index, name in enumerate(graph.behaviours) if index in shown)
