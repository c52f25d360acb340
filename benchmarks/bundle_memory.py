"""Memory of one more process that has a bundle open: read as a copy, and mapped (Linux).

    python benchmarks/bundle_memory.py [BUNDLE]

Prints one JSON object. Some processes hold the bundle and then one more opens it; stated is what that one takes for
itself alone (private memory) and its share of all (proportional set size), less those of a process that has imported
the same and opened nothing. A controller is made and every value of the table read, so that nothing is left untouched.
Without a bundle it takes one of 20,000 made-up nodes.
"""

import argparse
import json
import multiprocessing
import platform
import sys
import tempfile
import time
from multiprocessing.connection import Connection
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from footwork.controllers.steering import SteeringController
from footwork.motion.bundle import Bundle, read_bundle, write_bundle
from footwork.motion.task import SteeringTask
from footwork.training.value_iteration import solve
from motion_samples import ring_graph

NODES = 20_000
HOLDERS = 2
REPEATS = 5
PROCESSES = multiprocessing.get_context("spawn")
WAYS: dict[str, dict[str, bool] | None] = {"nothing": None, "copied": {"mapped": False}, "mapped": {"mapped": True}}


def made_up() -> Bundle:
    """A ring of nodes that turns as it goes, with its policy."""
    graph = ring_graph(NODES, turn=0.01)
    return Bundle(graph, {"steering": solve(graph, SteeringTask(behaviours=graph.behaviours, discount=0.9))})


def memory_mb() -> dict[str, float]:
    """Private memory and proportional set size of this process, megabytes."""
    lines = [line.split() for line in Path("/proc/self/smaps_rollup").read_text().splitlines()[1:]]
    kilobytes = {words[0].rstrip(":"): float(words[1]) for words in lines}
    return {
        "private_mb": (kilobytes["Private_Clean"] + kilobytes["Private_Dirty"]) / 1e3,
        "proportional_mb": kilobytes["Pss"] / 1e3,
    }


def hold(path: str, how: dict[str, bool] | None, pipe: Connection) -> None:
    """Process: open the bundle, tell memory and seconds, and hold it until the pipe says something."""
    began = time.perf_counter()
    held = None
    if how is not None:
        bundle = read_bundle(path, **how)
        held = SteeringController(bundle.graph, bundle.table("steering"))
        np.max(held.table.values)
    pipe.send(memory_mb() | {"open_s": time.perf_counter() - began})
    pipe.recv()


def one_more(path: str, how: dict[str, bool] | None) -> dict[str, float]:
    """The figures of the last of several processes that hold the bundle at once."""
    pipes, processes, figures = [], [], {}
    for _ in range(HOLDERS + 1):
        mine, theirs = PROCESSES.Pipe()
        process = PROCESSES.Process(target=hold, args=(path, how, theirs))
        process.start()
        figures = mine.recv()
        pipes.append(mine)
        processes.append(process)
    for pipe, process in zip(pipes, processes, strict=True):
        pipe.send("done")
        process.join()
    return figures


def measured(path: str) -> dict[str, Any]:
    """Medians and spreads over several runs, the ways by turns."""
    runs = {name: [] for name in WAYS}
    for _ in range(REPEATS):
        for name, how in WAYS.items():
            runs[name].append(one_more(path, how))
    idle = {figure: median(run[figure] for run in runs["nothing"]) for figure in runs["nothing"][0]}
    report: dict[str, Any] = {}
    for name in ("copied", "mapped"):
        for figure, base in idle.items():
            values = sorted(round(run[figure] - base, 3) for run in runs[name])
            report[f"{name}_{figure}"] = {"median": median(values), "spread": [values[0], values[-1]]}
    return report


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("bundle", nargs="?")
    given = parser.parse_args().bundle
    with tempfile.TemporaryDirectory() as folder:
        path = given or str(Path(folder) / "made.footwork")
        if not given:
            write_bundle(path, made_up())
        report = {
            "workload": f"one more process beside {HOLDERS} with {Path(path).name}",
            "file_mb": Path(path).stat().st_size / 1e6,
            **measured(path),
            "baseline": "copied: read_bundle(mapped=False)",
            "machine": platform.machine(),
        }
    report["private_ratio"] = report["mapped_private_mb"]["median"] / report["copied_private_mb"]["median"]
    print(json.dumps(report))


if __name__ == "__main__":
    main()
