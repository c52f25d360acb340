"""States asked for by players: entered as soon as the graph can, done to their end, by command and by keys."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from footwork.cli.motions import embedded_dataset
from footwork.controllers.bundle_controller import bundle_controller
from footwork.controllers.command import UnknownBehaviour
from footwork.errors import InputError
from footwork.motion.quickest_hops import continued
from footwork.motion.state_machine import StateMachine, read_state_machine
from footwork.runtime.greeting import welcome_of
from footwork.runtime.limits import Limits
from footwork.runtime.simulation import Simulation
from footwork.study.breadth_first import reversed_edges, ticks_from
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

PUBLISHED = read_state_machine(Path(__file__).resolve().parents[2] / "examples" / "fighting.toml")
MACHINE = StateMachine(tuple(replace(state, shadowing=False) for state in PUBLISHED.states))
MOVE, ATTACK, EVADE = range(3)


@pytest.fixture(scope="module")
def bundle():
    return build_bundle(embedded_dataset("fighting"), GraphOptions(graph="annotated"), machine=MACHINE)[0]


@pytest.fixture
def simulation(bundle):
    return Simulation(bundle, 4)


def begins(bundle, state):
    """The first nodes of the captured stretches of a state."""
    notes = bundle.annotation
    return notes.first[:-1][(notes.state == state) & ~continued(bundle.graph, notes)]


def test_commands_and_welcome_have_the_states(bundle, simulation):
    assert simulation.behaviours == ("locomotion", "attack", "evade")
    assert welcome_of(bundle, simulation.behaviours, simulation.speeds, 60, Limits()).behaviours == MACHINE.names


@pytest.mark.parametrize("state", [ATTACK, EVADE])
def test_a_state_is_entered_as_soon_as_the_graph_can(bundle, state):
    graph, notes = bundle.graph, bundle.annotation
    of_node = notes.state[notes.segment]
    own = np.isin(of_node, (MOVE, state))
    inside = own[graph.source] & own[graph.target]
    start = np.searchsorted(graph.source[inside], np.arange(graph.node_count + 1))
    shortest = ticks_from(*reversed_edges(start, graph.target[inside]), begins(bundle, state))
    nodes = np.flatnonzero(of_node == MOVE)[::29]
    simulation = Simulation(bundle, len(nodes))
    for node in nodes:
        simulation.give(
            simulation.spawn(0.0, 0.0, 0.0, node=int(node)), simulation.vocabulary.outright(1.0, MACHINE.names[state])
        )
    entered = np.zeros(len(nodes), dtype=int)
    for tick in range(1, 31):  # as long as it waits
        simulation.step()
        entered[(entered == 0) & (simulation.behaviour == state)] = tick
    due = shortest[nodes]
    np.testing.assert_array_equal(entered, np.where(due <= 30, due, 0))
    assert (entered > 0).mean() > 0.8


def test_a_strike_is_done_as_captured_to_its_end(bundle, simulation):
    graph = bundle.graph
    slot = simulation.spawn(0.0, 0.0, 0.0)
    simulation.give(slot, simulation.vocabulary.outright(0.0, "attack"))
    shown = []
    for _ in range(120):
        simulation.step()
        shown.append(int(simulation.world.node[slot]))
    behaviour = graph.behaviour[shown]
    inside = np.flatnonzero(behaviour == ATTACK)
    strike = np.array(shown)[inside]
    assert shown[inside[0]] in begins(bundle, ATTACK)
    np.testing.assert_array_equal(np.diff(strike), 1)
    assert strike[-1] + 1 == graph.node_count or graph.behaviour[strike[-1] + 1] != ATTACK
    assert (behaviour[inside[-1] + 1 :] == MOVE).all()


def test_a_strike_that_another_is_asked_for_in_is_not_cut_short(bundle, simulation):
    slot = simulation.spawn(0.0, 0.0, 0.0, node=int(begins(bundle, ATTACK)[0]))
    simulation.give(slot, simulation.vocabulary.outright(0.0, "evade"))
    simulation.step()
    assert bundle.graph.behaviour[simulation.world.node[slot]] == ATTACK
    assert simulation.world.natural[slot]


def test_held_keys_ask_for_the_first_state_with_a_heading(bundle, simulation):
    slot = simulation.spawn(0.0, 0.0, 0.0)
    command = simulation.vocabulary.of_keys(0.5, 1.0, 0.0, run=True)
    assert (command.heading, command.behaviour, command.one_shot) == (0.5, MOVE, -1)
    simulation.give(slot, command)
    with pytest.raises(UnknownBehaviour, match="no behaviour 'jump', it has locomotion, attack, evade"):
        simulation.vocabulary.of_keys(0.0, 0.0, 0.0, run=False, one_shot="jump")


def test_footwork_turns_to_the_heading(bundle, simulation):
    slots = [simulation.spawn(0.0, 0.0, 0.0) for _ in range(3)]
    for slot, heading in zip(slots, (2.0, -2.0, 0.0), strict=True):
        simulation.give(slot, simulation.vocabulary.outright(heading, "locomotion"))
    simulation.play(240, 0)
    yaw = simulation.world.place[slots, 2]
    assert np.abs(np.angle(np.exp(1j * (yaw - [2.0, -2.0, 0.0])))).max() < 0.6


def test_moves_are_the_same_again_and_from_a_snapshot(bundle):
    first, second = Simulation(bundle, 2), Simulation(bundle, 2)
    for simulation in (first, second):
        slot = simulation.spawn(0.0, 0.0, 0.0)
        simulation.give(slot, simulation.vocabulary.outright(0.0, "attack"))
        simulation.play(7, 0)
    blob = first.snapshot([0])
    ahead = first.play(40, 1)
    second.restore(blob, [0])
    np.testing.assert_array_equal(second.play(40, 1), ahead)


def test_a_table_of_other_behaviours_is_refused(bundle):
    table = bundle.table("steering")
    other = replace(table, task=replace(table.task, behaviours=("a", "b", "c"), facing=()))
    with pytest.raises(InputError, match="behaviours a, b, c, expected the graph's locomotion, attack, evade"):
        bundle_controller(bundle, table=other)
