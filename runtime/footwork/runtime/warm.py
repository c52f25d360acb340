"""Compiling every kernel of the tick before the first tick, so that no player waits for the compiler."""

import numpy as np

from footwork.controllers.steering import SteeringController
from footwork.motion.graph import MotionGraph
from footwork.motion.table import PolicyTable
from footwork.runtime.world import World


def warm_kernels(graph: MotionGraph, table: PolicyTable) -> None:
    """Compile, or load from the cache, all that a tick runs on this graph and table.

    Raises:
        InputError: for a table that has not converged or belongs to another graph.
    """
    controller = SteeringController(graph, table)
    world = World(graph, capacity=1)
    slot = world.spawn(controller.start_node(controller.behaviours[0]), 0.0, 0.0, 0.0)
    edges = np.zeros(1, dtype=np.int32)
    controller.choose(world.node, world.place[:, 2], np.zeros(1), np.zeros(1, dtype=np.int32), edges)
    world.step(edges)
    world.correct(slot, 0.0, 0.0, 0.0)
    world.show(0.5)
