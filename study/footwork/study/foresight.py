"""Limited foresight: a character that knows what its player will ask for in the next moments, and nothing after them.

At a decision the commands of the next S seconds are known, and then the player is taken to be as the policy table takes
them to be, whose values end the plan. Plans look back over the nodes that can be reached in time, and are made anew
every few ticks, so that foresight is S at most, and at least S less 0.07 s or a sixth of it, whichever is more.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import present_behaviours
from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion.actions import actions_of, onward_edges
from footwork.motion.asked import going_on, spawn_behaviour
from footwork.motion.graph import MotionGraph
from footwork.motion.table import PolicyTable
from footwork.motion.tick import TICK_RATE
from footwork.motion.turn_warp import turn_warp
from footwork.study.look_back import LookBack, between_bins
from footwork.study.planned import PlannedController

MOST_SECONDS = 5.0
REPLAN = 3
"""Ticks after which a plan is made anew, at least; those of long plans last for a sixth of what they know."""


class Foresight:
    """Plans by the reward of a table's task, over what is known, and by the table's values from then on.

    Without foresight it does what the table's own controller does.

    Args:
        graph: where characters are.
        table: its policy table.
        seconds: how far ahead commands are known.

    Raises:
        InputError: for seconds outside 0..5, or a table that is not the graph's.
    """

    def __init__(self, graph: MotionGraph, table: PolicyTable, seconds: float) -> None:
        if not 0.0 <= seconds <= MOST_SECONDS:  # NaN too
            raise InputError(f"{seconds:g} s, expected 0 to {MOST_SECONDS:g}", "--foresight")
        self.graph, self._table = graph, table
        self._start = SteeringController(graph, table).start_node
        self._warp = turn_warp(graph)
        actions = actions_of(graph, table.task, self._warp)
        self._looking = LookBack(actions, onward_edges(graph), table.task.heading_bins, table.task.discount)
        self._ticks = round(seconds * TICK_RATE)

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame of the graph shows."""
        return present_behaviours(self.graph)

    def start_node(self, behaviour: str) -> int:
        """Where the table's controller begins."""
        return self._start(behaviour)

    def knowing(self, heading: NDArray[np.float64], behaviour: NDArray[np.int32]) -> PlannedController:
        """The controller of a character that is asked for this, tick by tick, of which it knows the next at each.

        Args:
            heading: wanted yaw in the world, radians.  # (K,)
            behaviour: index into the graph's behaviours, -1 for one that no frame shows.  # (K,)
        """
        first = self.graph.behaviours.index(spawn_behaviour(self.present))
        plan = _ShortPlans(self, self._looking, self._table.values, self._ticks, heading, behaviour, first)
        return PlannedController(self.graph, self._warp, self._looking, heading, behaviour, plan)


class _ShortPlans:
    """Plans from where the character is, each over the ticks that are known."""

    def __init__(
        self,
        foresight: Foresight,
        looking: LookBack,
        values: NDArray[np.float32],
        ticks: int,
        heading: NDArray[np.float64],
        behaviour: NDArray[np.int32],
        first: int,
    ) -> None:
        self.start_node = foresight.start_node
        self._looking, self._values = looking, np.asarray(values)
        self._heading, self._behaviour = heading, behaviour
        self._lasting = going_on(behaviour, first)
        self._known, self._from = ticks, -math.inf
        self._lasts = min(max(REPLAN, ticks // 6), ticks + 1)
        graph = foresight.graph
        self._edges = graph.edge_start, graph.target
        self._after = np.zeros((ticks + 2, graph.node_count, looking.bins), np.float32)
        self._reached = np.full(graph.node_count, -1, np.int32)

    def after(self, tick: int, node: int) -> NDArray[np.float32]:
        """The worth after a tick of the nodes that can be reached in it.  # (N, bins)"""
        if not self._from <= tick < self._from + self._lasts:
            self._plan(tick, node)
        return self._after[int(tick - self._from) + 1]

    def _plan(self, tick: int, node: int) -> None:
        """Look back from what the table says of the nodes reached at the end of what is known."""
        last = min(tick + self._known, len(self._heading) - 1)
        layers = [np.array([node], np.int32)]
        for ahead in range(last + 1 - tick):
            layers.append(_one_tick_on(*self._edges, layers[-1], self._reached, ahead))
        self._reached[:] = -1
        end = self._after[last + 1 - tick]
        from_table(layers[-1], self._values, float(self._heading[last]), int(self._lasting[last]), end)
        for ahead in range(last - tick, 0, -1):
            now, after, before = tick + ahead, self._after[ahead + 1], self._after[ahead]
            wanted = float(self._heading[now]), int(self._behaviour[now])
            self._looking.over(layers[ahead], layers[ahead + 1], *wanted, after, before)
        self._from = tick


@numba.njit(cache=True, nogil=True)
def _one_tick_on(edge_start: NDArray, target: NDArray, nodes: NDArray, reached: NDArray, mark: int) -> NDArray:
    """The nodes that edges lead to from some nodes; they get the mark, which none may have yet.  # (n,) int32"""
    count = 0
    for node in nodes:
        for edge in range(edge_start[node], edge_start[node + 1]):
            if reached[target[edge]] != mark:
                reached[target[edge]] = mark
                count += 1
    found, place = np.empty(count, np.int32), 0
    for node in nodes:
        for edge in range(edge_start[node], edge_start[node + 1]):
            there = target[edge]
            if reached[there] == mark:
                reached[there] = -1
                found[place] = there
                place += 1
    return found


@numba.njit(cache=True, nogil=True)
def from_table(nodes: NDArray, values: NDArray, heading: float, wanted: int, after: NDArray) -> None:
    """Write what a policy table says of nodes, for each yaw of theirs, into their rows.

    Args:
        nodes: which.  # (n,)
        values: PolicyTable.values.  # (N, Q, H)
        heading: wanted yaw in the world, radians.
        wanted: index of the behaviour asked for.
        after: the result.  # (N, bins)
    """
    bins = after.shape[1]
    for node in nodes:
        for h in range(bins):
            after[node, h] = between_bins(values[node, wanted], heading + np.pi - 2.0 * np.pi * h / bins)
