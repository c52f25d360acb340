import numpy as np
from numba.core.dispatcher import Dispatcher

from footwork.controllers import orders, steering_kernels
from footwork.motion import lookahead, moves
from footwork.motion.kept import keep
from footwork.runtime import (
    foot_lock,
    foot_places,
    held_feet,
    inertialisation,
    leg_kernels,
    moving,
    posing,
    shown_actions,
    simulation,
    steered_ticks,
    tick_feet,
    ticking,
)
from toy_bundle import toy_bundle


def kernels() -> dict[Dispatcher, list]:
    """What each kernel of a tick is compiled for, those that only other kernels call among them."""
    feet = (foot_lock, foot_places, held_feet, leg_kernels, tick_feet)
    of_world = (moving, *feet, inertialisation, posing, ticking)
    modules = (orders, steering_kernels, lookahead, moves, steered_ticks, shown_actions, *of_world)
    found = [value for module in modules for value in vars(module).values() if isinstance(value, Dispatcher)]
    # what is kept is handed over before any tick
    return {kernel: list(kernel.signatures) for kernel in found if kernel is not keep}


def test_a_tick_after_warming_compiles_nothing():
    bundle = toy_bundle()
    characters = simulation.Simulation(bundle, 3)
    before = kernels()
    assert before[steered_ticks.make_ticks]
    assert before[ticking.show_kept]
    for slot in range(3):
        characters.spawn(float(slot), 0.0, 0.0)
        characters.give(slot, characters.vocabulary.of_keys(np.float64(1.0), 1, 0, False, "jump"))
    for _ in range(5):
        characters.step()
        characters.show(1.0 / 3.0)
        characters.show(1.0)
    characters.correct(0, 1, 2, 3.0)
    characters.play(2, 2)
    assert kernels() == before
