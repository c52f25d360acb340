"""Value iteration: the reward every frame promises under every command, if the command stays (conventions.md 5)."""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.motion.threads import THREADS

TOLERANCE = 1e-3
MAX_SWEEPS = 1500


class _Model(NamedTuple):
    """The graph and the task as one sweep needs them; E edges, H headings."""

    edge_start: NDArray[np.int32]  # (N + 1,)
    target: NDArray[np.int32]  # (E,)
    behaviour: NDArray[np.int16]  # (N,)
    reward: NDArray[np.float64]  # (E, H) of being at the target when its behaviour is asked for
    shift: NDArray[np.intp]  # (E,) whole bins, 0 <= shift < H, from a heading before the edge to the one after
    share: NDArray[np.float64]  # (E,) rest of that shift, a share of a bin
    discount: float


def solve(
    graph: MotionGraph,
    task: SteeringTask,
    *,
    tolerance: float = TOLERANCE,
    max_sweeps: int = MAX_SWEEPS,
    progress: Callable[[float], None] | None = None,
) -> PolicyTable:
    """The fixed point of V(n, b, h) = max over edges of the edge's value, ``lookahead.edge_value``.

    Every sweep reads the values of the one before it alone, so the result does not depend on the threads.

    Args:
        graph: every node has an edge.
        task: axes, reward and discount.
        tolerance: stop when no value changes by as much as this.
        max_sweeps: stop after so many; the table then says that it is not converged.
        progress: told the share of the work done after each sweep.

    Raises:
        InputError: for other behaviours than the graph's, or a node without edges.
    """
    _check(graph, task)
    model = _model(graph, task)
    shape = (graph.node_count, len(task.behaviours), 2 * task.heading_bins)
    old, new = np.zeros(shape), np.empty(shape)
    spans = _spans(graph.edge_start)
    residual, sweeps, first = math.inf, 0, 0.0
    with ThreadPoolExecutor(THREADS) as pool:
        while residual >= tolerance and sweeps < max_sweeps:
            changes = [pool.submit(_sweep, *model, begin, end, old, new) for begin, end in spans]
            residual, old, new = max(change.result() for change in changes), new, old
            sweeps, first = sweeps + 1, first or residual
            if progress is not None:
                progress(_share_done(residual, first, tolerance))
    values = old[..., : task.heading_bins].astype(np.float32)
    return PolicyTable(task, values, float(residual), sweeps, bool(residual < tolerance))


def _check(graph: MotionGraph, task: SteeringTask) -> None:
    if graph.behaviours != task.behaviours:
        problem = f"behaviours {', '.join(task.behaviours)}, the graph has {', '.join(graph.behaviours)}"
        raise InputError(problem, "task")
    graph.require_no_dead_ends()


def _model(graph: MotionGraph, task: SteeringTask) -> _Model:
    yaw = graph.displacement[:, 2].astype(np.float64)
    shown = graph.behaviour[graph.target]
    # an edge shifts all headings alike: heading h - yaw lies ``bins`` bins from bin h
    bins = -yaw * (task.heading_bins / (2.0 * np.pi))
    whole = np.floor(bins)
    asked = np.maximum(shown, 0)[:, None]
    quality = task.control_quality(task.headings - yaw[:, None], asked, shown[:, None])
    return _Model(
        edge_start=graph.edge_start,
        target=graph.target,
        behaviour=graph.behaviour,
        reward=graph.smoothness[:, None] * quality,
        shift=whole.astype(np.intp) % task.heading_bins,
        share=bins - whole,
        discount=task.discount,
    )


def _spans(edge_start: NDArray[np.int32]) -> list[tuple[int, int]]:
    """Stretches of nodes with about as many edges each, one a thread."""
    cuts = np.searchsorted(edge_start, np.linspace(0, edge_start[-1], THREADS + 1)[1:-1])
    edges = [0, *cuts.tolist(), len(edge_start) - 1]
    return list(pairwise(edges))


def _share_done(residual: float, first: float, tolerance: float) -> float:
    """How far the residual has come on its way, which is straight in the logarithm."""
    if residual < tolerance or first <= tolerance:
        return 1.0
    return math.log(first / residual) / math.log(first / tolerance)


@numba.njit(cache=True, nogil=True)
def _sweep(
    edge_start: NDArray,
    target: NDArray,
    behaviour: NDArray,
    reward: NDArray,
    shift: NDArray,
    share: NDArray,
    discount: float,
    begin: int,
    end: int,
    old: NDArray,
    new: NDArray,
) -> float:
    """One sweep over the nodes begin..end-1; the largest change.

    Rows of values are written twice over, (N, B, 2H), so that a row shifted by some bins is a plain stretch of
    memory.
    """
    headings = reward.shape[1]
    best = np.empty(headings)
    largest = 0.0
    for node in range(begin, end):
        for wanted in range(old.shape[1]):
            best[:] = -np.inf
            for edge in range(edge_start[node], edge_start[node + 1]):
                there = target[edge]
                ahead = old[there, wanted, shift[edge] : shift[edge] + headings + 1]
                low, high = discount * (1.0 - share[edge]), discount * share[edge]
                if behaviour[there] == wanted:
                    for h in range(headings):
                        best[h] = max(best[h], reward[edge, h] + (low * ahead[h] + high * ahead[h + 1]))
                else:
                    for h in range(headings):
                        best[h] = max(best[h], low * ahead[h] + high * ahead[h + 1])
            row, before = new[node, wanted], old[node, wanted]
            for h in range(headings):
                largest = max(largest, abs(best[h] - before[h]))
                row[h] = best[h]
                row[h + headings] = best[h]
    return largest
