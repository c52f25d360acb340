"""Compile the kernels of a build while something else goes on, such as reading the files to build from."""

from contextlib import suppress
from threading import Thread

import numpy as np

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import SteeringTask
from footwork.training.connectivity import largest_component, restricted
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import Minima, local_minima
from footwork.training.value_iteration import solve

_FRAMES = 30


def start_warming() -> Thread:
    """Warm up on a thread of its own; a build that comes too early just waits for the kernels it needs."""
    thread = Thread(target=_warm_while_running, name="warm", daemon=True)
    thread.start()
    return thread


def _warm_while_running() -> None:
    # A program that ends early (bad input, say) takes no new work any more, and needs none of it warm.
    with suppress(RuntimeError):
        warm()


def warm() -> None:
    """Compile every kernel of a build, or load it from where an earlier run left it, on two still clips."""
    task = SteeringTask()
    clips = [_still_clip()] * 2
    metric, nodes = PointCloudMetric.of_clips(clips), nodes_of(clips, task.behaviours)
    local_minima(metric.all_pairs(), nodes.lengths, 1.0)
    # over to the second clip late in the first, and back early in the first from late in the second: a cycle
    there_and_back = Minima(np.array([5, 20]), _FRAMES + np.array([10, 5]), np.zeros(2))
    whole = standard_graph(nodes, metric, there_and_back, task.smoothness_sigma)
    solve(restricted(whole, largest_component(whole.node_count, whole.source, whole.target)), task)


def _still_clip() -> Clip:
    body = default_body()
    rotations = np.tile(quaternion.IDENTITY, (_FRAMES, body.joint_count, 1))
    return Clip("still", body, 30.0, np.tile([0.0, 1.0, 0.0], (_FRAMES, 1)), rotations)
