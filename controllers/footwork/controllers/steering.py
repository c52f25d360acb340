"""Steering: the edge that a policy table makes best for every character, by one-step lookahead."""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations, present_behaviours
from footwork.errors import FootworkError, InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.lookahead import best_edges
from footwork.motion.moves import Moves, along_edges
from footwork.motion.table import PolicyTable


class WrongQuestion(FootworkError):  # noqa: N818  (it reads as what happened)
    """A controller was asked about a node or a behaviour that its table does not have."""


@numba.njit(cache=True, nogil=True)
def first_outside(index: NDArray, length: int) -> int:
    """The first entry that is no index into ``length`` things, -1 for none."""
    for place in range(index.shape[0]):
        if not 0 <= index[place] < length:
            return place
    return -1


class SteeringController:
    """Chooses edges on one graph by one policy table (conventions.md 5).

    Args:
        graph: where the characters are.
        table: the values that were solved for on that graph.

    Raises:
        InputError: for a table that has not converged or belongs to another graph.
    """

    def __init__(self, graph: MotionGraph, table: PolicyTable) -> None:
        table.require_converged()
        nodes = len(table.values)
        if nodes != graph.node_count:
            raise InputError(f"{nodes} nodes, expected the graph's {graph.node_count}", table.where)
        if table.task.behaviours != graph.behaviours:
            wanted = ", ".join(graph.behaviours)
            raise InputError(
                f"behaviours {', '.join(table.task.behaviours)}, expected the graph's {wanted}", table.where
            )
        self.graph = graph
        self.table = table
        self._headed = table.task.headed
        self._turn = np.ascontiguousarray(graph.displacement[:, 2])
        self._delta, self._best = np.zeros(1), np.zeros(1, dtype=np.int32)

    @property
    def behaviours(self) -> tuple[str, ...]:
        """The behaviours that commands number, in their order; not every one need have a frame."""
        return self.graph.behaviours

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame of the graph shows."""
        return present_behaviours(self.graph)

    def begin(self, slot: int) -> None:
        """Nothing: it remembers nothing of a character."""

    def choose(self, situations: Situations, moves: Moves) -> None:
        """Write the best edge of each of C characters into ``moves``.

        Raises:
            WrongQuestion: for a node or a behaviour that the table does not have.
        """
        node, behaviour, count = situations.node, situations.behaviour, len(situations.node)
        self._check(node, self.graph.node_count, "node")
        self._check(behaviour, len(self.behaviours), "behaviour")
        if len(self._delta) < count:
            self._delta, self._best = np.zeros(count), np.zeros(count, dtype=np.int32)
        delta = np.subtract(situations.heading, situations.place[:, 2], out=self._delta[:count])
        task = self.table.task
        best_edges(
            node,
            delta,
            behaviour,
            self._headed,
            task.heading_sigma,
            task.discount,
            self.table.values,
            self.graph.edge_start,
            self.graph.target,
            self.graph.behaviour,
            self._turn,
            self.graph.smoothness,
            self._best[:count],
        )
        along_edges(self.graph, self._best[:count], moves)

    def start_node(self, behaviour: str = "stop") -> int:
        """A good node to spawn at: of those that show the behaviour, the one worth most on average over all headings.

        Nodes that the capture goes on from come first, so that a character starts without a transition. Where no
        frame shows the behaviour, all nodes are looked at.

        Raises:
            InputError: for a behaviour that the graph does not number.
        """
        if behaviour not in self.behaviours:
            raise InputError(f"no behaviour {behaviour!r}, it has {', '.join(self.behaviours)}", self.graph.where)
        index = self.behaviours.index(behaviour)
        goes_on = np.zeros(self.graph.node_count, dtype=bool)
        goes_on[self.graph.source[self.graph.natural]] = True
        shows = self.graph.behaviour == index
        for choice in (shows & goes_on, shows, goes_on):
            if choice.any():
                worth = self.table.values[:, index].mean(axis=1, dtype=np.float64)
                return int(np.argmax(np.where(choice, worth, -np.inf)))
        return 0

    def _check(self, index: NDArray, length: int, name: str) -> None:
        wrong = first_outside(index, length)
        if wrong >= 0:
            raise WrongQuestion(f"{name} {index[wrong]} of character {wrong}, expected 0 to {length - 1}")
