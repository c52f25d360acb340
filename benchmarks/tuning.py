"""What options of a build change for a player: ``python benchmarks/tuning.py [GROUP...]`` prints a line of JSON each.

Every line is a build of the embedded motions with one option changed; the first of a group is its baseline, against
which ``total_ratio`` is. The player is that of examples/made_up_player.py. Total and its factors are as ``footwork
score`` tells them; they are the same each time, seconds are not.
"""

import json
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from footwork.motion.bundle import encode_bundle
from footwork.motion.trace import Trace, read_trace
from footwork.study.graph_report import frame_times
from footwork.study.scoring import score
from footwork.training.build import build_bundle
from footwork.training.dataset import Dataset
from footwork.training.embedded import embedded_clips
from footwork.training.graph_options import GraphOptions
from footwork.training.task_options import TaskOptions
from support.motions import ROOT

QUICK: dict[str, Any] = {"mirror": True, "bridges": 2}
SUM: dict[str, Any] = {"warp": 6.0, "reward": "sum"}
CONNECTED: dict[str, Any] = {"graph": "well-connected", "threshold": 0.3, "pairing": "neighbours"}
FEW = ("idle", "walk_normal", "run", "walk_run_walk", "jump")
"""The clips of the well-connected graphs."""

# name of the group: what is changed in each line, of the graph and of the task
GROUPS: dict[str, list[tuple[dict[str, Any], dict[str, Any]]]] = {
    "threshold": [({"threshold": number}, {}) for number in (1.0, 0.1, 0.3, 3.0, 10.0)],
    "discount": [({}, {"discount": number}) for number in (0.98, 0.5, 0.9, 0.95, 0.995)],
    "answering": [
        ({}, {}),
        ({"mirror": True}, {}),
        ({"mirror": True}, {"warp": 6.0}),
        (QUICK, {"warp": 6.0}),
        (QUICK, SUM),
    ],
    "weight": [({}, SUM | {"weight": number}) for number in (1.0, 0.25, 0.5, 2.0, 4.0)],
    "size": [({}, {"warp": 6.0, "heading_bins": number}) for number in (36, 12, 18, 72)],
    "mu": [(CONNECTED | {"mu": number}, {}) for number in (5.0, 1.0, 2.0, 20.0)],
}


def made_up_player() -> Trace:
    """The trace that the example writes."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "player.csv"
        subprocess.run([sys.executable, ROOT / "examples" / "made_up_player.py", path], check=True)
        return read_trace(path)


def motions(names: tuple[str, ...] | None) -> Dataset:
    """Embedded clips, all or some of them."""
    clips = [clip for clip in embedded_clips() if names is None or clip.name in names]
    return Dataset(clips, [{"file": clip.name} for clip in clips])


def line(dataset: Dataset, player: Trace, graph: dict[str, Any], task: dict[str, Any]) -> dict[str, Any]:
    """What came of one build."""
    start = time.perf_counter()
    bundle, _ = build_bundle(dataset, GraphOptions(**graph), task=TaskOptions(**task).task())
    seconds = time.perf_counter() - start
    scored = score(bundle, [player])
    told = {name: scored[name] for name in ("total", "control", "transition", "transition_jumps", "answered_share")}
    return (
        graph
        | task
        | told
        | {
            "settle_s": scored["settle_s"]["mean"],
            "nodes": bundle.graph.node_count,
            "edges": bundle.graph.edge_count,
            "megabytes": len(encode_bundle(bundle)[0]) / 1e6,
            "mean_transition_s": frame_times(bundle.graph).mean,
            "build_s": seconds,
        }
    )


def main(groups: list[str]) -> None:
    """Print the lines of some groups, or of all."""
    player = made_up_player()
    for group in groups or list(GROUPS):
        dataset, first = motions(FEW if group == "mu" else None), None
        for graph, task in GROUPS[group]:
            told = line(dataset, player, graph, task)
            first = first or told["total"]
            print(json.dumps({"group": group} | told | {"total_ratio": told["total"] / first}), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
