"""Compiling every kernel of the tick before the first tick, so that no player waits for the compiler."""

import numpy as np

from footwork.controllers.controller import Controller
from footwork.controllers.orders import Orders
from footwork.runtime.schedule import NOTHING
from footwork.runtime.ticks import ticks_of
from footwork.runtime.world import World


def warm_kernels(controller: Controller) -> None:
    """Compile, or load from the cache, all that a tick runs under this controller; it forgets slot 0."""
    world, orders = World(controller.graph, capacity=1), Orders(1)
    slot = world.spawn(controller.start_node(controller.present[0]), 0.0, 0.0, 0.0)
    controller.begin(slot)
    orders.begin(slot, 0.0, 0)
    poses = np.zeros((1, 1, 1, 3 + 4 * controller.graph.skeleton.joint_count), dtype=np.float32)
    ticks_of(controller, world, orders).make(world.slots, NOTHING, poses)
    world.correct(slot, 0.0, 0.0, 0.0)
    world.show(0.5)
    controller.begin(slot)
