"""One compiled call does what one Python call after the other does."""

import numpy as np
import pytest

from footwork.controllers.command import Command
from footwork.controllers.steering import SteeringController
from footwork.motion.arrays import frozen
from footwork.runtime.chosen_ticks import ChosenTicks
from footwork.runtime.schedule import NOTHING, schedule_of
from footwork.runtime.simulation import Simulation
from footwork.runtime.steered_ticks import SteeredTicks
from footwork.runtime.world_errors import WrongMove
from toy_bundle import lively_bundle

BUNDLE = lively_bundle()


class Asked(SteeringController):
    """Steers as usual, but is asked at every tick."""


def crowd(controller: SteeringController) -> Simulation:
    simulation = Simulation(BUNDLE, 4, controller=controller)
    for number in range(4):
        simulation.spawn(number, -number, 0.4 * number, ("stop", "walk")[number % 2])
    simulation.remove(1)
    return simulation


def random_commands(simulation: Simulation, ticks: int, random: np.random.Generator) -> list[tuple[int, int, Command]]:
    words = simulation.vocabulary
    return [
        (int(random.integers(ticks)), int(random.choice(simulation.world.slots)), command)
        for _ in range(ticks)
        for command in [
            words.of_keys(random.uniform(-3, 3), 1, 0, False, "jump" if random.random() < 0.3 else ""),
        ]
    ]


def test_any_number_of_ticks_at_once_are_those_ticks_one_by_one_and_any_controllers():
    steered = crowd(SteeringController(BUNDLE.graph, BUNDLE.table("steering")))
    asked = crowd(Asked(BUNDLE.graph, BUNDLE.table("steering")))
    assert isinstance(steered._ticks, SteeredTicks)
    assert isinstance(asked._ticks, ChosenTicks)
    ticks, random = 90, np.random.default_rng(1)
    given = random_commands(steered, ticks, random)
    poses = [np.empty((ticks, 2, 3, 3 + 4 * BUNDLE.graph.skeleton.joint_count), np.float32) for _ in range(2)]
    for simulation, shown in zip((steered, asked), poses, strict=True):
        simulation._ticks.make(simulation.world.slots, schedule_of(given), shown)
    single = crowd(SteeringController(BUNDLE.graph, BUNDLE.table("steering")))
    by_tick = schedule_of(given)
    for tick in range(ticks):
        due = [(0, slot, command) for at, slot, command in sorted(given, key=lambda each: each[0]) if at == tick]
        assert len(due) == int((by_tick[:, 0] == tick).sum())
        one = np.empty_like(poses[0][:1])
        single._ticks.make(single.world.slots, schedule_of(due), one)
        assert one.tobytes() == poses[0][tick].tobytes()
    assert poses[0].tobytes() == poses[1].tobytes()
    assert np.ptp(poses[0], axis=0).max() > 0.1


def test_some_characters_go_on_while_the_others_wait():
    together, apart = (crowd(SteeringController(BUNDLE.graph, BUNDLE.table("steering"))) for _ in range(2))
    whole = together.play(40, 1)
    shown = []
    for row, slot in enumerate(apart.world.slots):
        one = np.empty_like(whole[:, :, row : row + 1])
        apart._ticks.make(np.array([slot]), NOTHING, one)
        shown.append(one)
    assert np.concatenate(shown, axis=2).tobytes() == whole.tobytes()


def test_a_move_that_cannot_be_made_is_told():
    controller = SteeringController(BUNDLE.graph, BUNDLE.table("steering"))
    steered = crowd(controller)
    assert isinstance(steered._ticks, SteeredTicks)
    nowhere = frozen(np.full_like(BUNDLE.graph.displacement, np.nan), np.float32)  # as the kernel is compiled for
    controller.policy = controller.policy._replace(displacement=nowhere)
    steered._ticks = SteeredTicks(controller, steered.world, steered.orders)
    with pytest.raises(WrongMove, match=r"character 0 at node .* not finite"):
        steered.play(1, 1)
