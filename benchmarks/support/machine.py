"""What this machine can do at best, measured in the same run as what is compared with it."""

import os
import statistics
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np


def seconds_of(work: Callable[[], object], repeats: int) -> list[float]:
    """How long each of some repeats took, after one that is not counted."""
    work()
    return [timed(work) for _ in range(repeats)]


def timed(work: Callable[[], object]) -> float:
    """How long one run took."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def spread(values: list[float]) -> dict[str, float]:
    """Median, least and greatest."""
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def matrix_product_peak(size: int = 1024, repeats: int = 7) -> float:
    """The best rate of float64 matrix products with all threads of the linear algebra library, flop/s."""
    rng = np.random.default_rng(0)
    a, b, out = rng.random((size, size)), rng.random((size, size)), np.empty((size, size))
    return 2.0 * size**3 / min(seconds_of(lambda: np.matmul(a, b, out=out), repeats))


def memory_bandwidth(megabytes: int = 256, repeats: int = 5, threads: int = 1) -> float:
    """The best rate at which so many threads read and write arrays larger than the caches, bytes/s."""
    source = np.ones((threads, megabytes << 17))
    target = np.empty_like(source)
    with ThreadPoolExecutor(threads) as pool:
        seconds = seconds_of(lambda: list(pool.map(np.copyto, target, source)), repeats)
    return 2.0 * source.nbytes / min(seconds)


def resident_bytes() -> int:
    """What this process holds in memory; Linux."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
