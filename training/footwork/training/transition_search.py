"""All transitions between the nodes of chains: pairs less unlike than a threshold, at local minima of the metric.

The result is that of comparing all pairs, edge for edge; most pairs are never compared. A tree of balls over short
sketches of the windows, whose distances are never above the root of s, leaves the pairs that may be under the threshold
(``ball_tree``, ``near_rows``); these are evaluated in full (``chain_minima``). Where weights depend on the pair,
sketches are of the part of them that is the same for all pairs, under which s is never more (``pair_windows``).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.training.backend import run_tasks
from footwork.training.ball_tree import tree_of
from footwork.training.chain_bands import Compared
from footwork.training.chain_minima import Rows, minima_of_rows
from footwork.training.chains import Chains
from footwork.training.near_rows import Forest, forest_of
from footwork.training.pair_estimate import estimated_pairs, require_room_for_pairs
from footwork.training.row_metric import RowMetric, uniform_rows
from footwork.training.sketches import GROUND, HEIGHT, Sketches, sketches_of
from footwork.training.transitions import Minima
from footwork.training.window_basis import shares_of
from footwork.training.windows import Windows, windows_of

TASKS = 128  # at most; the result is the same for any number
_FEWEST = 256  # rows in a task, so that small searches are not cut too fine


def search(
    chains: Chains,
    threshold: float,
    *,
    metric: RowMetric | None = None,
    active: NDArray[np.bool_] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Minima:
    """Pairs of nodes i < j with s under ``threshold`` that are local minima (conventions.md 2), sorted by i, then j.

    A pair's neighbours are those of the eight pairs around it that lie in the same two chains, the rows before and
    after an interpolated chain included. Frames of one chain nearer than half a second are no transition, nor are
    two last nodes. Of equal neighbours the first in reading order counts as the lower one.

    Args:
        chains: the nodes.
        threshold: of s, above 0.
        metric: of these chains, the uniform one where not given.
        active: only pairs with at least one of these nodes; all where not given.  # (N,)
        progress: told the share that is done.

    Raises:
        InputError: for a threshold that is not above 0, or more transitions than memory has room for, by an
            estimate.
    """
    rows, sketches = prepared(metric or uniform_rows(chains), threshold, active)
    everyone = forest_of(tree_of(sketches, np.arange(len(rows.node))), threshold)
    awake = everyone if active is None else forest_of(tree_of(sketches, np.flatnonzero(rows.awake)), threshold)
    shared = (rows, everyone, awake, threshold)
    starts = np.flatnonzero(np.arange(len(rows.first)) == rows.first)
    estimate = estimated_pairs(lambda begin, end: len(_found((begin, end), *shared)[0]), starts, len(rows.first))
    require_room_for_pairs(estimate)
    parts = run_tasks(_found, shared, _tasks(starts, len(rows.first)), progress)
    pairs = np.concatenate([part[0] for part in parts])
    return Minima(pairs[:, 0].astype(np.intp), pairs[:, 1].astype(np.intp), np.concatenate([part[1] for part in parts]))


def prepared(metric: RowMetric, threshold: float, active: NDArray[np.bool_] | None) -> tuple[Rows, Sketches]:
    """What a search needs of each row, and the sketches that trees are made of.

    Raises:
        InputError: as ``search``.
    """
    if not threshold > 0.0:
        raise InputError(f"{threshold} is no threshold, expected a number above 0", "threshold")
    chains, windows = metric.chains, windows_of(metric)
    sketches = sketches_of(shares_of(windows, GROUND, HEIGHT))
    wanted = np.ones(chains.node_count, dtype=bool) if active is None else np.asarray(active, dtype=bool)
    active_rows = (windows.node >= 0) & wanted[windows.node]
    goes_on = np.ones(chains.node_count, dtype=bool)
    goes_on[chains.last_node] = False
    compared = Compared(windows.frames, windows.start, windows.mean, windows.energy, windows.weights, windows.standing)
    rows = Rows(
        compared=compared,
        node=windows.node,
        first=windows.first,
        last=windows.last,
        leaves=(windows.node >= 0) & goes_on[windows.node],
        active=active_rows,
        awake=_awake(active_rows, windows),
        sketch=sketches.values,
        sketch_energy=sketches.energy,
    )
    return rows, sketches


def _awake(active: NDArray[np.bool_], windows: Windows) -> NDArray[np.bool_]:
    """Active rows and those next to them in their chain; at least one, so that there is something to search in."""
    at = np.flatnonzero(active)
    awake = active.copy()
    awake[np.minimum(at + 1, windows.last[at])] = True
    awake[np.maximum(at - 1, windows.first[at])] = True
    awake[0] |= not awake.any()
    return awake


def _tasks(starts: NDArray[np.intp], rows: int) -> list[tuple[int, int]]:
    """First row and the row past the last of stretches of whole chains, about equally many rows each."""
    count = max(min(TASKS, rows // _FEWEST), 1)
    aims = np.linspace(0, rows, count + 1)[:-1]
    cuts = np.unique(starts[np.minimum(np.searchsorted(starts, aims), len(starts) - 1)])
    return list(zip(cuts.tolist(), [*cuts[1:].tolist(), rows], strict=True))


def _found(
    task: tuple[int, int], rows: Rows, everyone: Forest, awake: Forest, threshold: float
) -> tuple[NDArray, NDArray]:
    # sorted here rather than in compiled code, where numpy's sort is slow to compile
    pairs, costs = minima_of_rows(*task, rows, everyone, awake, threshold)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    return pairs[order], costs[order]
