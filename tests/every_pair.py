"""Transitions over chains by comparing every pair: what the search has to find."""

import numpy as np

from footwork.motion.dynamics_metric import DynamicsMetric
from footwork.motion.metric import Metric, PointCloudMetric
from footwork.training.chains import Chains
from footwork.training.row_metric import RowMetric, contacts_of_rows, uniform_rows
from footwork.training.transitions import Minima, local_minima


def transitions_by_brute_force(
    chains: Chains, threshold: float, metric: RowMetric | None = None, active=None
) -> Minima:
    """All pairs of rows by the metric's own sums, minima among the rows, and of these the pairs of nodes."""
    each_pair = metric_of_rows(metric or uniform_rows(chains))
    fringe = np.minimum(chains.context, 1)
    length = chains.length + 2 * fringe
    start = np.cumsum(length) - length
    row = np.arange(length.sum()) + np.repeat(chains.first_row + chains.context - fringe - start, length)
    node = np.full(chains.row_count, -1)
    node[chains.row_of_node] = np.arange(chains.node_count)
    found = local_minima(each_pair.all_pairs()[np.ix_(row, row)], length.tolist(), threshold)
    i, j = node[row[found.i]], node[row[found.j]]
    last = np.isin(np.arange(chains.node_count), chains.last_node)
    kept = (i >= 0) & (j >= 0) & ~(last[i] & last[j])
    if active is not None:
        kept &= active[i] | active[j]
    return Minima(i[kept], j[kept], found.cost[kept])


def metric_of_rows(metric: RowMetric) -> Metric:
    """The metric of all rows, each chain taken for a clip."""
    starts = metric.chains.first_row[1:]
    points = np.split(metric.points, starts)
    if metric.pair is None:
        return PointCloudMetric(points, metric.weights)
    contacts = contacts_of_rows(metric.chains, np.arange(metric.chains.row_count))
    return DynamicsMetric(points, np.split(contacts, starts), metric.pair)
