"""Replaying ten minutes of one character, and taking it back eight ticks, beside plain steps.

    python benchmarks/replay.py [--bundle B.footwork] [--ticks 18000] [--repeats 9]

Prints one JSON object. A player changes what it wants every half second; all frames at 60 a second are shown and their
bytes digested, and states are compared every two seconds. Without a bundle the embedded motions are built into one
first. The baseline, ``plain``, makes the same ticks with a fresh simulation by one ``step`` and two ``show`` a tick.
"""

import argparse
import json
import os
import platform
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from footwork.cli.motions import embedded_dataset
from footwork.controllers.command import Command
from footwork.motion.bundle import Bundle, read_bundle, sealed
from footwork.motion.tick import TICK_RATE
from footwork.runtime.recording import Commanded, read_recording
from footwork.runtime.replay import Replay, start_recording
from footwork.runtime.simulation import Simulation
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

FRAMES, HELD_TICKS, BACK = 2, 15, 8


def embedded_bundle() -> Bundle:
    """The demo's, built from the project's own motions."""
    return sealed(build_bundle(embedded_dataset("locomotion"), GraphOptions(threshold=1.0))[0])


def commands(simulation: Simulation, ticks: int) -> dict[int, Command]:
    """What a player asks for, by tick."""
    random, words = np.random.default_rng(0), simulation.vocabulary
    return {
        tick: words.outright(random.uniform(-3, 3), str(random.choice(simulation.behaviours)))
        for tick in range(0, ticks, HELD_TICKS)
    }


def record(bundle: Bundle, ticks: int, path: Path) -> None:
    """Make and record the ticks."""
    simulation = Simulation(bundle, 1)
    recorder = start_recording(simulation, path, rate=FRAMES * TICK_RATE)
    slot, given = simulation.spawn(0.0, 0.0, 0.0), commands(simulation, ticks)
    for tick in range(ticks):
        if tick in given:
            simulation.give(slot, given[tick])
        simulation.step()
    simulation.end_recording()
    recorder.wait()


def plain(bundle: Bundle, given: dict[int, Command], ticks: int) -> tuple[float, float]:
    """Seconds, of the clock and of the processor, of the same ticks step by step, shown but not digested."""
    simulation = Simulation(bundle, 1)
    slot = simulation.spawn(0.0, 0.0, 0.0)
    start, worked = time.perf_counter(), time.thread_time()
    for tick in range(ticks):
        if tick in given:
            simulation.give(slot, given[tick])
        simulation.step()
        for frame in range(FRAMES):
            simulation.show((frame + 1) / FRAMES)
    return time.perf_counter() - start, time.thread_time() - worked


def replayed(bundle: Bundle, path: Path) -> tuple[float, float]:
    """Seconds, of the clock and of the processor, of a replay; the file is read before."""
    replay = Replay(read_recording(path), bundle)
    start, worked = time.perf_counter(), time.thread_time()
    outcome = replay.run()
    taken = time.perf_counter() - start, time.thread_time() - worked
    if outcome.departed is not None:
        raise SystemExit("the replay departs from its recording")
    return taken


def spread(values: list[float], digits: int = 2) -> dict[str, float]:
    """Median, and 10th and 90th percentile."""
    low, middle, high = np.percentile(values, [10, 50, 90])
    return {"p10": round(low, digits), "median": round(middle, digits), "p90": round(high, digits)}


def speeds(taken: list[tuple[float, float]], seconds: float) -> dict[str, dict[str, float]]:
    """How many times as fast as real time by the clock, and by the processor's time, which others do not share."""
    clock, work = zip(*taken, strict=True)
    return {
        "clock": spread([seconds / each for each in clock], 0),
        "processor": spread([seconds / each for each in work], 0),
    }


def timed(work: Callable[[], object], times: int = 200) -> list[float]:
    """Microseconds of each call."""
    taken = []
    for _ in range(times):
        start = time.perf_counter_ns()
        work()
        taken.append((time.perf_counter_ns() - start) / 1000.0)
    return taken


def back_and_again(bundle: Bundle) -> dict:
    """Snapshot, restore and eight ticks with a command at each, for one character."""
    simulation = Simulation(bundle, 1)
    slots = [simulation.spawn(0.0, 0.0, 0.0)]
    simulation.give(0, simulation.vocabulary.outright(0.5, simulation.behaviours[-1]))
    simulation.play(30, 0)
    blob = simulation.snapshot(slots)
    given = [(tick, 0, simulation.vocabulary.outright(0.1 * tick, simulation.behaviours[-1])) for tick in range(BACK)]

    def all_of_it() -> None:
        simulation.restore(simulation.snapshot(slots), slots)
        simulation.resimulate(slots, BACK, given)

    def one_by_one() -> None:
        for _, slot, command in given:
            simulation.give(slot, command)
            simulation.step()

    return {
        "blob_bytes": len(blob),
        "snapshot_us": spread(timed(lambda: simulation.snapshot(slots))),
        "restore_us": spread(timed(lambda: simulation.restore(blob, slots))),
        "snapshot_restore_and_8_ticks_us": spread(timed(all_of_it)),
        "8_plain_steps_us": spread(timed(one_by_one)),
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bundle", type=Path)
    parser.add_argument("--ticks", type=int, default=600 * TICK_RATE)
    parser.add_argument("--repeats", type=int, default=9)
    options = parser.parse_args()
    bundle = embedded_bundle() if options.bundle is None else read_bundle(options.bundle)
    seconds = options.ticks / TICK_RATE
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "ten minutes.footrec")
        record(bundle, options.ticks, path)
        given = {
            r.tick - 1: Command(r.heading, r.behaviour, r.one_shot)
            for r in read_recording(path).records
            if isinstance(r, Commanded)
        }
        again, stepped = [], []
        for _ in range(options.repeats):
            again.append(replayed(bundle, path))
            stepped.append(plain(bundle, given, options.ticks))
        report = {
            "workload": f"1 character, {options.ticks} ticks, {FRAMES} frames each, {bundle.graph.node_count} nodes",
            "processor": platform.processor() or platform.machine(),
            "load": os.getloadavg(),
            "recording_bytes": path.stat().st_size,
            "times_real_time": {"replay": speeds(again, seconds), "plain": speeds(stepped, seconds)},
            "replay_against_plain": round(float(np.divide(*np.median([stepped, again], axis=1)[:, 0])), 2),
            "rollback": back_and_again(bundle),
        }
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
