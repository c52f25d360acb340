import numpy as np

from footwork.controllers import steering
from footwork.controllers.controller import Situations
from footwork.motion import lookahead
from footwork.motion.moves import no_moves
from footwork.runtime import inertialisation, posing, world
from footwork.runtime.warm import warm_kernels
from toy_bundle import toy_bundle


def kernels() -> dict:
    compiled = (world.first_wrong_move, world.make_moves, world.take_jumps, inertialisation.decay, posing.pose)
    return {kernel: kernel.signatures for kernel in (*compiled, steering.first_outside, lookahead.best_edges)}


def test_a_tick_after_warming_compiles_nothing():
    bundle = toy_bundle()
    graph, table = bundle.graph, bundle.tables["steering"]
    warm_kernels(steering.SteeringController(graph, table))
    before = {kernel: list(signatures) for kernel, signatures in kernels().items()}
    assert all(before.values())
    characters, controller = world.World(graph, 3), steering.SteeringController(graph, table)
    for slot in range(3):
        characters.spawn(controller.start_node(), float(slot), 0.0, 0.0)
    slots, asked, moves = np.arange(3), np.ones(3, dtype=np.int32), no_moves(3)
    for _ in range(5):
        controller.choose(Situations(slots, characters.node, characters.place, np.full(3, 2.0), asked), moves)
        characters.step(moves)
        characters.show(1.0 / 3.0)
        characters.show(1.0)
    assert {kernel: list(signatures) for kernel, signatures in kernels().items()} == before
