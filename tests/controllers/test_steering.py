import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from footwork.controllers.controller import Situations
from footwork.controllers.questions import WrongQuestion
from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion.actions import actions_of
from footwork.motion.body import default_body
from footwork.motion.coded_values import exact
from footwork.motion.graph import MotionGraph, captured
from footwork.motion.lookahead import best_action
from footwork.motion.moves import no_moves
from footwork.motion.requests import ANY_SPEED, asked_for
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.motion.turn_warp import turn_warp, turned
from footwork.runtime.world import World
from footwork.training.value_iteration import solve
from motion_samples import ring_graph

TURN = math.radians(1.5)
STRAIGHT, LEFT, RIGHT, STAND = range(4)
BEHAVIOURS = ("stop", "walk", "run", "jump")
TASK = SteeringTask(behaviours=BEHAVIOURS, heading_bins=16, discount=0.95)


def loops() -> MotionGraph:
    """Frames that go straight, left, right or stand, each followed by any; turns are slower than a heading bin."""
    body, nodes = default_body(), 4
    yaw = np.tile([0.0, TURN, -TURN, 0.0], nodes)
    ahead = np.tile([0.04, 0.04, 0.04, 0.0], nodes)
    natural = np.eye(nodes, dtype=bool).ravel()
    arrays: dict[str, Any] = captured(np.zeros(nodes), np.arange(nodes))
    arrays |= {
        "label": np.zeros(nodes),
        "behaviour": [1, 1, 1, 0],
        "contacts": np.zeros((nodes, 2)),
        "root_position": np.tile([0.0, 0.9, 0.0], (nodes, 1)),
        "rotations": np.tile([0.0, 0.0, 0.0, 1.0], (nodes, body.joint_count, 1)),
        "root_velocity": np.zeros((nodes, 3)),
        "angular_velocity": np.zeros((nodes, body.joint_count, 3)),
        "edge_start": nodes * np.arange(nodes + 1),
        "target": np.tile(np.arange(nodes), nodes),
        "cost": np.where(natural, 0.0, 0.05),
        "smoothness": np.where(natural, 1.0, 0.95),
        "displacement": np.stack([np.zeros_like(yaw), ahead, yaw], axis=-1),
        "natural": natural,
    }
    return MotionGraph(skeleton=body, clips=("loops",), labels=("walk",), behaviours=BEHAVIOURS, **arrays)


def solved(graph: MotionGraph, sweeps: int = 120) -> np.ndarray:
    """The values, by plain sweeps over every state."""
    values = np.zeros((graph.node_count, len(BEHAVIOURS), TASK.heading_bins))
    choices, rows = actions_of(graph, TASK), values.shape[:2]
    plain = np.zeros(rows), np.ones(rows)
    for _ in range(sweeps):
        old = values.copy()
        for (node, asked, bin_), _ in np.ndenumerate(values):
            values[node, asked, bin_] = best_action(
                *choices,
                old,
                *plain,
                node,
                asked_for(TASK.requests, asked, ANY_SPEED),
                float(TASK.headings[bin_]),
                False,
            )[0]
    return values.astype(np.float32)


@cache
def controller() -> SteeringController:
    graph = loops()
    return SteeringController(graph, PolicyTable(TASK, exact(solved(graph)), 1e-2, 120, True))


def walk_towards(heading: float, ticks: int, start: int = STRAIGHT) -> tuple[World, list[int]]:
    graph = controller().graph
    world, path = World(graph, 1), []
    world.spawn(start, 0.0, 0.0, 0.0)
    asked, moves = np.ones(1, dtype=np.int32), no_moves(1)
    for _ in range(ticks):
        controller().choose(Situations(np.arange(1), world.node, world.place, np.array([heading]), asked), moves)
        world.step(moves)
        path.append(int(world.node[0]))
    return world, path


@pytest.mark.parametrize("degrees", [-170, -90, -20, 20, 90, 170])
def test_it_turns_the_shorter_way_and_gets_there(degrees):
    heading = math.radians(degrees)
    world, path = walk_towards(heading, ticks=int(abs(degrees) / 1.5) + 4)
    assert world.place[0, 2] == pytest.approx(heading, abs=TURN)
    assert (RIGHT if degrees > 0 else LEFT) not in path


@pytest.mark.parametrize("degrees", [350, 710, -350])
def test_headings_past_a_whole_turn_are_the_same_headings(degrees):
    world, _ = walk_towards(math.radians(degrees), ticks=20)
    assert math.remainder(world.place[0, 2] - math.radians(degrees), 2 * math.pi) == pytest.approx(0.0, abs=TURN)


@pytest.mark.parametrize("degrees", [3, 5, 8, 11, -3, -5, -8, -11])
def test_there_is_no_dead_zone_within_half_a_bin(degrees):
    world, _ = walk_towards(math.radians(degrees), ticks=20)
    assert world.place[0, 2] == pytest.approx(math.radians(degrees), abs=TURN)


def test_many_characters_are_asked_at_once():
    node = np.array([STRAIGHT, STRAIGHT, STRAIGHT, LEFT], dtype=np.int32)
    facing, heading = np.array([3.0, -3.0, 0.5, 0.0]), np.array([-3.0, 3.0, 0.5, 9.0])
    behaviour, moves = np.array([1, 1, 1, 0], dtype=np.int32), no_moves(4)
    place = np.stack([np.zeros(4), np.zeros(4), facing], axis=-1)
    controller().choose(Situations(np.arange(4), node, place, heading, behaviour), moves)
    graph = controller().graph
    assert moves.target.tolist() == [LEFT, RIGHT, STRAIGHT, STAND]
    assert graph.source[moves.edge].tolist() == node.tolist()
    assert graph.target[moves.edge].tolist() == moves.target.tolist()


def test_questions_out_of_range_are_refused():
    one, place, moves = np.zeros(1), np.zeros((1, 3)), no_moves(1)
    for node, behaviour, message in [(4, 0, "node 4 of character 0"), (-1, 0, "node -1"), (0, 4, "behaviour 4")]:
        situations = Situations(np.arange(1), np.array([node]), place, one, np.array([behaviour]))
        with pytest.raises(WrongQuestion, match=message):
            controller().choose(situations, moves)


def test_it_starts_on_a_standing_frame():
    assert controller().start_node() == STAND
    assert controller().start_node("walk") in (STRAIGHT, LEFT, RIGHT)
    assert controller().present == ("stop", "walk")
    with pytest.raises(InputError, match="no behaviour 'swim', it has stop, walk, run, jump"):
        controller().start_node("swim")


def test_tables_that_do_not_fit_are_refused():
    graph = loops()
    values = np.zeros((4, 4, 16), dtype=np.float32)
    with pytest.raises(InputError, match="not converged"):
        SteeringController(graph, PolicyTable(TASK, exact(values), 1.0, 5, False))
    with pytest.raises(InputError, match="3 nodes, expected the graph's 4"):
        SteeringController(graph, PolicyTable(TASK, exact(values[:3]), 0.0, 5, True))
    other = SteeringTask(behaviours=("stop", "run", "walk", "jump"), heading_bins=16)
    with pytest.raises(InputError, match="behaviours stop, run, walk, jump, expected"):
        SteeringController(graph, PolicyTable(other, exact(values), 0.0, 5, True))


def straight_on() -> MotionGraph:
    """Two frames that walk straight on, each followed by the other; the left foot stands at one, the right at both."""
    graph = ring_graph(2, behaviours=BEHAVIOURS)
    return replace(graph, contacts=np.array([[True, False], [True, True]]))


def warping(graph: MotionGraph, **options) -> SteeringController:
    task = SteeringTask(behaviours=BEHAVIOURS, warp=math.radians(6.0), warp_levels=3, **options)
    return SteeringController(graph, solve(graph, task))


def turn_chosen(controller: SteeringController, degrees: float, moves) -> float:
    heading, asked = np.array([math.radians(degrees)]), np.ones(1, np.int32)
    place = np.zeros((1, 3))
    controller.choose(Situations(np.zeros(1, np.intp), np.zeros(1, np.int32), place, heading, asked), moves)
    return math.degrees(moves.adjustment[0, 2])


def test_extra_turns_go_about_the_pivot_of_the_frame_come_to():
    graph, moves = straight_on(), no_moves(1)
    assert turn_chosen(warping(graph), 90.0, moves) == pytest.approx(6.0)
    pivot = turn_warp(graph).pivot[1]
    assert np.abs(pivot).max() > 0.01
    np.testing.assert_allclose(moves.adjustment[0], turned(pivot, math.radians(6.0)))
    np.testing.assert_allclose(moves.displacement[0], graph.displacement[0])


@pytest.mark.parametrize("degrees", [2.0, -3.5, 5.0])
def test_exact_facing_turns_right_onto_the_heading_and_can_be_switched_off(degrees):
    graph, moves = straight_on(), no_moves(1)
    controller = warping(graph)
    assert turn_chosen(controller, degrees, moves) == pytest.approx(degrees)
    levels = SteeringController(graph, controller.table, exact_facing=False)
    assert turn_chosen(levels, degrees, moves) in (pytest.approx(0.0), pytest.approx(math.copysign(6.0, degrees)))


def test_a_share_of_none_turns_none():
    assert turn_chosen(warping(straight_on(), warp_share={"stop": 1.0}), 90.0, no_moves(1)) == 0.0


def test_within_a_segment_a_decision_holds_for_each_character_by_itself():
    graph = straight_on()
    controller = warping(graph, segment_ticks=3)
    moves, asked, place = no_moves(2), np.ones(2, np.int32), np.zeros((2, 3))
    turns = []
    controller.begin(5)
    controller.begin(2)
    for tick in range(7):
        if tick == 4:
            controller.begin(2)
        situations = Situations(np.array([5, 2]), np.zeros(2, np.int32), place, np.full(2, 1.5), asked)
        controller.choose(situations, moves)
        turns.append(np.degrees(moves.adjustment[:, 2]).round().tolist())
    assert [turn[0] for turn in turns] == [6.0, 0.0, 0.0, 6.0, 0.0, 0.0, 6.0]
    assert [turn[1] for turn in turns] == [6.0, 0.0, 0.0, 6.0, 6.0, 0.0, 0.0]


def test_of_equal_edges_the_first_is_taken():
    graph = loops()
    level = PolicyTable(TASK, exact(np.zeros((4, 4, 16))), 0.0, 1, True)
    moves = no_moves(1)
    asked = np.full(1, BEHAVIOURS.index("jump"), np.int32)
    place = np.zeros((1, 3))
    SteeringController(graph, level).choose(Situations(np.arange(1), np.ones(1, int), place, np.zeros(1), asked), moves)
    assert moves.edge[0] == graph.edge_start[1]


def standing_ring() -> MotionGraph:
    """Six frames that stand, one after the other, the third of them as like the first as can be; and one that walks."""
    return replace(
        ring_graph(7),
        behaviour=np.array([0, 0, 0, 0, 0, 0, 1], np.int16),
        edge_start=np.array([0, 2, 3, 5, 6, 7, 8, 9], np.int32),
        target=np.array([1, 6, 2, 0, 3, 4, 5, 0, 0], np.int32),
        cost=np.zeros(9, np.float32),
        smoothness=np.ones(9, np.float32),
        displacement=np.zeros((9, 3), np.float32),
        natural=np.array([True, False, True, False, True, True, True, True, False]),
    )


@pytest.mark.parametrize("reward", ["product", "sum"])
@pytest.mark.parametrize(("price", "seen"), [(0.0, 3), (0.001, 6)])
def test_at_a_price_of_transitions_who_stands_goes_on_along_the_clip(reward, price, seen):
    graph = standing_ring()
    task = SteeringTask(("stop", "walk"), heading_bins=4, reward=reward, transition_price=price)
    controller, moves, node = SteeringController(graph, solve(graph, task).compact), no_moves(1), 0
    nodes = []
    for _ in range(12):
        at = np.array([node], np.int32)
        asked = Situations(np.zeros(1, np.intp), at, np.zeros((1, 3)), np.zeros(1), np.zeros(1, np.int32))
        controller.choose(asked, moves)
        node = int(moves.target[0])
        nodes.append(node)
    assert len(set(nodes)) == seen
