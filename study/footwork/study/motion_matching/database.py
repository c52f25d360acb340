"""What motion matching searches: the features of a graph's frames, their boxes, and which frames answer what."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.task import HEADED, ONE_SHOT
from footwork.motion.turn_warp import turn_warp
from footwork.study.motion_matching.chains import Chains, chains_of
from footwork.study.motion_matching.features import normalised, raw_features
from footwork.study.motion_matching.options import MatchingOptions
from footwork.study.motion_matching.search import SearchSets, search_sets


class Database(NamedTuple):
    """Arrays that the tick's kernel reads, of N frames and B behaviours.

    Args:
        values: features of every frame.  # (N, 27) float32
        offset: of the features.  # (27,)
        scale: of the features.  # (27,)
        sets: the sets of frames that are searched.
        set_of: which of them answers a behaviour.  # (B,)
        strict: whether a behaviour is answered by frames of it alone.  # (B,) bool
        speed: what a behaviour is taken to ask for, m/s.  # (B,)
        behaviour: of every frame, an index.  # (N,)
        headed: whether a frame is judged by its heading.  # (N,) bool
        edge: the natural edge out of every frame, -1 for none.  # (N,)
        displacement: of the graph's edges.  # (E, 3)
        root_speed: how fast the root of a frame goes over the ground, m/s.  # (N,)
        pivot: where turns of a frame are charged least, in its planar frame, metres.  # (N, 2)
        run_left: how many more frames of its own behaviour follow a frame.  # (N,)
    """

    values: NDArray[np.float32]
    offset: NDArray[np.float64]
    scale: NDArray[np.float64]
    sets: SearchSets
    set_of: NDArray[np.int64]
    strict: NDArray[np.bool_]
    speed: NDArray[np.float64]
    behaviour: NDArray[np.int16]
    headed: NDArray[np.bool_]
    edge: NDArray[np.int32]
    displacement: NDArray[np.float32]
    root_speed: NDArray[np.float64]
    pivot: NDArray[np.float64]
    run_left: NDArray[np.int64]


def database_of(graph: MotionGraph, options: MatchingOptions) -> Database:
    """The database of a graph.

    Raises:
        InputError: for natural edges that do not lead to the next node, or no frame that may be searched.
    """
    chains = chains_of(graph)
    features = normalised(raw_features(graph, chains), options.weights)
    root_speed = np.hypot(graph.root_velocity[:, 0], graph.root_velocity[:, 2]).astype(np.float64)
    strict = np.array([options.by_behaviour or name in ONE_SHOT for name in graph.behaviours])
    run_left = _run_left(graph, chains)
    members, set_of = _members(graph, chains, strict, run_left, options)
    return Database(
        values=features.values,
        offset=features.offset,
        scale=features.scale,
        sets=search_sets(features.values, members),
        set_of=set_of,
        strict=strict & (set_of > 0),
        speed=_speeds(graph, root_speed),
        behaviour=graph.behaviour,
        headed=np.isin(graph.behaviour, [index for index, name in enumerate(graph.behaviours) if name in HEADED]),
        edge=chains.edge,
        displacement=graph.displacement,
        root_speed=root_speed,
        pivot=_cheapest_pivots(turn_warp(graph).moments),
        run_left=run_left,
    )


def _cheapest_pivots(moments: NDArray) -> NDArray[np.float64]:
    """The points about which turns cost least: the mean of what is charged for.  # (N, 4) -> (N, 2)"""
    return moments[:, 1:3] / moments[:, :1]


def _speeds(graph: MotionGraph, root_speed: NDArray) -> NDArray[np.float64]:
    """The median speed of each behaviour's own frames, 0 for stop and for what no frame shows.  # (B,)"""
    speed = np.zeros(len(graph.behaviours))
    for index, name in enumerate(graph.behaviours):
        own = root_speed[graph.behaviour == index]
        if own.size and name != "stop":
            speed[index] = np.median(own)
    return speed


def _members(
    graph: MotionGraph, chains: Chains, strict: NDArray, run_left: NDArray, options: MatchingOptions
) -> tuple[list[NDArray[np.intp]], NDArray[np.int64]]:
    """The sets of frames to search, all that may be first, and the set of each behaviour.

    A search finds a frame like the one shown now, and the next one is what will be shown: so it is the next frame that
    must show the behaviour. Where no frame does, all are searched.
    """
    node = np.arange(graph.node_count)
    everything = chains.last + 1 - node > max(options.skipped_end, 1)
    if not everything.any():
        problem = f"no stretch of frames longer than the {options.skipped_end} at its end that are not searched"
        raise InputError(problem, graph.where)
    following = np.minimum(node + 1, chains.last)
    lasts = run_left[following] >= options.skipped_run_end
    members, set_of = [np.flatnonzero(everything)], np.zeros(len(graph.behaviours), np.int64)
    for index in np.flatnonzero(strict):
        shown = everything & (graph.behaviour[following] == index)
        if shown.any():
            set_of[index] = len(members)
            members.append(np.flatnonzero(shown & lasts if (shown & lasts).any() else shown))
    return members, set_of


def _run_left(graph: MotionGraph, chains: Chains) -> NDArray[np.int64]:
    """How many more frames of its own behaviour follow each node.  # (N,)"""
    node = np.arange(graph.node_count)
    over = np.append(graph.behaviour[1:] != graph.behaviour[:-1], True) | (node == chains.last)
    ends = np.flatnonzero(over)
    return ends[np.searchsorted(ends, node)] - node
