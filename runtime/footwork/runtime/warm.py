"""Compiling every kernel of the tick before the first tick, so that no player waits for the compiler."""

import numpy as np

from footwork.controllers.controller import Controller, Situations
from footwork.motion.moves import no_moves
from footwork.runtime.world import World


def warm_kernels(controller: Controller) -> None:
    """Compile, or load from the cache, all that a tick runs under this controller; it forgets slot 0."""
    world, moves = World(controller.graph, capacity=1), no_moves(1)
    slot = world.spawn(controller.start_node(controller.present[0]), 0.0, 0.0, 0.0)
    controller.begin(slot)
    asked = np.zeros(1, dtype=np.int32)
    controller.choose(Situations(np.zeros(1, np.intp), world.node, world.place, np.zeros(1), asked), moves)
    world.step(moves)
    world.correct(slot, 0.0, 0.0, 0.0)
    world.show(0.5)
