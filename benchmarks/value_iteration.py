"""How fast the steering policy is solved for: ``python benchmarks/value_iteration.py`` prints JSON."""

import json
import sys

import numpy as np

from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import SteeringTask
from footwork.training.connectivity import largest_component, restricted
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import local_minima
from footwork.training.value_iteration import solve
from support.machine import memory_bandwidth, seconds_of, spread
from support.motions import benchmark_clips


def main(threshold: float = 1.0, repeats: int = 5) -> None:
    """Measure and print."""
    name, clips = benchmark_clips()
    task = SteeringTask()
    metric, nodes = PointCloudMetric.of_clips(clips), nodes_of(clips, task.behaviours)
    minima = local_minima(metric.all_pairs(), nodes.lengths, threshold)
    whole = standard_graph(nodes, metric, minima, task.smoothness_sigma)
    graph = restricted(whole, largest_component(whole.node_count, whole.source, whole.target))
    times = seconds_of(lambda: solve(graph, task), repeats)
    table, median = solve(graph, task), float(np.median(times))
    headings = task.heading_bins
    # each edge's row is read once a behaviour, each node's row read and written; rewards once an edge
    rows = graph.edge_count * len(task.behaviours) * (headings + 1) + graph.edge_count * headings
    moved = 8 * (rows + 3 * graph.node_count * len(task.behaviours) * headings)
    bandwidth = memory_bandwidth()
    report = {
        "motion": name,
        "threshold": threshold,
        "nodes": graph.node_count,
        "edges": graph.edge_count,
        "states": table.values.size,
        "sweeps": table.sweeps,
        "residual": table.residual,
        "seconds": spread(times),
        "states_per_s": table.values.size * table.sweeps / median,
        "edge_values_per_s": graph.edge_count * len(task.behaviours) * headings * table.sweeps / median,
        "bytes_per_sweep": moved,
        "gb_per_s": moved * table.sweeps / median / 1e9,
        "memory_bandwidth_gb_per_s": bandwidth / 1e9,
        "share_of_memory_bandwidth": moved * table.sweeps / median / bandwidth,
    }
    json.dump(report, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
