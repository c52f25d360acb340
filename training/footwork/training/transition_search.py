"""All transitions between the nodes of chains: pairs less unlike than a threshold, at local minima of the metric."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion.metric import PointCloudMetric
from footwork.training.chains import Chains
from footwork.training.transitions import Minima, local_minima


def search(
    chains: Chains,
    threshold: float,
    *,
    joint_weights: ArrayLike | None = None,
    active: NDArray[np.bool_] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Minima:
    """Pairs of nodes i < j with s under ``threshold`` that are local minima (conventions.md 2), sorted by i, then j."""
    rows = chains.length + 2 * chains.context
    metric = PointCloudMetric(np.split(chains.places, np.cumsum(rows)[:-1]), joint_weights)
    fringe = np.minimum(chains.context, 1)
    length = chains.length + 2 * fringe
    start = np.cumsum(length) - length
    row = np.arange(length.sum()) + np.repeat(chains.first_row + chains.context - fringe - start, length)
    node = np.full(chains.row_count, -1)
    node[chains.row_of_node] = np.arange(chains.node_count)
    costs = metric.all_pairs()[np.ix_(row, row)]
    found = local_minima(costs, length.tolist(), threshold)
    i, j = node[row[found.i]], node[row[found.j]]
    last = np.zeros(chains.node_count, dtype=bool)
    last[chains.last_node] = True
    kept = (i >= 0) & (j >= 0) & ~(last[i] & last[j])
    if active is not None:
        kept &= active[i] | active[j]
    return Minima(i[kept], j[kept], found.cost[kept])
