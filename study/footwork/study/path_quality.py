"""How well a path through a motion graph moves: what its transitions cost, how far poses jump, how feet slide."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.graph import MotionGraph
from footwork.motion.graph_windows import NONE, GraphWindows, laid
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.metric import UNIT, align_windows
from footwork.motion.tick import TICK
from footwork.study.foot_slide import Slide, slide_of_capture, slide_of_steps, soles
from footwork.study.graph_paths import path_clip, path_nodes, path_seconds

_EDGES_AT_ONCE = 512


def path_quality(graph: MotionGraph, edges: NDArray[np.int64]) -> dict[str, Any]:
    """The figures of a path, JSON-able.

    ``transition_s`` are costs s of the edges that do not follow the capture, ``transition_cm`` the same as root mean
    square distance over the window, ``pose_jump_cm`` that of the two poses at the jump alone; all three are None on a
    path without transitions. ``foot_slide_cm_s`` is the slide along the whole path, ``foot_slide_parts`` what captured
    steps, interpolated steps and transitions have in it, and ``source_foot_slide_cm_s`` that of the clips that the path
    takes its frames from.

    Raises:
        InputError: as ``path_nodes``.
    """
    nodes = path_nodes(graph, edges)
    jumps = edges[~graph.natural[edges]]
    sources = np.union1d(graph.clip[nodes], graph.other_clip[nodes])
    parts = slide_by_step(graph, edges)
    return {
        "seconds": path_seconds(edges),
        "transitions": len(jumps),
        "transition_s": _worst_and_mean(graph.cost[jumps]),
        "transition_cm": _worst_and_mean(100.0 * UNIT * np.sqrt(graph.cost[jumps])),
        "pose_jump_cm": _worst_and_mean(100.0 * pose_jumps(graph, jumps)),
        "foot_slide_cm_s": sum(parts.values(), Slide(0.0, 0.0)).cm_per_second,
        "foot_slide_parts": {
            name: {"cm": 100.0 * part.metres, "contact_s": part.seconds} for name, part in parts.items()
        },
        "source_foot_slide_cm_s": slide_of_capture(graph, sources).cm_per_second,
    }


def slide_by_step(graph: MotionGraph, edges: NDArray[np.int64]) -> dict[str, Slide]:
    """The foot slide along a path by kind of step: "captured", "interpolated" and "transitions"; they add up.

    Raises:
        InputError: as ``path_nodes``.
    """
    clip, nodes = path_clip(graph, edges), path_nodes(graph, edges)
    points = soles(graph.skeleton, clip_places(clip)[0])
    standing = clip.contacts[:-1] & clip.contacts[1:]
    natural, captured = graph.natural[edges], graph.original[nodes[:-1]] & graph.original[nodes[1:]]
    kinds = {"captured": natural & captured, "interpolated": natural & ~captured, "transitions": ~natural}
    return {
        name: slide_of_steps(points[:-1][steps], points[1:][steps], standing[steps], TICK)
        for name, steps in kinds.items()
    }


def pose_jumps(graph: MotionGraph, edges: NDArray[np.int64]) -> NDArray[np.float64]:
    """How far edges jump: root mean square distance of all joints between two poses that should be one, metres.

    They are the source, and the frame before the target as its velocities tell it, where the edge lays it. Natural
    edges do not jump.  # (E',) -> (E',)
    """
    source, target = graph.source[edges], graph.target[edges]
    root = graph.root_position[target] - TICK * graph.root_velocity[target].astype(np.float64)
    back = quaternion.from_rotation_vector(-TICK * graph.angular_velocity[target].astype(np.float64))
    came_from = forward(graph.skeleton, root, quaternion.multiply(back, graph.rotations[target]))[0]
    there = laid(came_from, graph.displacement[edges].astype(np.float64))
    here = graph.joint_places[source]
    return np.sqrt(np.mean(np.sum((here - there) ** 2, axis=-1), axis=-1))


def windowed_costs(graph: MotionGraph, edges: NDArray[np.int64]) -> NDArray[np.float64]:
    """s of edges by the uniform metric, computed anew from the poses in the graph (conventions.md 1 and 2).

    For an edge from i to the successor of j this is s(i, j), and agrees with the edge's cost where the metric that
    built the graph was the uniform one. NaN where the graph lacks j or a frame of the two windows, as at the ends of
    clips and of what was left out.  # (E',) -> (E',)
    """
    windows = GraphWindows(graph)
    source, similar = graph.source[edges], windows.before[graph.target[edges]]
    costs = np.full(len(edges), np.nan)
    pairs = np.stack([windows.nodes(source), windows.nodes(similar)], axis=1)
    whole = np.flatnonzero((pairs != NONE).all(axis=(1, 2)))
    for first in range(0, len(whole), _EDGES_AT_ONCE):
        some = whole[first : first + _EDGES_AT_ONCE]
        points = windows.points(pairs[some])
        costs[some] = align_windows(points[:, 0], points[:, 1]).square / UNIT**2
    return costs


def _worst_and_mean(values: NDArray) -> dict[str, float] | None:
    return {"worst": float(values.max()), "mean": float(values.mean())} if len(values) else None
