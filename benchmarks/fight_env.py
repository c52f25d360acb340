"""Steps a second of the environment for agents that learn, beside the bare match.

    python benchmarks/fight_env.py [--rounds 20] [--repeats 7] [--ticks 6]

Prints one JSON object: medians with the least and the greatest of the repeats. Both fighters choose at random on the
embedded fighting motions. The baseline is ``Match.play`` for as many ticks in one call, with nothing chosen from
outside; ``over_match`` is how many times as long a step takes.
"""

import argparse
import json
import platform
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np

from footwork.cli.motions import embedded_dataset
from footwork.controllers.fighting_style import STYLES
from footwork.motion.state_machine import read_state_machine
from footwork.runtime.match import FightGround, Match, fight_ground, table_of
from footwork.study.fight_env import FightEnv
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

MACHINE = Path(__file__).resolve().parents[1] / "examples" / "fighting.toml"


def embedded_ground() -> FightGround:
    """The embedded fighting motions as a fight ground."""
    machine = read_state_machine(MACHINE)
    return fight_ground(build_bundle(embedded_dataset("fighting"), GraphOptions(graph="annotated"), machine=machine)[0])


def seconds_a_step(env: FightEnv, rounds: int, random: np.random.Generator) -> float:
    """Of an environment in which both choose at random."""
    steps, started = 0, time.perf_counter()
    for seed in range(rounds):
        env.reset(seed=seed)
        while env.agents:
            env.step({agent: int(random.integers(3)) for agent in env.agents})
            steps += 1
    return (time.perf_counter() - started) / steps


def seconds_in_match(ground: FightGround, ticks: int, steps: int) -> float:
    """Of a match for as many ticks as a step has, in one call after the other."""
    match = Match(
        ground, (STYLES["balanced"],) * 2, 1, shadowing=table_of(ground.bundle), inertialise=False, foot_lock=False
    )
    started = time.perf_counter()
    for _ in range(steps):
        match.play(ticks)
    return (time.perf_counter() - started) / steps


def spread(measure: Callable[[], float], repeats: int) -> dict[str, float]:
    """Microseconds, of some repeats after one that does not count."""
    measure()
    taken = [1e6 * measure() for _ in range(repeats)]
    return {"median": median(taken), "least": min(taken), "greatest": max(taken)}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--ticks", type=int, default=6)
    asked = parser.parse_args()
    ground, random = embedded_ground(), np.random.default_rng(0)
    env = FightEnv(ground, ticks=asked.ticks)
    step = spread(lambda: seconds_a_step(env, asked.rounds, random), asked.repeats)
    match = spread(lambda: seconds_in_match(ground, asked.ticks, 100 * asked.rounds), asked.repeats)
    print(
        json.dumps(
            {
                "workload": f"{asked.rounds} rounds of two random agents, {asked.ticks} ticks a step",
                "step_us": step,
                "match_us": match,
                "over_match": step["median"] / match["median"],
                "steps_per_second": 1e6 / step["median"],
                "times_real_time": 1e6 / step["median"] * asked.ticks / 30.0,
                "processor": platform.processor(),
            }
        )
    )


if __name__ == "__main__":
    main()
