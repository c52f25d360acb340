"""Which speeds a policy is solved for where they are not given: spread over those that the frames show."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.node_speed import node_speeds
from footwork.motion.task import MOST_SPEED_LEVELS, SteeringTask

TAIL = 0.05
"""The part of a behaviour's captured frames that may be slower than all levels, and that may be faster."""


def with_speed_levels(task: SteeringTask, graph: MotionGraph, count: int) -> SteeringTask:
    """The task with so many levels of speed for each headed behaviour that has none and that some frame shows.

    They are even from the 5 % to the 95 % quantile of the speeds of its captured frames, in whole cm/s.

    Raises:
        InputError: for fewer levels than none or more than 16.
    """
    if not 0 <= count <= MOST_SPEED_LEVELS:
        raise InputError(f"{count} speed levels, expected 0 to {MOST_SPEED_LEVELS}", "task")
    return replace(task, speeds={**_levels(graph, task, count), **task.speeds}) if count else task


def _levels(graph: MotionGraph, task: SteeringTask, count: int) -> Mapping[str, tuple[float, ...]]:
    speeds, levels = node_speeds(graph), {}
    for index, name in enumerate(task.behaviours):
        shown = speeds[graph.original & (graph.behaviour == index)]
        if name in task.facing and shown.size:
            slowest, fastest = np.quantile(shown, [TAIL, 1.0 - TAIL])
            even = np.linspace(slowest, fastest, count)
            levels[name] = tuple(np.unique(even.round(2)).tolist())
    return levels
