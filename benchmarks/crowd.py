"""Whole frames of many characters at 60 frames a second: their ticks, and the poses of all, as a game would ask.

    python benchmarks/crowd.py [--bundle B.footwork] [--counts 1,10,100] [--frames 400]

Prints one JSON object. A frame is what ``Crowd.advance`` and ``Crowd.show`` take, in Python: with ticks in turn one
group of two makes its tick at each frame ("in_turn"), without all make it at every other one ("at_once"). Characters
are steered by the bundle's table; a fiftieth of them changes its mind at each frame, which is not timed. Without a
bundle the embedded motions are built into one. ``wall`` is what passed, ``cpu`` what the process was given of it; both
are milliseconds a frame, and agree where nothing else runs.

The baseline of the same run copies the captured poses of as many nodes with ``numpy.take``. The limits are what one
core needs for nothing but the bytes that a frame must touch, at the rate of large copies, and for nothing but the
operations that it must do, at the rate of float64 matrix products; both counted by hand, see ``necessary``.
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
from footwork.motion.bundle import Bundle, read_bundle, sealed
from footwork.runtime.crowd import Crowd
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions
from support.machine import matrix_product_peak, memory_bandwidth

SHOWN = 2  # frames a tick
CHANGE = 0.02  # of the characters, at each frame
SETTLE = 120  # frames before anything is timed


def embedded_bundle() -> Bundle:
    """The embedded motions as a bundle."""
    return sealed(build_bundle(embedded_dataset("locomotion"), GraphOptions(threshold=1.0))[0])


class Frames:
    """A crowd whose characters change their minds, and the times of its frames.

    Args:
        bundle: what it moves on.
        count: how many characters.
        groups: in how many groups: as many as frames are shown in a tick, or one.
    """

    def __init__(self, bundle: Bundle, count: int, groups: int) -> None:
        self._random = np.random.default_rng(count)
        self._crowd = Crowd(bundle, count, frames=groups)
        self._who = [self._crowd.spawn(*self._random.uniform(-3.0, 3.0, 3)) for _ in range(count)]
        self._frame = 0

    def change_minds(self, share: float) -> None:
        """Ask some characters, one at least, for something new."""
        some = self._random.choice(len(self._who), max(1, int(share * len(self._who))), replace=False)
        for group, slot in (self._who[number] for number in some):
            behaviour = str(self._random.choice(group.behaviours))
            group.give(slot, group.vocabulary.outright(self._random.uniform(-3.0, 3.0), behaviour))

    def show_next(self) -> None:
        """Make a frame: of one group all tick at every other one."""
        if len(self._crowd.groups) > 1:
            self._crowd.advance()
            self._crowd.show()
            return
        shown = self._frame % SHOWN
        if shown == 0:
            self._crowd.advance()
        self._crowd.groups[0].show((shown + 1) / SHOWN)
        self._frame += 1

    def times(self, frames: int) -> tuple[list[int], list[int]]:
        """Wall and processor nanoseconds of each of some frames."""
        wall, cpu = [], []
        for _ in range(frames):
            self.change_minds(CHANGE)
            began, spent = time.perf_counter_ns(), time.thread_time_ns()
            self.show_next()
            cpu.append(time.thread_time_ns() - spent)
            wall.append(time.perf_counter_ns() - began)
        return wall, cpu

    def transitions(self) -> float:
        """The share of characters whose last step left the captured order."""
        return float(np.mean([~group.world.natural for group in self._crowd.groups]))

    def gather(self, poses: np.ndarray) -> None:
        """The baseline: the captured poses of all nodes."""
        done = 0
        for group in self._crowd.groups:
            node = group.world.node
            group.bundle.graph.rotations.take(node, axis=0, out=poses[done : done + len(node)], mode="clip")
            done += len(node)


def summary(nanoseconds: list[int]) -> dict[str, float]:
    """Milliseconds a frame."""
    least, middle, high, most = np.percentile(nanoseconds, [0, 50, 99, 100]) / 1e6
    return {"min": round(least, 4), "median": round(middle, 4), "p99": round(high, 4), "max": round(most, 4)}


def measured(bundle: Bundle, count: int, groups: int, frames: int) -> dict[str, Any]:
    """The frames of a crowd of so many groups."""
    made = Frames(bundle, count, groups)
    made.change_minds(1.0)
    made.times(SETTLE)
    wall, cpu = made.times(frames)
    poses = np.zeros((count, *bundle.graph.rotations.shape[1:]), dtype=bundle.graph.rotations.dtype)
    plain = []
    for _ in range(frames):
        began = time.thread_time_ns()
        made.gather(poses)
        plain.append(time.thread_time_ns() - began)
    mean = float(np.mean(cpu))
    return {
        "wall": summary(wall),
        "cpu": summary(cpu),
        "us_a_character_and_frame": round(mean / 1e3 / count, 4),
        "times_gather_baseline": round(mean / float(np.mean(plain)), 2),
        "transitions_a_tick": round(made.transitions(), 3),
    }


def necessary(joints: int) -> dict[str, int]:
    """What a character's frame must touch and do, a tick every other frame.

    Bytes: a pose, its velocities, the offsets of joints and root, place, glide and foot locks are read and a pose is
    written at each frame; a tick reads and writes all that is remembered, and a few rows of tables. Operations, one for
    each sum, product, quotient and root: two exponentials and two products of quaternions a joint and frame, both legs
    posed and bent; half a tick's decay of offsets and the legs' places.
    """
    shown = joints * (16 + 12 + 24) + 24 + 24 + 24 + 48 + 170 + joints * 16 + 12
    ticked = 2 * (joints * 24 + 24 + 24 + 48 + 170) + 150
    return {"bytes": shown + ticked // SHOWN, "operations": joints * 150 + 2 * 900 + (joints * 24 + 800) // SHOWN}


def limits(joints: int) -> dict[str, float]:
    """Microseconds that one core of this machine needs for them."""
    needed, threads = necessary(joints), len(os.sched_getaffinity(0))
    return {
        **needed,
        "us_by_memory": round(1e6 * needed["bytes"] / memory_bandwidth(), 4),
        "us_by_arithmetic": round(1e6 * needed["operations"] * threads / matrix_product_peak(), 4),
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bundle", type=Path)
    parser.add_argument("--counts", default="1,10,100,1000,10000")
    parser.add_argument("--frames", type=int, default=400)
    options = parser.parse_args()
    bundle = embedded_bundle() if options.bundle is None else read_bundle(options.bundle)
    report: dict[str, Any] = {
        "processor": platform.processor() or platform.machine(),
        "load": os.getloadavg()[0],
        "nodes": bundle.graph.node_count,
        "necessary": limits(bundle.graph.skeleton.joint_count),
        "characters": {},
    }
    for count in map(int, options.counts.split(",")):
        ways = {"at_once": 1} | ({"in_turn": SHOWN} if count >= SHOWN else {})
        report["characters"][count] = {
            way: measured(bundle, count, groups, options.frames) for way, groups in ways.items()
        }
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
