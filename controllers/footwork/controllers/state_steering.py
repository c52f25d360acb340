"""Steering on a state-annotated graph: states are entered by the quickest way, and done to their end where they are
done once (conventions.md 11)."""

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations
from footwork.controllers.steering import SteeringController
from footwork.motion.annotation import NO_WAY, Annotation
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import Moves, moves_along
from footwork.motion.quickest_hops import quickest_hops
from footwork.motion.table import PolicyTable


class StateSteering(SteeringController):
    """Chooses edges on one annotated graph, whose behaviours are its states.

    A state that is done once, and is to be reached at once from where a character is, is entered by the quickest way,
    and then played as it was captured to its end. Of whatever else is asked for the policy table decides.

    Args:
        graph: where the characters are.
        table: the values that were solved for on that graph.
        annotation: its states.
        exact_facing: as of SteeringController.

    Raises:
        InputError: for a table that has not converged or belongs to another graph.
    """

    def __init__(
        self, graph: MotionGraph, table: PolicyTable, annotation: Annotation, *, exact_facing: bool = True
    ) -> None:
        super().__init__(graph, table, exact_facing=exact_facing)
        once = np.isin(annotation.machine.names, annotation.machine.one_shot)
        self._way = np.full((graph.node_count, len(once)), NO_WAY, dtype=np.int32)
        self._way[annotation.last] = np.where(once, quickest_hops(graph, annotation), NO_WAY)
        onward = _goes_on(graph, annotation.state[annotation.segment], once)
        self._way = np.where((onward != NO_WAY)[:, None], onward[:, None], self._way)

    def choose(self, situations: Situations, moves: Moves) -> None:
        """Write the move of each of C characters into ``moves``.

        Raises:
            WrongQuestion: for a node or a behaviour that the table does not have.
        """
        super().choose(situations, moves)
        edge = self._way[situations.node, situations.behaviour]
        rows = np.flatnonzero((edge != NO_WAY) & (edge != moves.edge))  # where they agree it may turn on its way
        if rows.size:
            moves.put(rows, moves_along(self.graph, edge[rows]))


def _goes_on(graph: MotionGraph, state: NDArray, once: NDArray[np.bool_]) -> NDArray[np.int32]:
    """The edge along which the capture goes on within a state that is done once, NO_WAY elsewhere.  # (N,)"""
    edges = np.flatnonzero(graph.natural & (state[graph.source] == state[graph.target]) & once[state[graph.source]])
    onward = np.full(graph.node_count, NO_WAY, dtype=np.int32)
    onward[graph.source[edges]] = edges
    return onward
