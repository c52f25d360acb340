"""A walk along the best path from one place of a motion graph to another, as a character shows it."""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import moves_along
from footwork.motion.tick import TICK_RATE
from footwork.runtime.world import World
from footwork.study.graph_paths import best_path_through, natural_path, path_nodes
from footwork.study.placing import clip_of_poses
from footwork.study.tour import middles


def shown_walk(graph: MotionGraph, start: str, end: str) -> Clip:
    """The cheapest way from one place to another, and a second on from there, smoothed and with held feet.

    Args:
        graph: the graph.
        start: a node by its number, a label or a behaviour; of several nodes it is the first stretch's.
        end: likewise; of several nodes it is the cheapest to reach.

    Raises:
        InputError: for a place that is not there, or no way.
    """
    first = places_called(graph, start)[:1]
    edges = best_path_through(graph, [first, places_called(graph, end)])
    arrived = int(graph.target[edges[-1]]) if edges.size else int(first[0])
    return shown_path(graph, np.concatenate([edges, natural_path(graph, arrived, TICK_RATE)]), f"{start} to {end}")


def places_called(graph: MotionGraph, name: str) -> NDArray[np.intp]:
    """The nodes that a place names: one by its number, the middles of a label's stretches, all of a behaviour.

    Raises:
        InputError: for a number or a name that is not there.
    """
    if name.isdecimal():
        if int(name) >= graph.node_count:
            raise InputError(f"node {name}, expected 0 to {graph.node_count - 1}", graph.where)
        return np.array([int(name)])
    captured = set(graph.label[graph.original].tolist())
    labels = [label for number, label in enumerate(graph.labels) if label and number in captured]
    behaviours = [word for number, word in enumerate(graph.behaviours) if (graph.behaviour == number).any()]
    if name in labels:
        return middles(graph, name)
    if name in behaviours:
        return np.flatnonzero(graph.behaviour == graph.behaviours.index(name))
    known = ", ".join(dict.fromkeys([*labels, *behaviours]))
    raise InputError(f"no place {name!r}, expected a node's number or one of {known}", graph.where)


def shown_path(graph: MotionGraph, edges: NDArray[np.int64], name: str) -> Clip:
    """A walk along a path as a character shows it.  # (E' + 1) frames

    Raises:
        InputError: for no edges, or edges that are not end to end.
    """
    nodes, world = path_nodes(graph, edges), World(graph, 1)
    world.spawn(int(nodes[0]), 0.0, 0.0, 0.0)
    shown = [[part[0].copy() for part in world.show(1.0)]]
    for edge in edges:
        world.step(moves_along(graph, np.array([edge], dtype=np.int32)))
        shown.append([part[0].copy() for part in world.show(1.0)])
    root, rotations = zip(*shown, strict=True)
    return clip_of_poses(graph, nodes, root, rotations, name)
