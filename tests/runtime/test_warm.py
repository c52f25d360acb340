import numpy as np
from numba.core.dispatcher import Dispatcher

from footwork.controllers import steering
from footwork.controllers.controller import Situations
from footwork.motion import lookahead
from footwork.motion.moves import no_moves
from footwork.runtime import foot_lock, held_feet, inertialisation, leg_kernels, moving, posing, ticking, world
from footwork.runtime.warm import warm_kernels
from toy_bundle import toy_bundle


def kernels() -> dict[Dispatcher, list]:
    """What each kernel of a tick is compiled for, those that only other kernels call among them."""
    modules = (steering, lookahead, moving, foot_lock, held_feet, leg_kernels, inertialisation, posing, ticking)
    found = [value for module in modules for value in vars(module).values() if isinstance(value, Dispatcher)]
    return {kernel: list(kernel.signatures) for kernel in found}


def test_a_tick_after_warming_compiles_nothing():
    bundle = toy_bundle()
    graph, table = bundle.graph, bundle.tables["steering"]
    warm_kernels(steering.SteeringController(graph, table))
    before = kernels()
    assert before[ticking.advance]
    assert before[ticking.show_characters]
    characters, controller = world.World(graph, 3), steering.SteeringController(graph, table)
    for slot in range(3):
        characters.spawn(controller.start_node(), float(slot), 0.0, 0.0)
    slots, asked, moves = np.arange(3), np.ones(3, dtype=np.int32), no_moves(3)
    for _ in range(5):
        controller.choose(Situations(slots, characters.node, characters.place, np.full(3, 2.0), asked), moves)
        characters.step(moves)
        characters.show(1.0 / 3.0)
        characters.show(1.0)
    assert kernels() == before
