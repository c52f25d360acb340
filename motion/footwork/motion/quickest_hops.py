"""Where to go at the end of each segment to be in another state as soon as possible."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.annotation import NO_WAY, Annotation
from footwork.motion.graph import MotionGraph


def quickest_hops(graph: MotionGraph, notes: Annotation) -> NDArray[np.int32]:
    """The edge to take at the end of each of G segments on the quickest way to each of S states.  # (G, S)

    It is NO_WAY where a state is not to be reached at once from the segment's own. A state that is done once is
    entered where it begins in the capture, if there is a way there; any other anywhere.
    """
    machine = notes.machine
    hop = np.full((notes.segment_count, len(machine.states)), NO_WAY, dtype=np.int32)
    for pair, ways in zip(machine.at_once, notes.ways, strict=True):
        rows, goals = notes.between(pair), notes.of_state(pair[1])
        own = notes.state[rows] == pair[0]
        delay = np.where(ways.delay[own] == NO_WAY, np.iinfo(np.int32).max, ways.delay[own])
        if machine.names[pair[1]] in machine.one_shot:
            begins = ~continued(graph, notes)[goals]
            there = (ways.edge[own][:, begins] != NO_WAY).any(axis=1, keepdims=True)
            delay = np.where(begins | ~there, delay, np.iinfo(np.int32).max)
        nearest = np.argmin(delay, axis=1)
        hop[rows[own], pair[1]] = ways.edge[own][np.arange(own.sum()), nearest]
    return hop


def continued(graph: MotionGraph, notes: Annotation) -> NDArray[np.bool_]:
    """Which segments the capture leads to from one of the same state.  # (G,)"""
    here, there = notes.segment[graph.source], notes.segment[graph.target]
    joined = graph.natural & (here != there) & (notes.state[here] == notes.state[there])
    found = np.zeros(notes.segment_count, dtype=np.bool_)
    found[there[joined]] = True
    return found
