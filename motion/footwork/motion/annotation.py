"""What a state-annotated motion graph knows beyond its frames: states, segments, and the quickest ways between them.

After Chiu, Zordan and Wu (2007). A segment is a stretch of a clip without a branch: whoever enters its first node goes
on to its last, and only there chooses. The ways lead from every segment of a state to every segment of another in the
least time, over segments of these two states only.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_range, require_shape
from footwork.motion.graph import MotionGraph
from footwork.motion.state_machine import StateMachine

NO_WAY = -1


@dataclass(frozen=True, eq=False)
class NextHops:
    """The quickest ways from R segments to T segments, each a hop at a time: both by number, ascending.

    The R are those of the two states of a pair that is to be reached at once, the T those of the second of them.

    Args:
        edge: the edge of the graph to take at the end of a segment, NO_WAY for none.  # (R, T)
        delay: ticks of the segments between the two, NO_WAY where there is no way.  # (R, T)
    """

    edge: NDArray[np.int32]
    delay: NDArray[np.int32]

    def __post_init__(self) -> None:
        for name in ("edge", "delay"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.int32))


@dataclass(frozen=True, eq=False)
class Annotation:
    """States, segments and ways of a graph of N nodes; G segments.

    Args:
        machine: the states.
        first: the first node of each segment, and N: segment g is the nodes ``first[g]:first[g + 1]``.  # (G + 1,)
        state: the number of each segment's state; it may hold frames labelled otherwise, a wind-up say.  # (G,)
        ways: for each pair of ``machine.at_once``, in its order.

    Raises:
        InputError: for segments without nodes, states that are not there, and ways of other sizes than segments.
    """

    machine: StateMachine
    first: NDArray[np.int32]
    state: NDArray[np.int16]
    ways: tuple[NextHops, ...]
    where: str = "annotation"

    def __post_init__(self) -> None:
        object.__setattr__(self, "first", frozen(self.first, np.int32))
        object.__setattr__(self, "state", frozen(self.state, np.int16))
        object.__setattr__(self, "ways", tuple(self.ways))
        require_shape(self.first, (None,), "first", self.where)
        if self.first.size < 2 or self.first[0] != 0 or (self.first[1:] <= self.first[:-1]).any():
            raise InputError("first does not cut the nodes into segments, expected it to rise from 0", self.where)
        require_shape(self.state, (self.segment_count,), "state", self.where)
        require_range(self.state, 0, len(self.machine.states), "state", self.where)
        self._check_ways()

    def _check_ways(self) -> None:
        pairs = self.machine.at_once
        if len(self.ways) != len(pairs):
            raise InputError(f"{len(self.ways)} tables of ways, expected {len(pairs)}", self.where)
        for pair, hops in zip(pairs, self.ways, strict=True):
            shape = len(self.between(pair)), len(self.of_state(pair[1]))
            require_shape(hops.edge, shape, "edge of ways", self.where)
            require_shape(hops.delay, shape, "delay of ways", self.where)

    @property
    def segment_count(self) -> int:
        """The number of segments G."""
        return len(self.first) - 1

    @cached_property
    def length(self) -> NDArray[np.int32]:
        """Nodes of each segment, which is as many ticks.  # (G,)"""
        return np.diff(self.first)

    @property
    def last(self) -> NDArray[np.int32]:
        """The last node of each segment.  # (G,)"""
        return self.first[1:] - 1

    @cached_property
    def segment(self) -> NDArray[np.int32]:
        """The segment of each node.  # (N,)"""
        return np.repeat(np.arange(self.segment_count, dtype=np.int32), self.length)

    def of_state(self, number: int) -> NDArray[np.intp]:
        """The segments of a state, ascending.  # (T,)"""
        return np.flatnonzero(self.state == number)

    def between(self, pair: tuple[int, int]) -> NDArray[np.intp]:
        """The segments of either state of a pair, ascending: the rows of its ways.  # (R,)"""
        return np.flatnonzero(np.isin(self.state, pair))

    def hops(self, graph: MotionGraph, pair: tuple[int, int], segment: int, goal: int) -> Iterator[int]:
        """The edges taken at the ends of segments on the quickest way from one segment to another; none without a way.

        Args:
            graph: the graph.
            pair: of ``machine.at_once``.
            segment: of either of its states.
            goal: of its second.
        """
        rows, column = self.between(pair), int(np.searchsorted(self.of_state(pair[1]), goal))
        edges = self.ways[self.machine.at_once.index(pair)].edge
        while (edge := int(edges[np.searchsorted(rows, segment), column])) != NO_WAY:
            yield edge
            segment = int(self.segment[graph.target[edge]])
            if segment == goal:
                return

    def require_fits(self, graph: MotionGraph) -> None:
        """Raise InputError unless these are the segments and ways of ``graph``."""
        if self.first[-1] != graph.node_count:
            raise InputError(f"segments of {self.first[-1]} nodes, the graph has {graph.node_count}", self.where)
        self._check_edges(graph)
        for pair, hops in zip(self.machine.at_once, self.ways, strict=True):
            self._check_hops(graph, pair, hops)

    def _check_edges(self, graph: MotionGraph) -> None:
        """Edges go from a segment's node to its next, or from a segment's end to the beginning of one that may follow.

        Only natural edges stay within a state whose machine has no transitions within it.
        """
        source, target = graph.source, graph.target
        here, there = self.segment[source], self.segment[target]
        inside = source != self.last[here]
        wrong = np.where(inside, target != source + 1, target != self.first[there])
        states = len(self.machine.states)
        allowed = np.zeros((states, states), dtype=np.bool_)
        allowed[tuple(np.array(sorted(self.machine.allowed)).T)] = True
        natural = graph.natural & (self.state[here] == self.state[there])
        wrong |= ~(allowed[self.state[here], self.state[there]] | natural)
        if wrong.any():
            edge = np.flatnonzero(wrong)[0]
            raise InputError(
                f"edge {edge} branches inside a segment or leads to a state that may not follow", self.where
            )

    def _check_hops(self, graph: MotionGraph, pair: tuple[int, int], hops: NextHops) -> None:
        """Each hop leaves its segment's end, and the rest of its way takes as long as told: so ways come to an end."""
        require_range(hops.edge, NO_WAY, graph.edge_count, "edge of ways", self.where)
        rows, goals = self.between(pair), self.of_state(pair[1])
        row, column = np.nonzero(hops.edge != NO_WAY)
        edge = hops.edge[row, column]
        there = self.segment[graph.target[edge]]
        leaves = graph.source[edge] == self.last[rows][row]
        arrives = there == goals[column]
        further = np.searchsorted(rows, there)
        within = np.isin(self.state[there], pair)
        rest = hops.delay[np.where(within, further, 0), column]
        due = np.where(arrives, 0, self.length[there] + rest.astype(np.int64))
        fits = leaves & within & (arrives | (rest >= 0)) & (hops.delay[row, column] == due)
        if not fits.all() or (hops.delay[hops.edge == NO_WAY] != NO_WAY).any():
            names = " to ".join(repr(self.machine.names[number]) for number in pair)
            raise InputError(f"the ways from {names} do not lead where they say, or not in the time told", self.where)
