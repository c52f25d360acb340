"""Best paths through a motion graph, and what they look like: a clip of poses laid along the path's edges."""

import heapq
import math
from collections.abc import Sequence

import numba
import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.tick import TICK_RATE
from footwork.study.placing import placed_clip
from footwork.training.path_cost import ROUGHNESS


def path_costs(smoothness: ArrayLike) -> NDArray[np.float64]:
    """What edges cost a path, in frames: 1 + 5 (1 - t), so 1 for natural edges (conventions.md 4).  # (E,)"""
    return 1.0 + ROUGHNESS * (1.0 - np.asarray(smoothness, dtype=np.float64))


def best_path(
    edge_start: NDArray, target: NDArray, cost: NDArray, start: int, goals: ArrayLike, where: str = "graph"
) -> NDArray[np.int64]:
    """The edges of the cheapest path from a node to the cheapest of some nodes; none where it is one of them.

    Of equally cheap paths always the same one is found.

    Args:
        edge_start: edges of node n are ``edge_start[n]:edge_start[n + 1]``.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        cost: of each edge, not negative, such as ``path_costs``.  # (E,)
        start: a node.
        goals: nodes, at least one.
        where: what to name in errors.

    Raises:
        InputError: for nodes that are not there, no goals, or no path.
    """
    nodes = len(edge_start) - 1
    ends = np.atleast_1d(np.asarray(goals, dtype=np.int64))
    if not ends.size or min(start, ends.min()) < 0 or max(start, ends.max()) >= nodes:
        raise InputError(f"node {start} to nodes {ends.tolist()[:5]}, expected nodes 0 to {nodes - 1}", where)
    is_goal = np.zeros(nodes, dtype=np.bool_)
    is_goal[ends] = True
    edge_into, before = (np.full(nodes, -1, dtype=np.int64) for _ in range(2))
    cost = np.ascontiguousarray(cost, dtype=np.float64)
    end = _search(edge_start, target, cost, start, is_goal, edge_into, before)
    if end < 0:
        raise InputError(f"no path from node {start} to any of {len(ends)} nodes, expected connected nodes", where)
    edges = []
    while end != start:
        edges.append(edge_into[end])
        end = before[end]
    return np.array(edges[::-1], dtype=np.int64)


def best_path_through(graph: MotionGraph, stops: Sequence[ArrayLike], ticks: int = 0) -> NDArray[np.int64]:
    """The edges of a path that comes through several places in turn, each time the cheapest way on.

    Args:
        graph: the graph.
        stops: a node to begin at, then for each stop a node or several of which the cheapest to reach will do.
        ticks: after each stop but the last, first go on naturally for so many ticks where there is a way.

    Raises:
        InputError: for fewer than two stops, several first nodes, nodes that are not there, or stops with no way on.
    """
    if len(stops) < 2 or np.size(stops[0]) != 1:
        raise InputError(f"{len(stops)} stops, expected one node and then at least one stop", graph.where)
    cost = path_costs(graph.smoothness)
    node, edges = int(np.ravel(stops[0])[0]), []
    for stop in stops[1:]:
        for part in (
            lambda here: natural_path(graph, here, ticks),
            lambda here, stop=stop: best_path(graph.edge_start, graph.target, cost, here, stop, graph.where),
        ):
            way = part(node)
            edges.append(way)
            node = int(graph.target[way[-1]]) if way.size else node
    return np.concatenate(edges)


def natural_path(graph: MotionGraph, node: int, ticks: int) -> NDArray[np.int64]:
    """The edges of the captured motion on from a node, ``ticks`` of them or fewer where it ends."""
    edges = []
    while len(edges) < ticks:
        out = np.arange(graph.edge_start[node], graph.edge_start[node + 1])
        out = out[graph.natural[out]]
        if not out.size:
            break
        edges.append(out[0])
        node = int(graph.target[out[0]])
    return np.array(edges, dtype=np.int64)


def path_nodes(graph: MotionGraph, edges: NDArray[np.int64]) -> NDArray[np.int32]:
    """The nodes that a path comes through, its first included.  # (E',) -> (E' + 1,)

    Raises:
        InputError: for no edges, or edges of which one does not begin where the one before ended.
    """
    if not len(edges):
        raise InputError("a path of no edges, expected at least one", graph.where)
    source = np.searchsorted(graph.edge_start, edges, side="right") - 1
    if (source[1:] != graph.target[edges[:-1]]).any():
        raise InputError("a path that breaks off, expected edges end to end", graph.where)
    return np.concatenate([source[:1], graph.target[edges]]).astype(np.int32)


def path_clip(graph: MotionGraph, edges: NDArray[np.int64], name: str = "path") -> Clip:
    """The poses along a path as they are, nothing smoothed, with their contacts and labels.  # (E' + 1) frames

    Raises:
        InputError: as ``path_nodes``.
    """
    return placed_clip(graph, path_nodes(graph, edges), graph.displacement[edges], name)


def path_seconds(edges: NDArray[np.int64]) -> float:
    """How long a path takes."""
    return len(edges) / TICK_RATE


@numba.njit(cache=True, nogil=True)
def _search(
    edge_start: NDArray,
    target: NDArray,
    cost: NDArray,
    start: int,
    is_goal: NDArray,
    edge_into: NDArray,
    before: NDArray,
) -> int:
    """Dijkstra's search until a goal comes up; fills how each node was reached and returns the goal, -1 for none."""
    best = np.full(is_goal.shape[0], math.inf)
    best[start] = 0.0
    heap = [(0.0, np.int64(start))]
    while heap:
        length, node = heapq.heappop(heap)
        if length > best[node]:
            continue
        if is_goal[node]:
            return int(node)
        for edge in range(edge_start[node], edge_start[node + 1]):
            end = np.int64(target[edge])
            further = length + cost[edge]
            if further < best[end]:
                best[end] = further
                edge_into[end], before[end] = edge, node
                heapq.heappush(heap, (further, end))
    return -1
