"""Tuning the strong form on recorded players: steps at random, kept where Total rises.

    python -m footwork.study.motion_matching.tuning MOTIONS TRACES

where MOTIONS is a folder of capture beside its ``labels.csv`` and ``core_ranges.csv``. Prints the options found and
what they score on the players that trained them and on the others.
"""

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.motion.asked import asked_of, going_on, spawn_behaviour
from footwork.motion.graph import MotionGraph
from footwork.motion.moves import no_moves
from footwork.motion.trace import Trace, read_trace
from footwork.motion.turn_warp import turn_warp
from footwork.runtime.world import World
from footwork.study.charges import charges
from footwork.study.measures import TASK
from footwork.study.motion_matching.chains import graph_of_all_frames
from footwork.study.motion_matching.controller import MotionMatchingController
from footwork.study.motion_matching.options import STRONG, MatchingOptions
from footwork.training.dataset import load_clips

TRAINING = slice(0, None, 2)
"""Of the traces by name these train; the others test."""

TUNED = {
    "weights": ("foot_position", "foot_velocity", "hip_velocity", "trajectory_position", "trajectory_direction"),
    "turning": ("gain", "gain_unheaded"),
    "": (
        "search_ticks",
        "sharp_velocity",
        "sharp_turn",
        "velocity_halflife",
        "rotation_halflife",
        "skipped_end",
        "skipped_around",
        "skipped_run_end",
        "transition_cost",
    ),
}
"""What is tuned, by the part of the options that it stands in; "" for the options themselves."""
MOST_AT_ONCE = 4
STEP = 0.3  # standard deviation of a step's logarithm


def split(traces: Sequence[Trace]) -> tuple[list[Trace], list[Trace]]:
    """The traces that train, and those that test."""
    ordered = sorted(traces, key=lambda trace: trace.name)
    training = ordered[TRAINING]
    return training, [trace for trace in ordered if trace not in training]


def total(controller: Controller, traces: Sequence[Trace]) -> float:
    """Mean control times mean transition over all ticks (conventions.md 5), the players side by side.

    Raises:
        InputError: as ``asked_of``.
    """
    graph, task = controller.graph, TASK
    heading, asked, there = _commands(traces, controller)
    source, edge, target, adjustment, facing = _played(controller, heading, asked)
    cost = charges(graph, turn_warp(graph), source, edge, target, adjustment, task.smoothness_sigma)
    control = task.control_quality(heading.ravel() - facing, asked.ravel(), graph.behaviour[target])
    used = there.ravel()
    return float(control[used].mean() * np.exp(-cost / task.smoothness_sigma)[used].mean())


def tune(
    graph: MotionGraph,
    traces: Sequence[Trace],
    start: MatchingOptions = STRONG,
    trials: int = 300,
    seed: int = 0,
    progress: Callable[[int, float, MatchingOptions], None] | None = None,
) -> tuple[MatchingOptions, float]:
    """The best of so many trials of options on a graph, and its Total.

    Each trial multiplies one to MOST_AT_ONCE of the numbers of TUNED by exp of a normal number times STEP, from the
    best so far on.

    Args:
        graph: of all frames.
        traces: the players.
        start: options to begin with.
        trials: how many to try.
        seed: of the trials.
        progress: told the trial, the best Total and its options each time that it rises.
    """
    random = np.random.default_rng(seed)
    best, highest = start, total(MotionMatchingController(graph, start), traces)
    for trial in range(trials):
        options = varied(best, random)
        value = total(MotionMatchingController(graph, options), traces)
        if value > highest:
            best, highest = options, value
            if progress:
                progress(trial, highest, best)
    return best, highest


def varied(options: MatchingOptions, random: np.random.Generator) -> MatchingOptions:
    """The options with a few numbers changed."""
    names = [(part, name) for part, inside in TUNED.items() for name in inside]
    for number in random.choice(len(names), size=random.integers(1, MOST_AT_ONCE + 1), replace=False):
        part, name = names[number]
        holder = getattr(options, part) if part else options
        holder = holder._replace(**{name: _stepped(getattr(holder, name), random)})
        options = options._replace(**{part: holder}) if part else holder
    return options


def _stepped(value: float, random: np.random.Generator) -> float:
    """Another value; counts stay whole and at least 1."""
    stepped = value * float(np.exp(random.normal(0.0, STEP)))
    return max(1, round(stepped + random.normal(0.0, 0.5))) if isinstance(value, int) else stepped


def _commands(traces: Sequence[Trace], controller: Controller) -> tuple[NDArray, NDArray, NDArray]:
    """Headings, behaviours and whether there are any, a column a trace; the last are held.  # (K, traces) each"""
    first = controller.graph.behaviours.index(spawn_behaviour(controller.present))
    parts = [asked_of(trace, controller.graph, controller.present) for trace in traces]
    longest = max(len(asked) for _, asked in parts)
    rows = np.minimum(np.arange(longest)[:, None], [len(asked) - 1 for _, asked in parts])
    heading = np.stack([commands.heading[rows[:, k]] for k, (commands, _) in enumerate(parts)], axis=1)
    asked = np.stack([going_on(asked, first)[rows[:, k]] for k, (_, asked) in enumerate(parts)], axis=1)
    return heading, asked, rows == np.arange(longest)[:, None]


def _played(controller: Controller, heading: NDArray, asked: NDArray) -> tuple[NDArray, ...]:
    """Source, edge, target, adjustment and facing of every tick and trace, one tick after the other."""
    ticks, count = heading.shape
    world, moves, slots = World(controller.graph, count, inertialise=False), no_moves(count), np.arange(count)
    start = controller.start_node(spawn_behaviour(controller.present))
    for _ in range(count):
        controller.begin(world.spawn(start, 0.0, 0.0, 0.0))
    kept = []
    for tick in range(ticks):
        source = world.node.copy()
        controller.choose(Situations(slots, world.node, world.place, heading[tick], asked[tick]), moves)
        world.step(moves)
        kept.append((source, moves.edge.copy(), world.node.copy(), moves.adjustment.copy(), world.place[:, 2].copy()))
    return tuple(np.concatenate(column) for column in zip(*kept, strict=True))


def main() -> None:
    """Tune on a folder's clips and mirror images, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("motions", type=Path)
    parser.add_argument("traces", type=Path)
    parser.add_argument("--trials", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    tables = {
        name: given.motions.parent / f"{file}.csv" for name, file in (("labels", "labels"), ("ranges", "core_ranges"))
    }
    graph = graph_of_all_frames(load_clips(given.motions, **tables).clips, mirror=True)
    training, testing = split([read_trace(path) for path in sorted(given.traces.glob("*.csv"))])
    found, value = tune(graph, training, trials=given.trials, seed=given.seed, progress=print)
    print(found)
    print("training", value, "test", total(MotionMatchingController(graph, found), testing))


if __name__ == "__main__":
    main()
