"""Paths through the states of an annotated graph, by its tables of quickest ways: for looking at them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.annotation import NO_WAY, Annotation
from footwork.motion.graph import MotionGraph
from footwork.study.graph_paths import best_path, path_costs


def path_through_states(
    graph: MotionGraph, notes: Annotation, start: int, states: Sequence[int], ticks: int
) -> NDArray[np.int64]:
    """The edges of a path from a node through states in turn, in each for some ticks as captured or till it ends.

    Where a state is to be reached at once the path takes the quickest way to the nearest beginning of a captured
    stretch of it, else the cheapest to any of its frames.

    Args:
        graph: the graph.
        notes: its states.
        start: a node.
        states: numbers of states, each another than the one before.
        ticks: how long to go on in each at most.

    Raises:
        InputError: where there is no way to a state.
    """
    node, edges = start, [_onward(graph, notes, start, ticks)]
    for number in states:
        if edges[-1].size:
            node = int(graph.target[edges[-1][-1]])
        pair = int(notes.state[notes.segment[node]]), number
        way = _at_once(graph, notes, node, pair) if pair in notes.machine.at_once else _to(graph, notes, node, number)
        edges += [way, _onward(graph, notes, int(graph.target[way[-1]]), ticks)]
        node = int(graph.target[way[-1]])
    return np.concatenate(edges)


def _onward(graph: MotionGraph, notes: Annotation, node: int, ticks: int) -> NDArray[np.int64]:
    """The captured motion on from a node within its state."""
    edges = []
    while len(edges) < ticks:
        edge = int(graph.edge_start[node])
        onward = edge < graph.edge_start[node + 1] and graph.natural[edge]
        if not onward or notes.state[notes.segment[graph.target[edge]]] != notes.state[notes.segment[node]]:
            break
        edges.append(edge)
        node = int(graph.target[edge])
    return np.array(edges, dtype=np.int64)


def _at_once(graph: MotionGraph, notes: Annotation, node: int, pair: tuple[int, int]) -> NDArray[np.int64]:
    """To the end of the node's segment, and from there the quickest way to the nearest beginning of a stretch."""
    goals, rows = notes.of_state(pair[1]), notes.between(pair)
    here = int(notes.segment[node])
    delay = notes.ways[notes.machine.at_once.index(pair)].delay[np.searchsorted(rows, here)]
    begins = (delay != NO_WAY) & ~_continues(graph, notes)[goals]
    if not begins.any():
        names = " to ".join(notes.machine.names[number] for number in pair)
        raise InputError(f"no way from {names} from segment {here}, expected one", notes.where)
    goal = int(goals[begins][np.argmin(delay[begins])])
    edges = []
    for hop in notes.hops(graph, pair, here, goal):
        edges += [*_along(graph, node, int(notes.last[notes.segment[node]])), hop]
        node = int(graph.target[hop])
    return np.array(edges, dtype=np.int64)


def _continues(graph: MotionGraph, notes: Annotation) -> NDArray[np.bool_]:
    """Which segments the capture leads to from one of the same state.  # (G,)"""
    here, there = notes.segment[graph.source], notes.segment[graph.target]
    joined = graph.natural & (here != there) & (notes.state[here] == notes.state[there])
    continues = np.zeros(notes.segment_count, dtype=np.bool_)
    continues[there[joined]] = True
    return continues


def _along(graph: MotionGraph, node: int, last: int) -> list[int]:
    """The only edges from a node to the end of its segment."""
    return graph.edge_start[node:last].tolist()


def _to(graph: MotionGraph, notes: Annotation, node: int, number: int) -> NDArray[np.int64]:
    goals = np.flatnonzero(notes.state[notes.segment] == number)
    return best_path(graph.edge_start, graph.target, path_costs(graph.smoothness), node, goals, graph.where)
