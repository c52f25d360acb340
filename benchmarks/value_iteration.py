"""How fast the steering policy is solved for: ``python benchmarks/value_iteration.py`` prints JSON.

First against quantecon's modified policy iteration and plain numpy sweeps on a random process of our structure, then
on our own graphs and on one of the size of a large well-connected graph.
"""

import json
import math
import sys
from typing import Any

import numpy as np

from footwork.motion.actions import Actions
from footwork.motion.metric import PointCloudMetric
from footwork.motion.mirror import mirrored
from footwork.motion.task import SteeringTask
from footwork.motion.threads import THREADS
from footwork.training.connectivity import largest_component, restricted
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import local_minima
from footwork.training.value_iteration import Solution, fixed_point, solve
from support.machine import memory_bandwidth, seconds_of, spread, timed
from support.motions import benchmark_clips
from support.rival_solvers import by_numpy, by_quantecon, pairs_of, quantecon_process
from support.steering_process import captured_process, random_process

RESIDUAL = 1e-6
NUMPY_SWEEPS = 100
THRESHOLDS = (1.0, 5.0)


def main(nodes: int = 20_000, edges: int = 8, repeats: int = 3) -> None:
    """Measure and print."""
    report = {
        "threads": THREADS,
        "against_others": against_others(nodes, edges, repeats),
        "own_graphs": own_graphs(repeats),
        "large": large(),
    }
    json.dump(report, sys.stdout, indent=2)
    print()


def against_others(nodes: int, edges: int, repeats: int) -> dict[str, Any]:
    """The same process by each solver, to the same residual; numpy stops early, so its time is at least as told."""
    task = SteeringTask(behaviours=("stop", "walk"), discount=0.99)
    actions = random_process(nodes, edges, task)
    pairs = pairs_of(actions, task)
    ours, times = _ours(actions, task, repeats)
    process, nbytes = quantecon_process(pairs, task.discount)
    by_quantecon(process, nbytes, task.discount, 1.0)  # compiles what it compiles
    rivals = {
        "quantecon": lambda: by_quantecon(process, nbytes, task.discount, RESIDUAL),
        "numpy": lambda: by_numpy(pairs, task.discount, RESIDUAL, NUMPY_SWEEPS),
    }
    median = float(np.median(times))
    report: dict[str, Any] = {
        "states": [nodes, len(task.behaviours) * task.heading_bins],
        "actions": edges,
        "discount": task.discount,
        "residual": RESIDUAL,
        "ours": _figures(ours, times, actions, task),
    }
    for name, work in rivals.items():
        found: list[Any] = []
        seconds = timed(lambda work=work, found=found: found.append(work()))
        apart = np.abs(found[0].values - ours.values.astype(np.float64).ravel()).max()
        report[name] = {
            "seconds": seconds,
            "improvements": found[0].improvements,
            "residual": found[0].residual,
            "mb": found[0].nbytes / 1e6,
            "largest_difference_to_ours": float(apart),
            "times_ours": seconds / median,
        }
    return report


def _ours(actions: Actions, task: SteeringTask, repeats: int) -> tuple[Solution, list[float]]:
    onward = actions.edge_start[:-1].copy()
    found: list[Solution] = []
    times = seconds_of(lambda: found.append(fixed_point(actions, onward, task, tolerance=RESIDUAL)), repeats)
    return found[-1], times


def _figures(found: Solution, times: list[float], actions: Actions, task: SteeringTask) -> dict[str, Any]:
    """What it took, and the part of the memory's bandwidth that the sweeps reached."""
    number, states = found.values.itemsize, found.values.size
    # to follow a policy is to write where its states lead, count that, take them away one after another, and read
    # policy and values; a greedy sweep reads a row of values an edge and behaviour, writes values and policy, and
    # compares new values with old ones
    cheap = states * (75 + 6 * number)
    greedy = number * len(actions.target) * len(task.behaviours) * (task.heading_bins + 1) + states * (4 + 5 * number)
    moved = found.improvements * greedy + (found.sweeps - found.improvements) * cheap
    bandwidth, median = memory_bandwidth(threads=THREADS), float(np.median(times))
    return {
        "seconds": spread(times),
        "improvements": found.improvements,
        "sweeps": found.sweeps,
        "residual": found.residual,
        "mb": found.bytes / 1e6,
        "gb_per_s": moved / median / 1e9,
        "memory_bandwidth_gb_per_s": bandwidth / 1e9,
        "share_of_memory_bandwidth": moved / median / bandwidth,
    }


def own_graphs(repeats: int) -> list[dict[str, Any]]:
    """Seconds to a table, its residual check among them, as captured and mirrored with turns of up to 6 degrees."""
    name, clips = benchmark_clips()
    plain, turning = SteeringTask(), SteeringTask(warp=math.radians(6.0))
    reports = []
    for task, motions in ((plain, clips), (turning, [*clips, *map(mirrored, clips)])):
        metric, nodes = PointCloudMetric.of_clips(motions), nodes_of(motions, task.behaviours)
        costs = metric.all_pairs()
        for threshold in THRESHOLDS:
            minima = local_minima(costs, nodes.lengths, threshold)
            whole = standard_graph(nodes, metric, minima, task.smoothness_sigma)
            graph = restricted(whole, largest_component(whole.node_count, whole.source, whole.target))
            times = seconds_of(lambda graph=graph, task=task: solve(graph, task), repeats)
            table = solve(graph, task)
            reports.append(
                {
                    "motion": name + (" mirrored, turned by up to 6 degrees" if task.warp else ""),
                    "threshold": threshold,
                    "nodes": graph.node_count,
                    "edges": graph.edge_count,
                    "states": table.values.size,
                    "sweeps": table.sweeps,
                    "residual": table.residual,
                    "seconds": spread(times),
                }
            )
    return reports


def large(nodes: int = 40_000, transitions: int = 25_000) -> dict[str, Any]:
    """Seconds for as many nodes and edges as a large well-connected graph has, with turns of up to 6 degrees."""
    task = SteeringTask(warp=math.radians(6.0))
    actions = captured_process(nodes, transitions, task)
    found: list[Solution] = []
    seconds = timed(lambda: found.append(fixed_point(actions, actions.edge_start[:-1].copy(), task)))
    return {
        "nodes": nodes,
        "edges": nodes + transitions,
        "states": found[0].values.size,
        "improvements": found[0].improvements,
        "sweeps": found[0].sweeps,
        "residual": found[0].residual,
        "mb": found[0].bytes / 1e6,
        "seconds": seconds,
    }


if __name__ == "__main__":
    main()
