"""Microseconds a character and tick of motion matching: ``python benchmarks/motion_matching.py [--bundle FILE]``.

It prints JSON; with a bundle also what a decision by its table costs for the same players, and how many times that goes
into each form's.

Both forms choose moves for one character, for 100 and for 1,000 at once, as recorded players ask (made-up ones where
there are none), on the benchmark's clips and their mirror images, and on 54,000 frames: copies of these with every
joint turned by a little, another amount in each copy, so that no frame is there twice. The search by boxes is set
against brute force over the same frames on the same queries, in turns; all else of a tick is the same for both.
"""

import argparse
import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller
from footwork.controllers.steering import SteeringController
from footwork.motion import quaternion
from footwork.motion.bundle import read_bundle
from footwork.motion.clip import Clip
from footwork.motion.mirror import mirrored
from footwork.motion.trace import Trace, read_trace
from footwork.study.motion_matching.chains import graph_of_all_frames
from footwork.study.motion_matching.controller import MotionMatchingController
from footwork.study.motion_matching.features import COUNT
from footwork.study.motion_matching.forms import FORMS
from footwork.study.motion_matching.options import MatchingOptions
from footwork.study.motion_matching.search import NOWHERE, nearest, nearest_by_brute_force
from footwork.study.motion_matching.tick import write_query
from footwork.study.pace import pace
from support.machine import spread, timed
from support.motions import MOTIONS, benchmark_clips

MANY_FRAMES = 54_000
JITTER = 0.03  # rad
TICKS = {1: 4000, 100: 600, 1000: 150}
QUERIES, TURNS = 400, 7


def many_clips(clips: Sequence[Clip], frames: int) -> list[Clip]:
    """Copies of clips until there are so many frames."""
    random, copies, left = np.random.default_rng(0), [], frames
    while left > 0:
        for clip in clips:
            if left > 0:
                copies.append(jittered(clip.cut(0, min(left, clip.frame_count)), random))
                left -= copies[-1].frame_count
    return copies


def jittered(clip: Clip, random: np.random.Generator) -> Clip:
    """The clip in another posture."""
    turn = quaternion.from_rotation_vector(random.normal(0.0, JITTER, (clip.skeleton.joint_count, 3)))
    return replace(clip, rotations=quaternion.multiply(clip.rotations, turn))


def players() -> tuple[str, list[Trace]]:
    """Recorded players, or one who does anything for a second each."""
    folder = MOTIONS.parent / "traces"
    if folder.is_dir():
        return "recorded", [read_trace(path) for path in sorted(folder.glob("*.csv"))]
    random = np.random.default_rng(0)
    ahead, aside, run, attack = (np.repeat(random.integers(0, 2, 200), 35) for _ in range(4))
    turn = np.repeat(random.normal(0.0, 0.05, 200), 35)
    keys = ahead.astype(np.int8), aside.astype(np.int8)
    return "made up", [Trace("made up", *keys, run > 0, turn, attack > 0, np.zeros(7000, np.bool_))]


def queries(controller: MotionMatchingController) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Poses at random, at a random speed, asked to go somewhere else; and the behaviour that is asked for."""
    random, data = np.random.default_rng(1), controller.data
    wanted, asked = np.empty((QUERIES, COUNT), np.float32), random.integers(0, len(data.set_of), QUERIES)
    for query, behaviour in zip(wanted, asked, strict=True):
        node, root = int(random.integers(len(data.values))), np.zeros(8)
        root[4] = random.choice(data.speed)
        write_query(query, node, root, data.speed[behaviour], random.normal(0.0, 0.7), data, controller.options)
    return wanted, asked


@numba.njit(nogil=True)
def search_all(search: Callable, wanted: NDArray, asked: NDArray, data: tuple, scratch: NDArray) -> int:
    """Search for every query; a sum, so that nothing is left out."""
    total = 0
    for number in range(wanted.shape[0]):
        beyond = (NOWHERE, NOWHERE)
        total += search(wanted[number], data.sets, data.set_of[asked[number]], beyond, np.inf, scratch)[0]  # type: ignore
    return total


def searches(controller: MotionMatchingController) -> dict[str, dict[str, float]]:
    """Microseconds a search with boxes and by brute force, in turns."""
    wanted, asked = queries(controller)
    scratch = np.empty(len(controller.data.values), np.float32)
    works = {
        name: lambda search=search: search_all(search, wanted, asked, controller.data, scratch)
        for name, search in (("boxes", nearest), ("brute_force", nearest_by_brute_force))
    }
    if works["boxes"]() != works["brute_force"]():
        raise AssertionError("both searches must find the same frames")
    times = {name: [] for name in works}
    for _ in range(TURNS):
        for name, work in works.items():
            times[name].append(1e6 * timed(work) / QUERIES)
    ratios = [slow / fast for fast, slow in zip(times["boxes"], times["brute_force"], strict=True)]
    return {f"{name}_us": spread(each) for name, each in times.items()} | {"times_faster": spread(ratios)}


def measured(clips: Sequence[Clip], options: MatchingOptions, traces: list[Trace]) -> dict[str, object]:
    """One form on some clips."""
    controller = MotionMatchingController(graph_of_all_frames(clips), options)
    return {
        "frames": controller.graph.node_count,
        "searched_mb": round(controller.table_bytes / 1e6, 2),
        "search": searches(controller),
        "decision_us": decisions(controller, traces),
    }


def decisions(controller: Controller, traces: list[Trace]) -> dict[str, dict[str, float]]:
    """Microseconds of a decision, by the number of characters that decide at once."""
    return {
        str(count): pace(traces, controller, characters=count, ticks=ticks)["decision_us"]
        for count, ticks in TICKS.items()
    }


def by_table(path: str, traces: list[Trace], forms: dict[str, dict[str, dict]]) -> dict[str, object]:
    """What a bundle's table costs, and how many times that goes into each form's time on the motions it had."""
    bundle = read_bundle(path)
    ours = decisions(SteeringController(bundle.graph, bundle.table("steering")), traces)
    times = {
        f"{form}, {motion}": {
            count: {key: theirs["decision_us"][count][key] / value for key, value in mine.items()}
            for count, mine in ours.items()
        }
        for form, by_motion in forms.items()
        for motion, theirs in by_motion.items()
    }
    return {"nodes": bundle.graph.node_count, "decision_us": ours, "times_faster_than": times}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bundle", help="whose table to set beside it")
    asked = parser.parse_args()
    name, clips = benchmark_clips()
    clips = [*clips, *map(mirrored, clips)]
    motions = {f"{name}, mirrored": clips, f"{name}, jittered copies": many_clips(clips, MANY_FRAMES)}
    asking, traces = players()
    forms = {
        form: {motion: measured(those, options, traces) for motion, those in motions.items()}
        for form, options in FORMS.items()
    }
    report = {"unit": "us per character and tick, us per search", "players": asking, "forms": forms}
    if asked.bundle:
        report["table"] = by_table(asked.bundle, traces, forms)
    json.dump(report, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
