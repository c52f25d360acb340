import numpy as np

from footwork.controllers import steering
from footwork.motion import lookahead
from footwork.runtime import inertialisation, posing, world
from footwork.runtime.warm import warm_kernels
from toy_bundle import toy_bundle


def kernels() -> dict:
    compiled = (world.first_wrong_edge, world.take_edges, world.take_jumps, inertialisation.decay, posing.pose)
    return {kernel: kernel.signatures for kernel in (*compiled, steering.first_outside, lookahead.best_edges)}


def test_a_tick_after_warming_compiles_nothing():
    bundle = toy_bundle()
    graph, table = bundle.graph, bundle.tables["steering"]
    warm_kernels(graph, table)
    before = {kernel: list(signatures) for kernel, signatures in kernels().items()}
    assert all(before.values())
    characters, controller = world.World(graph, 3), steering.SteeringController(graph, table)
    for slot in range(3):
        characters.spawn(controller.start_node(), float(slot), 0.0, 0.0)
    edges = np.zeros(3, dtype=np.int32)
    for _ in range(5):
        controller.choose(characters.node, characters.place[:, 2], np.full(3, 2.0), np.ones(3, dtype=np.int32), edges)
        characters.step(edges)
        characters.show(1.0 / 3.0)
        characters.show(1.0)
    assert {kernel: list(signatures) for kernel, signatures in kernels().items()} == before
