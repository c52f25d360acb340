"""The offline oracle: the best that a character can do for a player of whom everything is known beforehand.

Dynamic programming backwards over the ticks of a trace (``look_back``), then forwards along the path that it finds.
Source: McCann and Pollard (2007) compare with the optimum that knows the whole trace.
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import present_behaviours
from footwork.motion.actions import actions_of, onward_edges
from footwork.motion.graph import MotionGraph
from footwork.motion.task import SteeringTask
from footwork.motion.turn_warp import turn_warp
from footwork.study.look_back import LookBack
from footwork.study.planned import PlannedController
from footwork.training.room import require_room

BINS = 72
WEIGHT = 0.7
"""Worth of the transition quality against control, where the task does not say: mean qc / mean qt of good players."""
_NUMBER = 4  # bytes


class Oracle:
    """Plans for the best Total, an upper bound up to the yaws that values are tabulated at.

    Total is a product of two means; its best sum qc + weight qt has the greatest product where the weight is the
    ratio of the means, so the plan is for a sum, without discount. It keeps the values of one tick in sqrt(K), and of
    as many in turn as lie between: about 2 sqrt(K) N bins 4 bytes for N nodes and K ticks.

    Args:
        graph: where characters are.
        task: its warp and sigmas, and its weight where its reward is a sum.
        bins: yaws that values are tabulated at.
    """

    def __init__(self, graph: MotionGraph, task: SteeringTask, bins: int = BINS) -> None:
        self.graph = graph
        weight = task.weight if task.additive else WEIGHT
        summed = replace(task, reward="sum", weight=weight, transition_price=0.0)
        self._warp = turn_warp(graph)
        self._looking = LookBack(actions_of(graph, summed, self._warp), onward_edges(graph), bins, discount=1.0)

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame of the graph shows."""
        return present_behaviours(self.graph)

    def knowing(self, heading: NDArray[np.float64], behaviour: NDArray[np.int32]) -> PlannedController:
        """The controller of a character that is asked for this, tick by tick.

        Args:
            heading: wanted yaw in the world, radians.  # (K,)
            behaviour: index into the graph's behaviours, -1 for one that no frame shows.  # (K,)

        Raises:
            InputError: for more nodes and ticks than memory has room for.
        """
        plan = _WholePlan(self.graph, self._looking, heading, behaviour)
        return PlannedController(self.graph, self._warp, self._looking, heading, behaviour, plan)


class _WholePlan:
    """Values before every tick, those of some ticks kept and the others made again when they are come to."""

    def __init__(self, graph: MotionGraph, looking: LookBack, heading: NDArray, behaviour: NDArray) -> None:
        self._graph, self._looking = graph, looking
        self._heading, self._behaviour = heading, behaviour
        self._nodes = np.arange(graph.node_count, dtype=np.int32)
        self._stride = max(1, math.isqrt(len(heading)))
        shape = graph.node_count, looking.bins
        kept = -(-len(heading) // self._stride) + 1
        needed = (kept + self._stride + 1) * shape[0] * shape[1] * _NUMBER
        require_room(needed, f"a plan of {len(heading)} ticks on {shape[0]} nodes", "a shorter trace", "oracle")
        self._kept = np.zeros((kept, *shape), np.float32)
        self._between, self._between_from = np.zeros((self._stride + 1, *shape), np.float32), -1
        for block in range(kept - 2, -1, -1):
            self._fill(block)
            self._kept[block] = self._between[0]

    def after(self, tick: int, node: int) -> NDArray[np.float32]:
        """The worth of all nodes after a tick, less that of the best.  # (N, bins)"""
        block, within = divmod(tick + 1, self._stride)
        if tick + 1 == len(self._heading):
            return self._kept[-1]
        if block != self._between_from:
            self._fill(block)
        return self._between[within]

    def start_node(self, behaviour: str) -> int:
        """The node of a behaviour that is worth most facing along yaw 0, of those that the capture goes on from."""
        goes_on = np.zeros(self._graph.node_count, dtype=bool)
        goes_on[self._graph.source[self._graph.natural]] = True
        shows = self._graph.behaviour == self._graph.behaviours.index(behaviour)
        ahead = self._kept[0][:, self._looking.bins // 2]
        choice = next(some for some in (shows & goes_on, shows, goes_on, ~goes_on) if some.any())
        return int(np.argmax(np.where(choice, ahead, -np.inf)))

    def _fill(self, block: int) -> None:
        """Make the values before every tick of a block again, from those after its last."""
        first = block * self._stride
        end = min(first + self._stride, len(self._heading))
        self._between[end - first] = self._kept[block + 1]
        everywhere = self._nodes, self._nodes
        for tick in range(end - 1, first - 1, -1):
            after, before = self._between[tick + 1 - first], self._between[tick - first]
            self._looking.over(*everywhere, float(self._heading[tick]), int(self._behaviour[tick]), after, before)
            # Only differences matter; without this, float32 would lose them in long traces.
            before -= before.max()
        self._between_from = block
