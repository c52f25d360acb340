"""The greedy controller: at each tick the action of the best reward, whatever comes after."""

import numpy as np

from footwork.controllers.steering import SteeringController
from footwork.motion.coded_values import exact
from footwork.motion.graph import MotionGraph
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask


def greedy(graph: MotionGraph, task: SteeringTask) -> SteeringController:
    """Steering by a table in which nothing is worth anything; of equal rewards the first edge wins."""
    shape = graph.node_count, len(task.requests.behaviour), task.heading_bins
    return SteeringController(graph, PolicyTable(task, exact(np.zeros(shape)), 0.0, 0, True, where="greedy"))
