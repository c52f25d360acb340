"""Ticks a second of one match, microseconds of a decision, and matches an hour.

    python benchmarks/fights.py [--bundle FILE] [--seconds 600] [--repeats 7] [--workers 2]

Prints one JSON object. Without a bundle two fighters move on the embedded motions. The baseline makes the same match a
tick at a time from Python. A match of the league takes a minute.
"""

import argparse
import json
import os
import platform
import time
from pathlib import Path
from typing import Any

import numpy as np

from footwork.cli.motions import embedded_dataset
from footwork.controllers.fighting_style import STYLES
from footwork.motion.bundle import Bundle, read_bundle
from footwork.motion.state_machine import read_state_machine
from footwork.motion.tick import TICK_RATE
from footwork.runtime.match import FightGround, Match, fight_ground, table_of
from footwork.runtime.match_rules import MatchRules
from footwork.study.decision_pace import decision_pace
from footwork.study.league import bouts_of, outcomes
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

MACHINE = Path(__file__).resolve().parents[1] / "examples" / "fighting.toml"
LEAGUE_MATCHES, LEAGUE_SECONDS, DECISIONS = 10, 60, 2000


def embedded_bundle() -> Bundle:
    """The embedded fighting motions, annotated."""
    machine = read_state_machine(MACHINE)
    return build_bundle(embedded_dataset("fighting"), GraphOptions(graph="annotated"), machine=machine)[0]


def new_match(ground: FightGround, seed: int) -> Match:
    """Two balanced fighters who shadow by the bundle's table, where it has one."""
    return Match(ground, [STYLES["balanced"]] * 2, seed, shadowing=table_of(ground.bundle))


def ticks_per_second(ground: FightGround, ticks: int, repeats: int, a_call: int) -> dict[str, float]:
    """Median and 10th and 90th percentile over matches of different seeds, so many ticks a call."""
    rates = []
    for seed in range(repeats):
        match = new_match(ground, seed)
        start = time.perf_counter()
        for _ in range(ticks // a_call):
            match.play(a_call)
        rates.append(ticks // a_call * a_call / (time.perf_counter() - start))
    low, middle, high = np.percentile(rates, [10, 50, 90]).tolist()
    return {"median": middle, "p10": low, "p90": high}


def matches_per_hour(ground: FightGround, workers: int) -> float:
    """Of a minute each, between all styles."""
    bouts = bouts_of(list(STYLES), LEAGUE_MATCHES, 0)
    start = time.perf_counter()
    ticks = LEAGUE_SECONDS * TICK_RATE
    table = table_of(ground.bundle)
    made = list(outcomes(ground, STYLES, bouts, ticks, rules=MatchRules(), shadowing=table, workers=workers))
    return 3600.0 * len(made) / (time.perf_counter() - start)


def measured(ground: FightGround, seconds: int, repeats: int, workers: int) -> dict[str, Any]:
    """The report."""
    ticks = seconds * TICK_RATE
    new_match(ground, 0).play(0)  # compiles
    whole = ticks_per_second(ground, ticks, repeats, ticks)
    stepped = ticks_per_second(ground, min(ticks, 3000), repeats, 1)
    return {
        "workload": f"one match of {seconds} s on {ground.bundle.graph.node_count} nodes, {repeats} seeds",
        "processor": platform.processor() or platform.machine(),
        "load": os.getloadavg()[0],
        "ticks_per_second": whole,
        "times_real_time": whole["median"] / TICK_RATE,
        "baseline": "the same ticks, one call of Match.step each",
        "baseline_ticks_per_second": stepped,
        "ratio": whole["median"] / stepped["median"],
        "decision_us": decision_pace(new_match(ground, 1), DECISIONS),
        "matches_per_hour": {str(hands): matches_per_hour(ground, hands) for hands in sorted({1, workers})},
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="Measure fights.")
    parser.add_argument("--bundle", type=Path)
    parser.add_argument("--seconds", type=int, default=600)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    ground = fight_ground(read_bundle(options.bundle) if options.bundle else embedded_bundle())
    print(json.dumps(measured(ground, options.seconds, options.repeats, options.workers), indent=2))


if __name__ == "__main__":
    main()
