"""A small bundle made by hand, quick to build and to serve."""

from dataclasses import replace

import numpy as np

from footwork.motion.bundle import Bundle, sealed
from footwork.motion.coded_values import exact
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from toy_graphs import BEHAVIOURS, graph_of, wandering_clip

FRAMES = 24
SHOWN = ("stop", "walk", "jump")
"""What its frames show: it has no run."""


def toy_bundle(**task) -> Bundle:
    """Three clips, one of them stopping, one walking, one jumping, with a way from each to each every few frames."""
    clips = [wandering_clip(seed, FRAMES) for seed in range(len(SHOWN))]
    ways = [FRAMES * a + i for a in range(3) for i in (*range(2, FRAMES - 1, 4), FRAMES - 1)]
    jumps = [(node, FRAMES * clip) for node in ways for clip in range(3)]
    behaviour = np.repeat([BEHAVIOURS.index(name) for name in SHOWN], FRAMES)
    graph = graph_of(clips, jumps, behaviour)
    asked = SteeringTask(behaviours=BEHAVIOURS, **task)
    values = np.zeros((graph.node_count, len(asked.requests.behaviour), asked.heading_bins), dtype=np.float32)
    table = PolicyTable(asked, exact(values), residual=0.0, sweeps=1, converged=True)
    return sealed(Bundle(graph, {"steering": table}, attribution=("toy motion, nobody's",)))


def lively_bundle() -> Bundle:
    """The same with worths at random, so that what is asked for matters, and with feet that stand now and then."""
    toy, random = toy_bundle(), np.random.default_rng(7)
    values = random.uniform(0.0, 5.0, toy.table("steering").values.shape).astype(np.float32)
    contacts = np.arange(toy.graph.node_count)[:, None] // 5 % 3 != np.arange(2)
    graph = replace(toy.graph, contacts=contacts)
    table = replace(toy.table("steering"), coded=exact(values))
    return sealed(Bundle(graph, {"steering": table}, attribution=toy.attribution))
