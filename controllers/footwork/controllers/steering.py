"""Steering: the edge and the extra turn that a policy table makes best for every character, by one-step lookahead."""

from collections.abc import Iterable

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Situations, present_behaviours
from footwork.controllers.policy import Policy
from footwork.controllers.questions import require_indices
from footwork.errors import InputError
from footwork.motion.actions import Actions, actions_of, onward_edges
from footwork.motion.arrays import frozen
from footwork.motion.coded_values import CodedValues
from footwork.motion.graph import MotionGraph
from footwork.motion.lookahead import best_action, best_listed_action
from footwork.motion.moves import Moves, fill_moves
from footwork.motion.requests import ANY_SPEED, Requests, asked_for
from footwork.motion.table import PolicyTable
from footwork.motion.turn_warp import turn_about, turn_warp


@numba.njit(cache=True, nogil=True)
def decide(
    actions: Actions,
    coded: CodedValues,
    shortlist: NDArray,
    requests: Requests,
    onward: NDArray,
    segment_ticks: int,
    exact: bool,
    slot: NDArray,
    node: NDArray,
    place: NDArray,
    heading: NDArray,
    behaviour: NDArray,
    speed: NDArray,
    held: NDArray,
    edge: NDArray,
    turn: NDArray,
) -> None:
    """Write the edge and the extra turn of each of C characters, going on by itself where a decision still holds.

    Args:
        actions: of the graph and the task.
        coded: PolicyTable.coded.
        shortlist: PolicyTable.shortlist, for all but speeds between two levels.  # (N, Q, H) or (N, Q, 0)
        requests: SteeringTask.requests.
        onward: ``onward_edges``.  # (N,)
        segment_ticks: SteeringTask.segment_ticks.
        exact: whether turns may lie between the levels.
        slot: as of Situations, and so are node, place, heading, behaviour and speed.  # (C,)
        held: ticks by slot for which the last decision still holds, counted down here.  # (slots,)
        edge: the result.  # (C,) int32
        turn: the result, radians.  # (C,)
    """
    # Compiled code counts references at each look into a tuple of arrays, so it looks once.
    edge_start, target, yaw, smoothness, shown, turn_limit, price, level, turn_smoothness, headed, pace, rules = actions
    codes, lowest, step = coded
    for who in range(node.shape[0]):
        if held[slot[who]] > 0:
            held[slot[who]] -= 1
            edge[who], turn[who] = onward[node[who]], 0.0
        else:
            held[slot[who]] = segment_ticks - 1
            left = heading[who] - place[who, 2]
            asked = asked_for(requests, behaviour[who], speed[who])
            if shortlist.shape[2] and asked.share == 0.0:
                edge[who], turn[who] = best_listed_action(
                    edge_start,
                    target,
                    yaw,
                    smoothness,
                    shown,
                    turn_limit,
                    price,
                    level,
                    turn_smoothness,
                    headed,
                    pace,
                    rules,
                    codes,
                    lowest,
                    step,
                    shortlist,
                    node[who],
                    asked,
                    left,
                    exact,
                )
            else:
                found = best_action(
                    edge_start,
                    target,
                    yaw,
                    smoothness,
                    shown,
                    turn_limit,
                    price,
                    level,
                    turn_smoothness,
                    headed,
                    pace,
                    rules,
                    codes,
                    lowest,
                    step,
                    node[who],
                    asked,
                    left,
                    exact,
                )
                edge[who], turn[who] = found[1], found[2]


@numba.njit(cache=True, nogil=True)
def turn_moves(pivot: NDArray, target: NDArray, turn: NDArray, adjustment: NDArray) -> None:
    """Write the adjustments (C, 3) that turn characters about the pivots (N, 2) of the frames they come to."""
    for who in range(turn.shape[0]):
        if turn[who] != 0.0:
            there = target[who]
            x, z, yaw = turn_about(pivot[there, 0], pivot[there, 1], turn[who])
            adjustment[who, 0], adjustment[who, 1], adjustment[who, 2] = x, z, yaw


@numba.njit(cache=True, nogil=True)
def steer(
    policy: Policy,
    slot: NDArray,
    node: NDArray,
    place: NDArray,
    heading: NDArray,
    behaviour: NDArray,
    speed: NDArray,
    held: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
) -> None:
    """Write the moves of C characters into the last five arrays; the arguments before are those of ``decide``."""
    actions, pivot, turn = policy.actions, policy.pivot, np.empty(slot.shape[0])
    decide(
        actions,
        policy.coded,
        policy.shortlist,
        policy.requests,
        policy.onward,
        policy.segment_ticks,
        policy.exact,
        slot,
        node,
        place,
        heading,
        behaviour,
        speed,
        held,
        edge,
        turn,
    )
    edges, graph_target = edge, actions.target
    fill_moves(
        edges, graph_target, policy.displacement, policy.natural, edge, target, displacement, adjustment, natural
    )
    turn_moves(pivot, target, turn, adjustment)


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
