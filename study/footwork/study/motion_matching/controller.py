"""The motion matching controller."""

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations, present_behaviours
from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import Moves
from footwork.study.motion_matching.database import database_of
from footwork.study.motion_matching.options import REFERENCE, MatchingOptions
from footwork.study.motion_matching.tick import Memory, choose, memory_for


class MotionMatchingController:
    """Plays on from whichever frame best fits the pose shown and what is asked for; its moves are leaps.

    Stop asks for a velocity of 0, every other behaviour for the median speed of its own frames in the direction of
    the heading asked for, and every behaviour for that heading (convention). A jump is answered by its own frames
    only, and so is every behaviour in the strong form. A leap goes to the frame after the one found, and the root goes
    on as the capture there does.

    Args:
        graph: what characters move on; its natural edges lead to the node next in number. Dead ends are left by leaps.
        options: the form.

    Attributes:
        data: what is searched.

    Raises:
        InputError: for a graph with other natural edges, or with no frame that may be searched.
    """

    def __init__(self, graph: MotionGraph, options: MatchingOptions = REFERENCE) -> None:
        self.graph = graph
        self.options = options
        self.data = database_of(graph, options)
        self._memory = memory_for(1)

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame of the graph shows."""
        return present_behaviours(self.graph)

    @property
    def table_bytes(self) -> int:
        """The size of what is searched: features, boxes and frame numbers."""
        return sum(array.nbytes for array in self.data.sets)

    def start_node(self, behaviour: str = "stop") -> int:
        """Where to spawn: the frame after which the capture shows the behaviour longest, the first of equals.

        Raises:
            InputError: for a behaviour that the graph does not number.
        """
        behaviours = self.graph.behaviours
        if behaviour not in behaviours:
            raise InputError(f"no behaviour {behaviour!r}, it has {', '.join(behaviours)}", self.graph.where)
        shown = self.graph.behaviour == behaviours.index(behaviour)
        return int(np.argmax(np.where(shown, self.data.run_left, -1)))

    def begin(self, slot: int) -> None:
        """A new character has come into this slot: it stands where its simulated root does, and searches at once."""
        if slot >= len(self._memory.wait):
            self._memory = _with_room(self._memory, 2 * slot + 1)
        for array in self._memory:
            array[slot] = 0

    def memory(self, capacity: int) -> tuple[NDArray, ...]:
        """All that it remembers, with room for so many slots."""
        if capacity > len(self._memory.wait):
            self._memory = _with_room(self._memory, capacity)
        return tuple(self._memory)

    def choose(self, situations: Situations, moves: Moves) -> None:
        """Write the move of each of C characters into ``moves``."""
        choose(
            self.data,
            self.options,
            self._memory,
            situations.slot,
            situations.node,
            situations.place,
            situations.heading,
            situations.behaviour,
            moves.edge,
            moves.target,
            moves.displacement,
            moves.adjustment,
            moves.natural,
        )


def _with_room(memory: Memory, slots: int) -> Memory:
    """The same memory with more slots."""
    longer = memory_for(slots)
    for array, kept in zip(longer, memory, strict=True):
        array[: len(kept)] = kept
    return longer
