"""Transitions over chains by comparing every pair: what the search has to find."""

import numpy as np

from footwork.motion.metric import PointCloudMetric
from footwork.training.chains import Chains
from footwork.training.transitions import Minima, local_minima


def transitions_by_brute_force(chains: Chains, threshold: float, joint_weights=None, active=None) -> Minima:
    """All pairs of rows by the metric's own sums, minima among the rows, and of these the pairs of nodes."""
    rows = chains.length + 2 * chains.context
    metric = PointCloudMetric(np.split(chains.places, np.cumsum(rows)[:-1]), joint_weights)
    fringe = np.minimum(chains.context, 1)
    length = chains.length + 2 * fringe
    start = np.cumsum(length) - length
    row = np.arange(length.sum()) + np.repeat(chains.first_row + chains.context - fringe - start, length)
    node = np.full(chains.row_count, -1)
    node[chains.row_of_node] = np.arange(chains.node_count)
    found = local_minima(metric.all_pairs()[np.ix_(row, row)], length.tolist(), threshold)
    i, j = node[row[found.i]], node[row[found.j]]
    last = np.isin(np.arange(chains.node_count), chains.last_node)
    kept = (i >= 0) & (j >= 0) & ~(last[i] & last[j])
    if active is not None:
        kept &= active[i] | active[j]
    return Minima(i[kept], j[kept], found.cost[kept])
