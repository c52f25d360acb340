"""Steering: the edge and the extra turn that a policy table makes best for every character, by one-step lookahead."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations, present_behaviours
from footwork.controllers.policy import Policy
from footwork.controllers.questions import require_indices
from footwork.controllers.steering_kernels import steer
from footwork.errors import InputError
from footwork.motion.actions import actions_of, onward_edges
from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import Moves
from footwork.motion.requests import ANY_SPEED
from footwork.motion.table import PolicyTable
from footwork.motion.turn_warp import turn_warp


class SteeringController:
    """Chooses edges and extra turns on one graph by one policy table (conventions.md 5).

    Args:
        graph: where the characters are.
        table: the values that were solved for on that graph.
        exact_facing: whether extra turns may lie between the task's levels, so that a character that is nearly there
            faces right where it is asked to.

    Raises:
        InputError: for a table that has not converged or belongs to another graph.
    """

    def __init__(self, graph: MotionGraph, table: PolicyTable, *, exact_facing: bool = True) -> None:
        table.require_converged()
        nodes = len(table.coded.codes)
        if nodes != graph.node_count:
            raise InputError(f"{nodes} nodes, expected the graph's {graph.node_count}", table.where)
        if table.task.behaviours != graph.behaviours:
            wanted = ", ".join(graph.behaviours)
            raise InputError(
                f"behaviours {', '.join(table.task.behaviours)}, expected the graph's {wanted}", table.where
            )
        self.graph = graph
        self.table = table
        self.exact_facing = exact_facing
        warp = turn_warp(graph) if table.task.warp > 0.0 else None
        self.policy = Policy(
            actions=actions_of(graph, table.task, warp),
            coded=table.coded,
            shortlist=table.shortlist,
            requests=table.task.requests,
            onward=onward_edges(graph),
            segment_ticks=table.task.segment_ticks,
            exact=exact_facing,
            pivot=frozen(np.zeros((graph.node_count, 2)), float) if warp is None else warp.pivot,
            displacement=graph.displacement,
            natural=graph.natural,
        )
        self._any_speed = np.full(1, ANY_SPEED)
        self._held = np.zeros(1, dtype=np.int32)  # ticks by slot for which the last decision still holds

    @property
    def behaviours(self) -> tuple[str, ...]:
        """The behaviours that commands number, in their order; not every one need have a frame."""
        return self.graph.behaviours

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame of the graph shows."""
        return present_behaviours(self.graph)

    @property
    def speeds(self) -> dict[str, tuple[float, float]]:
        """The slowest and the fastest, m/s, that behaviours can be asked for; only those that can be at a speed."""
        return {
            name: (levels[0], levels[-1]) for name, levels in self.table.task.speeds.items() if name in self.present
        }

    @property
    def headed(self) -> tuple[str, ...]:
        """The behaviours that a heading counts in."""
        return self.table.task.facing

    @property
    def one_shot(self) -> tuple[str, ...]:
        """The behaviours that are done once when they are asked for."""
        return self.table.task.one_shot

    @property
    def table_bytes(self) -> int:
        """The size of what it looks things up in."""
        return self.table.nbytes

    def begin(self, slot: int) -> None:
        """Decide anew at the next tick."""
        self._make_room(slot + 1)
        self._held[slot] = 0

    def memory(self, capacity: int) -> tuple[NDArray, ...]:
        """For how many ticks the last decision of each slot still holds.  # (capacity or more,)"""
        self._make_room(capacity)
        return (self._held,)

    def sound(self, slots: Iterable[int]) -> bool:
        """Whether what memory holds of some slots can be."""
        return all(0 <= self._held.item(slot) < self.policy.segment_ticks for slot in slots)

    def choose(self, situations: Situations, moves: Moves) -> None:
        """Write the best action of each of C characters into ``moves``.

        Raises:
            WrongQuestion: for a node or a behaviour that the table does not have.
        """
        node, behaviour = situations.node, situations.behaviour
        require_indices(node, self.graph.node_count, "node")
        require_indices(behaviour, len(self.behaviours), "behaviour")
        self._make_room(max(len(node), int(situations.slot.max(initial=-1)) + 1))
        steer(
            self.policy,
            situations.slot,
            node,
            situations.place,
            situations.heading,
            behaviour,
            self._any_speed[: len(node)] if situations.speed is None else situations.speed,
            self._held,
            moves.edge,
            moves.target,
            moves.displacement,
            moves.adjustment,
            moves.natural,
        )

    def _make_room(self, count: int) -> None:
        short = count - len(self._held)
        if short > 0:
            self._held = np.append(self._held, np.zeros(short, np.int32))
            self._any_speed = np.full(count, ANY_SPEED)

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
