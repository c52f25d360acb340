"""Compile the kernels of a build while something else goes on, such as reading the files to build from."""

from contextlib import suppress
from dataclasses import replace
from threading import Thread

import numpy as np

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.shadowing_task import ShadowingTask
from footwork.motion.state_machine import State, StateMachine
from footwork.motion.task import SteeringTask
from footwork.training.annotated_recipe import annotated
from footwork.training.graph_options import GraphOptions
from footwork.training.shadowing import solve_shadowing
from footwork.training.stages import Stages
from footwork.training.standard_recipe import build_standard
from footwork.training.value_iteration import solve
from footwork.training.well_connected_recipe import build_well_connected

_ON = StateMachine((State("on", ("walk",), ("on",), ("on",)),))
_FRAMES = 48
_STEP = 12


def start_warming(options: GraphOptions) -> Thread:
    """Warm up on a thread of its own; a build that comes too early just waits for the kernels it needs."""
    thread = Thread(target=_warm_while_running, args=(options,), name="warm", daemon=True)
    thread.start()
    return thread


def _warm_while_running(options: GraphOptions) -> None:
    # A program that ends early (bad input, say) takes no new work any more, and needs none of it warm.
    with suppress(RuntimeError):
        warm(options)


def warm(options: GraphOptions) -> None:
    """Compile every kernel of a build, or load it from where an earlier run left it, on two swaying clips."""
    task, clips = SteeringTask(), [_swaying_clip()] * 2
    # whatever else is asked for, only the metric has kernels of its own; bad motions are told of by the build itself
    small = replace(options, graph="well-connected", threshold=1.0, weights=1)
    built = build_standard(clips, small, task, Stages())
    solve(built.graph, task)
    if options.graph == "annotated":
        notes = annotated(built.graph, _ON, np.zeros(built.graph.node_count, dtype=np.int16))
        solve_shadowing(built.graph, notes, 0, ShadowingTask(distance_bins=2, bearing_bins=4))
    if options.graph == "well-connected":
        with suppress(InputError):
            build_well_connected(clips, small, task, Stages())


def _swaying_clip() -> Clip:
    """A body that leans from one foot to the other and stands on them by turns."""
    body, time = default_body(), np.arange(_FRAMES)
    rotations = np.tile(quaternion.IDENTITY, (_FRAMES, body.joint_count, 1))
    lean = 0.3 * np.sin(np.pi * time / _STEP)
    rotations[:, 0] = quaternion.from_rotation_vector(lean[:, None] * np.array([0.0, 0.0, 1.0]))
    left = time // _STEP % 2 == 0
    root = np.tile([0.0, 1.0, 0.0], (_FRAMES, 1))
    labels = np.full(_FRAMES, "walk")
    return Clip("swaying", body, 30.0, root, rotations, contacts=np.stack([left, ~left], axis=1), labels=labels)
