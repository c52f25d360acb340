"""Commands and the world without sessions or sockets."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from footwork.controllers.command import UnknownBehaviour
from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.runtime.simulation import Simulation
from footwork.runtime.world import WorldFull
from toy_bundle import SHOWN, toy_bundle

BUNDLE = toy_bundle()


def run(simulation: Simulation, ticks: int) -> list[tuple[np.ndarray, np.ndarray]]:
    frames = []
    for _ in range(ticks):
        simulation.step()
        shown = simulation.show(1.0)
        frames.append((shown.root.copy(), shown.rotations.copy()))
    return frames


def test_it_begins_at_tick_zero_with_nobody():
    simulation = Simulation(BUNDLE, 3)
    assert simulation.tick == 0
    assert not simulation.world.active.any()
    simulation.step()
    assert simulation.tick == 1


def test_only_behaviours_that_frames_show_may_be_asked_for():
    simulation = Simulation(BUNDLE, 1)
    assert simulation.behaviours == SHOWN
    with pytest.raises(UnknownBehaviour, match="stop, walk, jump"):
        simulation.spawn(0.0, 0.0, 0.0, "run")
    assert not simulation.world.active.any()


def test_slots_run_out_and_come_back():
    simulation = Simulation(BUNDLE, 2)
    slots = [simulation.spawn(0.0, 0.0, 0.0) for _ in range(2)]
    assert simulation.full
    with pytest.raises(WorldFull):
        simulation.spawn(0.0, 0.0, 0.0)
    simulation.remove(slots[0])
    assert not simulation.full
    assert simulation.spawn(0.0, 0.0, 0.0) == slots[0]


def test_a_character_does_the_same_alone_and_in_a_crowd():
    alone, crowd = Simulation(BUNDLE, 1), Simulation(BUNDLE, 5)
    for simulation in (alone, crowd):
        slot = simulation.spawn(1.0, 2.0, 0.3, "walk")
        simulation.give(slot, simulation.vocabulary.outright(0.3, "walk"))
    for number in range(3):
        other = crowd.spawn(0.0, 0.0, float(number))
        crowd.give(other, crowd.vocabulary.outright(0.0, SHOWN[number % 2]))
    for (root, rotations), (crowd_root, crowd_rotations) in zip(run(alone, 50), run(crowd, 50), strict=True):
        np.testing.assert_array_equal(root[0], crowd_root[0])
        np.testing.assert_array_equal(rotations[0], crowd_rotations[0])


def test_a_new_character_in_a_used_slot_remembers_nothing():
    fresh, used = Simulation(BUNDLE, 1), Simulation(BUNDLE, 1)
    slot = used.spawn(5.0, 5.0, 2.0, "walk")
    used.give(slot, used.vocabulary.of_keys(1.0, 1, 0, False, "jump"))
    run(used, 7)
    used.remove(slot)
    for simulation in (fresh, used):
        simulation.spawn(0.0, 0.0, 0.0)
    for one, other in zip(run(fresh, 30), run(used, 30), strict=True):
        np.testing.assert_array_equal(one[0], other[0])
        np.testing.assert_array_equal(one[1], other[1])


def test_a_character_that_is_left_alone_comes_to_stand():
    simulation = Simulation(BUNDLE, 1)
    slot = simulation.spawn(0.0, 0.0, 1.0, "walk")
    simulation.give(slot, simulation.vocabulary.outright(1.0, "walk"))
    run(simulation, 30)
    assert SHOWN[simulation.behaviour[slot]] == "walk"
    simulation.stand(slot)
    run(simulation, 30)
    assert SHOWN[simulation.behaviour[slot]] == "stop"


def test_inertialisation_can_be_switched_off():
    shown = []
    for inertialise in (True, False):
        simulation = Simulation(BUNDLE, 1, inertialise=inertialise)
        slot = simulation.spawn(0.0, 0.0, 0.0, "stop")
        simulation.give(slot, simulation.vocabulary.outright(0.0, "walk"))
        frames = run(simulation, 30)
        steps = [np.abs(after[1] - before[1]).max() for before, after in pairwise(frames)]
        shown.append(max(steps))
    assert shown[0] < 0.5 * shown[1]


def test_a_bundle_without_steering_or_behaviours_is_refused():
    with pytest.raises(InputError, match="steering"):
        Simulation(replace(BUNDLE, tables={}), 1)
    graph = replace(BUNDLE.graph, behaviour=np.full(BUNDLE.graph.node_count, -1))
    with pytest.raises(InputError, match="no frame shows any behaviour"):
        Simulation(replace(BUNDLE, graph=graph), 1)


def test_the_world_lives_on_the_graph_of_its_controller():
    other = toy_bundle()
    controller = SteeringController(other.graph, other.tables["steering"])
    simulation = Simulation(BUNDLE, 1, controller=controller)
    assert simulation.world.graph is other.graph
    assert simulation.world.graph is not BUNDLE.graph
    slot = simulation.spawn(0.0, 0.0, 0.0, "walk")
    run(simulation, 3)
    assert simulation.show(1.0).behaviour[slot] >= 0


def test_who_comes_after_the_others_were_shown_is_shown_as_what_it_does():
    simulation = Simulation(BUNDLE, 2)
    simulation.spawn(0.0, 0.0, 0.0, "stop")
    simulation.show(1.0)
    late = simulation.spawn(0.0, 0.0, 0.0, "walk")
    told = simulation.show(1.0)
    assert simulation.behaviours[told.behaviour[late]] == "walk"
    assert told.source_frame[late] == BUNDLE.graph.nearest_source[1][simulation.world.node[late]]


def test_feet_are_held_unless_told_otherwise():
    assert Simulation(BUNDLE, 1).world.smoothing.foot_lock
    assert not Simulation(BUNDLE, 1, foot_lock=False).world.smoothing.foot_lock
