"""Throughput of the metrics over all pairs of frames: ``python benchmarks/metric.py`` prints JSON.

Rates of the uniform metric are set against this machine's matrix-product peak, measured in the same run, and against
the plain form of the formula in numpy: five products of the full depth of a window (conventions.md 1). The other
metrics are set against the uniform one, whose turns alternate with theirs.
"""

import json
import sys

import numpy as np

from footwork.motion.kinematics import clip_places
from footwork.motion.metric import UNIT, Metric, PointCloudMetric
from footwork.motion.metrics import NAMES, metric_of
from footwork.motion.window import LENGTH, RADIUS, window_frames, window_weights
from support.machine import matrix_product_peak, seconds_of, spread, timed
from support.motions import benchmark_clips


def plain_costs(places: np.ndarray, lengths: list[int]) -> np.ndarray:
    """The five-product form on windows laid out flat."""
    windows = window_frames(lengths)
    weights = np.repeat(window_weights(), places.shape[1]) / places.shape[1]
    x, y, z = np.moveaxis(places[windows].reshape(len(places), -1, 3), -1, 0)
    x, z = x - (x @ weights)[:, None], z - (z @ weights)[:, None]
    energy = (x**2 + y**2 + z**2) @ weights
    real = (x * weights) @ x.T + (z * weights) @ z.T
    imaginary = (x * weights) @ z.T - (z * weights) @ x.T
    square = energy[:, None] + energy - 2.0 * (y * weights) @ y.T - 2.0 * np.hypot(real, imaginary)
    return np.maximum(square, 0.0) / UNIT**2


def flops_per_pair(points: int) -> tuple[float, float]:
    """Of the fused form (half of the matrix, per-frame products, diagonal sums) and of the plain one."""
    fused = 0.5 * (10.0 * points + 3.0 * (3.0 * RADIUS + 1.0) + 18.0)
    return fused, 10.0 * points * LENGTH + 10.0


def compared(metrics: dict[str, Metric], repeats: int) -> dict[str, dict[str, object]]:
    """Seconds of each metric, and how many times the uniform metric's they are, of runs one after the other."""
    times: dict[str, list[float]] = {name: [] for name in metrics}
    for metric in metrics.values():
        metric.all_pairs()
    for _ in range(repeats):
        for name, metric in metrics.items():
            times[name].append(timed(metric.all_pairs))
    base = times["uniform"]
    return {
        name: {
            "seconds": spread(each),
            "times_uniform": spread([a / b for a, b in zip(each, base, strict=True)]),
            "times_uniform_at_best": min(each) / min(base),
        }
        for name, each in times.items()
    }


def main(repeats: int = 9) -> None:
    """Measure and print."""
    name, clips = benchmark_clips()
    each = [clip_places(clip)[0] for clip in clips]
    metric, places, lengths = PointCloudMetric(each), np.concatenate(each), [len(clip) for clip in each]
    pairs = metric.frame_count**2
    fused, plain = flops_per_pair(places.shape[1])
    peak = matrix_product_peak()
    times = seconds_of(metric.all_pairs, repeats)
    plain_times = seconds_of(lambda: plain_costs(places, lengths), 3)
    best, median = min(times), float(np.median(times))
    difference = np.abs(metric.all_pairs() - plain_costs(places, lengths)).max()
    report = {
        "motion": name,
        "frames": metric.frame_count,
        "points": places.shape[1],
        "seconds": spread(times),
        "pairs_per_s": spread([pairs / seconds for seconds in times]),
        "matrix_product_peak_gflops": peak / 1e9,
        "flops_per_pair": {"fused": fused, "plain": plain},
        "share_of_peak": {
            "fused_flops": fused * pairs / median / peak,
            "plain_flops": plain * pairs / median / peak,
            "fused_flops_best": fused * pairs / best / peak,
        },
        "bytes": {"result": pairs * 8, "per_pair": 8, "written_gb_per_s": pairs * 8 / median / 1e9},
        "plain_numpy_s": spread(plain_times),
        "times_faster_than_plain_numpy": float(np.median(plain_times)) / median,
        "largest_difference_to_plain": float(difference),
        "metrics": compared({name: metric_of(name, clips) for name in NAMES}, repeats),
    }
    json.dump(report, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
