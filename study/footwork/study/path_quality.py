"""How well a path through a motion graph moves: what its transitions cost, how far poses jump, how feet slide."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.alignment import turn
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.metric import UNIT, align_windows
from footwork.motion.tick import TICK
from footwork.motion.window import RADIUS
from footwork.study.foot_slide import Slide, slide_of_capture, slide_of_steps, soles
from footwork.study.graph_paths import path_clip, path_nodes, path_seconds

_NONE = -1
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
    there = _laid(came_from, graph.displacement[edges].astype(np.float64))
    here = forward(graph.skeleton, graph.root_position[source], graph.rotations[source])[0]
    return np.sqrt(np.mean(np.sum((here - there) ** 2, axis=-1), axis=-1))


def windowed_costs(graph: MotionGraph, edges: NDArray[np.int64]) -> NDArray[np.float64]:
    """s of edges by the uniform metric, computed anew from the poses in the graph (conventions.md 1 and 2).

    For an edge from i to the successor of j this is s(i, j), and agrees with the edge's cost where the metric that
    built the graph was the uniform one. NaN where the graph lacks j or a frame of the two windows, as at the ends of
    clips and of what was left out.  # (E',) -> (E',)
    """
    before, after, step = _natural_neighbours(graph)
    source, similar = graph.source[edges], before[graph.target[edges]]
    costs = np.full(len(edges), np.nan)
    pairs = np.stack([_windows(source, before, after), _windows(similar, before, after)], axis=1)
    whole = np.flatnonzero((pairs != _NONE).all(axis=(1, 2)))
    for first in range(0, len(whole), _EDGES_AT_ONCE):
        some = whole[first : first + _EDGES_AT_ONCE]
        points = _window_points(graph, pairs[some], step)
        costs[some] = align_windows(points[:, 0], points[:, 1]).square / UNIT**2
    return costs


def _worst_and_mean(values: NDArray) -> dict[str, float] | None:
    return {"worst": float(values.max()), "mean": float(values.mean())} if len(values) else None


def _natural_neighbours(graph: MotionGraph) -> tuple[NDArray, NDArray, NDArray]:
    """The node before (N,) and after each (N,) in its motion, -1 for none, and the step to the latter (N, 3)."""
    edges = np.flatnonzero(graph.natural)
    source, target = graph.source[edges], graph.target[edges]
    before, after = (np.full(graph.node_count, _NONE, dtype=np.int64) for _ in range(2))
    before[target], after[source] = source, target
    step = np.zeros((graph.node_count, 3))
    step[source] = graph.displacement[edges]
    return before, after, step


def _windows(nodes: NDArray, before: NDArray, after: NDArray) -> NDArray[np.int64]:
    """The nodes of each node's window, -1 where there is none.  # (n,) -> (n, LENGTH)"""
    early, late = [np.asarray(nodes, dtype=np.int64)], []
    here = early[0]
    for _ in range(RADIUS):
        early.append(np.where(early[-1] == _NONE, _NONE, before[early[-1]]))
        here = np.where(here == _NONE, _NONE, after[here])
        late.append(here)
    return np.stack([*early[::-1], *late], axis=1)


def _window_points(graph: MotionGraph, windows: NDArray, step: NDArray) -> NDArray[np.float64]:
    """Joints of whole windows, each in the planar frame of its first node.  # (..., LENGTH) -> (..., LENGTH, J, 3)"""
    points = forward(graph.skeleton, graph.root_position[windows], graph.rotations[windows])[0]
    place = np.zeros((*windows.shape[:-1], 3))
    for at in range(1, windows.shape[-1]):
        move = step[windows[..., at - 1]]
        x, z = turn(move[..., 0], move[..., 1], place[..., 2])
        place = place + np.stack([x, z, move[..., 2]], axis=-1)
        points[..., at, :, :] = _laid(points[..., at, :, :], place)
    return points


def _laid(points: NDArray, place: NDArray) -> NDArray[np.float64]:
    """Points (..., J, 3) in a planar frame that lies at a place x, z, yaw (..., 3)."""
    x, z = turn(points[..., 0], points[..., 2], place[..., 2, None])
    return np.stack([x + place[..., 0, None], points[..., 1], z + place[..., 1, None]], axis=-1)
