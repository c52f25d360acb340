"""A character that is led by a plan for one known player: at each tick the best action by what comes after it."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations, present_behaviours
from footwork.controllers.steering_kernels import turn_moves
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import Moves, along_edges
from footwork.motion.turn_warp import TurnWarp
from footwork.study.look_back import LookBack, best_ahead


class Plan(Protocol):
    """What nodes are worth after each tick of a known player."""

    def after(self, tick: int, node: int) -> NDArray[np.float32]:
        """The worth after tick ``tick`` of the nodes that can be reached from ``node`` in it.  # (N, bins)"""
        ...

    def start_node(self, behaviour: str) -> int:
        """Where to begin, of the nodes of a behaviour."""
        ...


class PlannedController:
    """One character, asked for what its plan was made for; its facing is exact, not one of the plan's.

    Args:
        graph: where it is.
        warp: what its turns go about.
        looking: what the plan is made by.
        heading: what it is asked for, radians.  # (K,)
        behaviour: the same, -1 for what no frame shows.  # (K,)
        plan: what comes after each tick.
    """

    def __init__(
        self,
        graph: MotionGraph,
        warp: TurnWarp,
        looking: LookBack,
        heading: NDArray[np.float64],
        behaviour: NDArray[np.int32],
        plan: Plan,
    ) -> None:
        self.graph = graph
        self._pivot, self._looking, self._plan = warp.pivot, looking, plan
        self._heading, self._behaviour = heading, behaviour
        self._tick = np.zeros(1, dtype=np.int64)

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame of the graph shows."""
        return present_behaviours(self.graph)

    def start_node(self, behaviour: str = "stop") -> int:
        """Where the plan begins."""
        return self._plan.start_node(behaviour)

    def begin(self, slot: int) -> None:
        """Begin with the first tick."""
        self._tick[0] = 0

    def memory(self, capacity: int) -> tuple[NDArray, ...]:
        """Which tick of the plan comes next, for the one character that there is."""
        return (self._tick,)

    def choose(self, situations: Situations, moves: Moves) -> None:
        """Write the best action of the one character; what it is asked for is known already."""
        tick, node = int(self._tick[0]), int(situations.node[0])
        edge, turn = best_ahead(
            self._looking.actions,
            self._looking.discount,
            node,
            float(situations.place[0, 2]),
            float(self._heading[tick]),
            int(self._behaviour[tick]),
            self._plan.after(tick, node),
        )
        self._tick[0] = tick + 1
        along_edges(self.graph, np.array([edge], np.int32), moves)
        turn_moves(self._pivot, moves.target, np.array([turn]), moves.adjustment)
