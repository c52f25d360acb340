"""Speed of the node reduction: ``python benchmarks/reduction.py [MU]`` prints JSON.

Set against SciPy's Dijkstra over the whole graph, a few sources of it extrapolated to all, and against the time that
this machine's memory needs to bring along the edges that the reduction looks at. Runs on the graph of the first clips
of dataset3's core ranges where they lie beside the checkout, on a made-up graph otherwise.
"""

import json
import sys
import time

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from footwork.motion.task import SteeringTask
from footwork.training.chain_edges import edges_of_chains
from footwork.training.interpolation import interpolated
from footwork.training.memory import peak_rss_mb
from footwork.training.path_cost import UNIT, path_costs
from footwork.training.reduction import STREAMS, reduced
from footwork.training.transition_search import search
from support.machine import memory_bandwidth
from support.motions import MOTIONS, ROOT, benchmark_clips

CLIPS = 4
THRESHOLD = 0.2
EDGE_BYTES = 6  # target and cost
Graph = tuple[int, int, np.ndarray, np.ndarray, np.ndarray]


def real_graph() -> tuple[str, Graph]:
    """The whole graph of a few clips at nine weights, and its name."""
    name, clips = benchmark_clips()
    task = SteeringTask()
    chains, _ = interpolated(clips[:CLIPS], task.behaviours)
    edges = edges_of_chains(chains, search(chains, THRESHOLD), THRESHOLD)
    base = path_costs(edges.cost, task.smoothness_sigma)
    graph = chains.node_count, chains.original_count, edges.source, edges.target, base
    return f"{name}, {CLIPS} clips", graph


def made_up_graph() -> tuple[str, Graph]:
    """A graph without any motion behind it."""
    sys.path.insert(0, str(ROOT / "tests"))
    from random_graphs import random_graph

    return "made up", random_graph(0, clips=16, chains=8000, edges=1_500_000, longest=100)


def dijkstra_seconds(graph: Graph, sources: int = 3) -> float:
    """SciPy's time for one source after the other over the whole graph, extrapolated to all."""
    count, originals, source, target, base = graph
    matrix = csr_array((base.astype(np.float64), (source, target)), shape=(count, count))
    started = time.perf_counter()
    for origin in np.linspace(0, originals - 1, sources, dtype=int):
        dijkstra(matrix, indices=origin, return_predecessors=True)
    return (time.perf_counter() - started) / sources * originals


def main() -> None:
    """Measure and print."""
    mu = float(sys.argv[1]) if len(sys.argv) > 1 else 5.0
    name, graph = real_graph() if MOTIONS.is_dir() else made_up_graph()
    two = np.array([0], dtype=np.int32), np.array([1], dtype=np.int32), np.array([UNIT], dtype=np.int32)
    for one, many in zip(two, graph[2:], strict=True):
        one.flags.writeable = many.flags.writeable  # kernels are compiled for either
    reduced(2, 1, *two, mu)
    found, alone = reduced(*graph, mu), reduced(*graph, mu, streams=1)
    baseline = dijkstra_seconds(graph)
    report = {
        "graph": name,
        "mu": mu,
        "nodes": graph[0],
        "edges": len(graph[2]),
        "originals": graph[1],
        "kept_nodes": len(found.nodes),
        "kept_edges": len(found.edges),
        "streams": STREAMS,
        "seconds": found.seconds,
        "one_stream": {"kept_nodes": len(alone.nodes), "kept_edges": len(alone.edges), "seconds": alone.seconds},
        "edges_looked_at": found.looked,
        "share_of_edges_looked_at_by_source": found.looked / graph[1] / len(graph[2]),
        "ns_per_edge": 1e9 * found.seconds / found.looked,
        "memory_limit_s": EDGE_BYTES * found.looked / memory_bandwidth(),
        "scipy_dijkstra_s": baseline,
        "times_faster_than_scipy": baseline / found.seconds,
        "peak_rss_mb": peak_rss_mb(),
    }
    json.dump(report, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
