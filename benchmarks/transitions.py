"""Speed of the search for transitions over chains: ``python benchmarks/transitions.py`` prints JSON.

Set against plain matrix products over all pairs of rows (motion/all_pairs.py on a sample of chains, extrapolated with
the square of the rows), and against the floating-point rate of this machine. Runs on the first clips of dataset3's
core ranges where they lie beside the checkout, on made-up motion otherwise.
"""

import json
import sys
import time

import numpy as np

from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import BEHAVIOURS
from footwork.training.chains import Chains
from footwork.training.interpolation import interpolated
from footwork.training.memory import peak_rss_mb
from footwork.training.transition_search import search
from support.machine import matrix_product_peak, seconds_of, spread
from support.motions import benchmark_clips

CLIPS = 4
THRESHOLD = 0.2
SAMPLE = 4000  # rows that are compared by plain products
FLOPS_PER_PAIR = 10 * 21 * 11  # five products over the joints of a window


def baseline_seconds(chains: Chains) -> float:
    """Plain products over all pairs of rows, from the first chains, extrapolated."""
    rows = chains.length + 2 * chains.context
    count = int(np.searchsorted(np.cumsum(rows), SAMPLE)) + 1
    ends = np.cumsum(rows[:count])
    metric = PointCloudMetric(np.split(chains.places[: ends[-1]], ends[:-1]))
    metric.all_pairs()
    started = time.perf_counter()
    metric.all_pairs()
    return (time.perf_counter() - started) * (chains.row_count / ends[-1]) ** 2


def main(repeats: int = 3) -> None:
    """Measure and print."""
    name, clips = benchmark_clips()
    chains, _ = interpolated(clips[:CLIPS], BEHAVIOURS, threshold=THRESHOLD)
    found = search(chains, THRESHOLD)
    times = seconds_of(lambda: search(chains, THRESHOLD), repeats)
    median, plain, peak = float(np.median(times)), baseline_seconds(chains), matrix_product_peak()
    pairs = chains.row_count * (chains.row_count - 1) / 2
    report = {
        "workload": f"{name}, {CLIPS} clips, weights as needed, threshold {THRESHOLD}",
        "nodes": chains.node_count,
        "rows": chains.row_count,
        "pairs": pairs,
        "minima": len(found.i),
        "seconds": spread(times),
        "pairs_per_s": pairs / median,
        "baseline": "windowed sums of plain products over all pairs, extrapolated",
        "baseline_seconds": plain,
        "times_faster": plain / median,
        "matrix_product_peak_gflop_s": peak / 1e9,
        "seconds_of_window_products_at_peak": pairs * FLOPS_PER_PAIR / peak,
        "peak_rss_mb": peak_rss_mb(),
    }
    json.dump(report, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
