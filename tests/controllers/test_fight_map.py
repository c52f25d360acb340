"""The fight map and what is foreseen with it, against the world itself stepped along the same edges."""

from dataclasses import replace

import numpy as np
import pytest

from fighting_bundle import fighting_bundle, fighting_ground
from footwork.controllers.activity import ATTACK
from footwork.controllers.fight_map import NONE, fight_map
from footwork.controllers.fighters import new_fighters
from footwork.controllers.prediction import FURTHEST, begin_paths, next_edge, no_paths, predict
from footwork.errors import InputError
from footwork.motion.moves import moves_along
from footwork.motion.state_machine import State
from footwork.motion.strikes import Strikes
from footwork.runtime.world import World


@pytest.fixture(scope="module")
def world_map():
    return fighting_ground().world


def walked(graph, node, edges):
    """Places and nodes of a character that takes edges one after the other from the origin."""
    world = World(graph, 1, inertialise=False, foot_lock=False)
    world.spawn(node, 0.0, 0.0, 0.0)
    for edge in edges:
        world.step(moves_along(graph, np.array([edge], dtype=np.int32)))
    return int(world.node[0]), world.place[0].copy()


@pytest.mark.parametrize(("kind", "seed"), [("attack", 0), ("attack", 1), ("evade", 2), ("evade", 3)])
def test_ways_lead_where_a_character_that_walks_them_comes(world_map, kind, seed):
    graph, random = fighting_bundle().graph, np.random.default_rng(seed)
    goals = getattr(world_map, f"{kind}_goals")
    ways = getattr(world_map, f"{kind}s")
    rows = np.flatnonzero(world_map.segments["state"] == 0)
    for segment in random.choice(rows, 12):
        column = int(random.integers(len(goals)))
        way = ways[world_map.segments[segment][f"{kind}_row"], column]
        node, edges = int(world_map.segments[segment]["last"]), []
        start = node
        for _ in range(way["when"]):
            goal = goals[column] if len(edges) < way["ticks"] else NONE
            edges.append(next_edge(world_map, node, goal, ATTACK if kind == "attack" else ATTACK + 1))
            node = int(graph.target[edges[-1]])
        at, place = walked(graph, start, edges[: way["ticks"]])
        assert at == world_map.segments[goals[column]]["first"]
        np.testing.assert_allclose([way["x"], way["z"]], place[:2], atol=1e-4)
        np.testing.assert_allclose(np.exp(1j * way["yaw"]), np.exp(1j * place[2]), atol=1e-4)
        at, place = walked(graph, start, edges)
        np.testing.assert_allclose([way["hips_x"], way["hips_z"]], place[:2], atol=1e-4)
        if kind == "attack":
            assert at == world_map.segments[goals[column]]["contact"]
            limb = world_map.points[at, world_map.nodes[at]["limb"]]
            x = place[0] + limb[0] * np.cos(place[2]) + limb[2] * np.sin(place[2])
            z = place[1] - limb[0] * np.sin(place[2]) + limb[2] * np.cos(place[2])
            np.testing.assert_allclose([way["limb_x"], way["limb_y"], way["limb_z"]], [x, limb[1], z], atol=1e-4)
        else:
            assert at == world_map.segments[goals[column]]["action_end"]


def test_predicted_paths_are_those_that_are_walked_and_can_be_made_longer(world_map):
    graph, paths = fighting_bundle().graph, no_paths()
    fighters, goal = new_fighters(1), int(world_map.attack_goals[0])
    fighters["activity"][0], fighters["goal"][0] = ATTACK, goal
    node = world_map.segments["last"][world_map.segments["state"] == 0][[5, 9]].astype(np.int32)
    begin_paths(fighters, node, np.zeros((2, 3)), paths)
    for ticks in (3, 30, 60, FURTHEST + 10):
        predict(world_map, ATTACK, ticks, paths, 0)
    assert paths.known.tolist() == [FURTHEST, 0]
    at, edges, ahead = int(node[0]), [], goal
    for tick in range(FURTHEST):
        edges.append(next_edge(world_map, at, ahead, ATTACK))
        at = int(graph.target[edges[-1]])
        ahead = NONE if world_map.nodes[at]["segment"] == goal else ahead
        assert paths.node[0, tick + 1] == at
    assert ahead == NONE
    np.testing.assert_allclose(paths.place[0, FURTHEST], walked(graph, int(node[0]), edges)[1], atol=1e-5)


def test_actions_go_on_as_the_capture_does(world_map):
    notes = fighting_bundle().annotation
    assert notes is not None
    for segment in (*world_map.attack_goals, *world_map.evade_goals):
        end = world_map.segments[segment]["action_end"]
        nodes = np.arange(world_map.segments[segment]["first"], end + 1)
        assert (notes.state[notes.segment[nodes]] == notes.state[segment]).all()
        following = world_map.edges[world_map.segments[world_map.nodes[end]["segment"]]["onward"]]["target"]
        assert following != end + 1 or notes.state[notes.segment[following]] != notes.state[segment]


def without_at_once(machine):
    states = [replace(state, at_once=()) for state in machine.states]
    return replace(machine, states=tuple(states))


def test_bundles_that_nobody_can_fight_with_are_refused():
    bundle = fighting_bundle()
    notes = bundle.annotation
    assert notes is not None
    with pytest.raises(InputError, match="no states, expected a bundle built with --graph annotated"):
        fight_map(replace(bundle, annotation=None, strikes=None, shadowing=None))
    calm = replace(notes, machine=without_at_once(notes.machine), ways=())
    with pytest.raises(InputError, match="'attack' is not reached at once, add it to 'at_once'"):
        fight_map(replace(bundle, annotation=calm))
    other = replace(notes.machine, states=tuple(_renamed(state) for state in notes.machine.states))
    with pytest.raises(InputError, match="no state 'evade', expected one"):
        fight_map(replace(bundle, annotation=replace(notes, machine=other)))
    with pytest.raises(InputError, match="no attack that strikes"):
        fight_map(
            replace(bundle, strikes=Strikes(np.zeros(0, np.int32), np.zeros(0, np.int16), np.zeros(0, np.float32)))
        )


def _renamed(state: State) -> State:
    def new(names):
        return tuple("dodge" if name == "evade" else name for name in names)

    return replace(state, name=new([state.name])[0], to=new(state.to), at_once=new(state.at_once))
