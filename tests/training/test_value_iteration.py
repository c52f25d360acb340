import math
from dataclasses import replace

import numpy as np
import pytest

from exact_steering import ExactSteering, random_steering_graph
from footwork.controllers.controller import Situations
from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion import threads
from footwork.motion.actions import actions_of, onward_edges
from footwork.motion.coded_values import exact
from footwork.motion.moves import no_moves
from footwork.motion.player_model import PlayerModel
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.training import value_iteration
from footwork.training.sweeper import Sweeper
from footwork.training.value_iteration import fixed_point, solve
from motion_samples import ring_graph

TASK = SteeringTask(behaviours=("stop", "walk"), heading_bins=12, discount=0.9)
WARPED = replace(TASK, warp=math.radians(6.0), warp_share={"walk": 1.0, "stop": 0.5}, warp_levels=3)
AT_SPEEDS = {"speeds": {"walk": (0.4, 0.7, 1.2)}, "speed_sigma": 0.25, "speed_weight": 0.8}
TASKS = {
    "product": TASK,
    "sum at a price": replace(TASK, reward="sum", weight=0.8, transition_price=0.05),
    "warped": WARPED,
    "warped sum": replace(WARPED, reward="sum", weight=1.3),
    "segments": replace(TASK, segment_ticks=3),
    "warped segments": replace(WARPED, segment_ticks=2),
    "speeds": replace(TASK, **AT_SPEEDS),
    "warped sum at speeds": replace(WARPED, reward="sum", weight=1.3, **AT_SPEEDS),
}


def fickle_player(seed: int = 0) -> PlayerModel:
    change = np.random.default_rng(seed).random((2, 2, 12)) ** 4
    change[[0, 1], [0, 1], 0] += 5.0
    return PlayerModel(("stop", "walk"), change / change.sum(axis=(1, 2), keepdims=True))


PLAYERS = {"persistent": None, "fickle": fickle_player()}


@pytest.mark.parametrize("player", PLAYERS)
@pytest.mark.parametrize("name", TASKS)
def test_values_are_those_of_policy_iteration_with_dense_solves(name, player):
    task, model = TASKS[name], PLAYERS[player]
    graph = random_steering_graph(3, nodes=6, degree=3)
    table = solve(graph, task, player=model, tolerance=1e-6)
    assert table.converged
    np.testing.assert_allclose(table.values, ExactSteering(graph, task, model).solved(), atol=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_values_of_other_graphs_too(seed):
    graph = random_steering_graph(seed, nodes=7, degree=4)
    table = solve(graph, WARPED, tolerance=1e-6)
    np.testing.assert_allclose(table.values, ExactSteering(graph, WARPED).solved(), atol=1e-5)


@pytest.mark.parametrize("name", ["product", "warped sum", "speeds", "warped sum at speeds"])
@pytest.mark.parametrize("player", PLAYERS)
@pytest.mark.parametrize("listed", [True, False])
def test_the_tables_greedy_policy_is_the_exact_one(name, player, listed):
    task, model = TASKS[name], PLAYERS[player]
    graph = random_steering_graph(11, nodes=6, degree=3)
    exact = ExactSteering(graph, task, model)
    worth = exact.action_values(exact.solved())
    table = solve(graph, task, player=model, tolerance=1e-6)
    controller = SteeringController(graph, table if listed else table.unlisted, exact_facing=False)
    states = np.array(list(np.ndindex(*exact.shape)))
    wanted, speed = (part[states[:, 1]] for part in task.requests)
    edge, turn = chosen(controller, states[:, 0], wanted, task.headings[states[:, 2]], speed)
    number = {(e, round(t, 9)): action for action, (e, t) in enumerate(exact.choices())}
    actions = [number[e, round(t, 9)] for e, t in zip(edge.tolist(), turn.tolist(), strict=True)]
    best = worth.max(axis=0)
    taken = worth[actions, *states.T].reshape(exact.shape)
    np.testing.assert_allclose(taken, best, atol=1e-5)
    alone = (worth > best - 1e-4).sum(axis=0) == 1  # where nothing comes near, there is no question of ties
    assert alone.mean() > 0.5
    np.testing.assert_array_equal(np.reshape(actions, exact.shape)[alone], worth.argmax(axis=0)[alone])


def test_between_tabulated_headings_the_better_of_the_two_best_actions_is_taken():
    task, graph = TASKS["warped sum"], random_steering_graph(12, nodes=8, degree=4)
    exact, table = ExactSteering(graph, task), solve(graph, task, tolerance=1e-6)
    rng, count = np.random.default_rng(3), 60
    node, wanted = rng.integers(0, 8, count), rng.integers(0, 2, count)
    heading = rng.uniform(-math.pi, math.pi, count)
    edge, turn = chosen(SteeringController(graph, table, exact_facing=False), node, wanted, heading)
    low = np.floor((heading + math.pi) / (2 * math.pi) * task.heading_bins).astype(int)
    for who in range(count):
        worth = []
        for place in (low[who], (low[who] + 1) % task.heading_bins):
            first = graph.edge_start[node[who]] * len(task.turn_levels)
            number = first + table.shortlist[node[who], wanted[who], place]
            worth.append(worth_between(exact, table, *exact.choices()[number], wanted[who], heading[who]))
        taken = worth_between(exact, table, edge[who], turn[who], wanted[who], heading[who])
        assert taken == pytest.approx(max(worth), abs=1e-5)


def worth_between(exact, table, edge, turn, wanted, heading):
    """What an action is worth at any heading, values interpolated."""
    after = heading - float(exact.graph.displacement[edge, 2]) - turn
    row = table.values[exact.graph.target[edge], wanted]
    ahead = np.interp(after, table.task.headings, row, period=2 * math.pi)
    return exact.rewards(edge, turn, wanted, np.array([heading]))[0] + table.task.discount * ahead


def test_between_two_levels_a_speed_is_judged_by_itself_and_its_worth_interpolated():
    graph, levels = random_steering_graph(7, nodes=6, degree=3), TASKS["speeds"]
    between = replace(levels, speeds={"walk": (0.5,)})
    solved, judged = ExactSteering(graph, levels).solved(), ExactSteering(graph, between)
    low, high = solved[:, 2], solved[:, 3]  # of 0.4 and 0.7 m/s
    worth = judged.action_values(np.stack([*solved[:, :2].swapaxes(0, 1), low + (high - low) / 3], axis=1))[:, :, 2]
    controller = SteeringController(graph, solve(graph, levels, tolerance=1e-6))
    states = np.array(list(np.ndindex(6, levels.heading_bins)))
    edge, _ = chosen(
        controller, states[:, 0], np.ones(len(states)), levels.headings[states[:, 1]], np.full(len(states), 0.5)
    )
    np.testing.assert_allclose(worth[edge, *states.T], worth.max(axis=0)[*states.T], atol=1e-5)


def chosen(controller, node, wanted, heading, speed=None):
    """Edges and extra turns at states, of characters that face along z."""
    count = len(node)
    moves, place = no_moves(count), np.zeros((count, 3))
    kinds = node.astype(np.int32), wanted.astype(np.int32)
    controller.choose(Situations(np.arange(count), kinds[0], place, heading, kinds[1], speed), moves)
    return moves.edge, moves.adjustment[:, 2]


def test_policy_iteration_comes_to_what_plain_sweeps_come_to():
    graph = random_steering_graph(5, nodes=30, degree=3)
    actions, onward = actions_of(graph, TASK), onward_edges(graph)
    quick = fixed_point(actions, onward, TASK, tolerance=1e-9)
    with value_iteration.ThreadPoolExecutor(1) as pool:
        plain = Sweeper(actions, onward, TASK, None, np.float64, pool)
        while plain.improve() >= 1e-9:
            pass
    np.testing.assert_allclose(quick.values, plain.values, atol=1e-8)
    assert quick.improvements < plain.sweeps / 5


def test_what_all_values_lack_alike_is_added_at_once():
    """A walk that goes straight and stands by turns is worth about the same wherever it begins."""
    task = SteeringTask(behaviours=("walk",), heading_bins=4, discount=0.999)
    graph = replace(ring_graph(2, behaviours=("walk",)), displacement=np.array([[0, 0, 1.6], [0, 0, 1.5]], np.float32))
    table = solve(graph, task, tolerance=1e-1)
    assert table.converged
    assert table.sweeps < 300
    assert np.abs(table.values - ExactSteering(graph, task).solved()).max() < table.error_bound


def test_float32_sweeps_come_to_what_float64_ones_do():
    graph = random_steering_graph(6, nodes=30, degree=3)
    actions, onward = actions_of(graph, TASK), onward_edges(graph)
    fine, coarse = (fixed_point(actions, onward, TASK, tolerance=tolerance) for tolerance in (1e-9, 1e-4))
    assert (fine.values.dtype, coarse.values.dtype) == (np.float64, np.float32)
    np.testing.assert_allclose(coarse.values, fine.values, atol=1e-4 * 0.9 / 0.1)


@pytest.mark.parametrize("tolerance", [1e-1, 1e-3])
def test_true_values_lie_within_the_stated_error(tolerance):
    graph = random_steering_graph(2, nodes=6, degree=3)
    table = solve(graph, WARPED, player=fickle_player(), tolerance=tolerance)
    true = ExactSteering(graph, WARPED, fickle_player()).solved()
    assert table.converged
    assert table.residual < tolerance
    assert table.error_bound == pytest.approx(10.0 * table.residual)
    assert np.abs(table.values - true).max() <= table.error_bound


def test_the_stated_residual_is_that_of_the_exact_backup():
    graph = random_steering_graph(4, nodes=6, degree=3)
    for task in (WARPED, replace(TASK, segment_ticks=3)):
        table = solve(graph, task, player=fickle_player(), max_sweeps=4)
        exact = ExactSteering(graph, task, fickle_player())
        following = exact.action_values(table.values.astype(float)).max(axis=0)
        reward, follows = exact.onward()
        for _ in range(task.segment_ticks - 1):
            following = reward + task.discount * follows @ (exact.expect @ following.ravel())
        backed = (exact.expect @ following.ravel()).reshape(exact.shape)
        assert table.residual == pytest.approx(np.abs(backed - table.values).max(), rel=1e-6)


def test_results_do_not_depend_on_threads(monkeypatch):
    graph = random_steering_graph(8, nodes=60, degree=3)
    values = []
    for count in (1, 3, threads.THREADS):
        monkeypatch.setattr(value_iteration, "THREADS", count)
        values.append(solve(graph, WARPED, player=fickle_player()).values)
    np.testing.assert_array_equal(values[0], values[1])
    np.testing.assert_array_equal(values[0], values[2])


def test_a_single_looping_node_has_its_closed_form():
    table = solve(ring_graph(1), SteeringTask(behaviours=("stop", "walk")), tolerance=1e-5)
    task = table.task
    reward = np.exp(-0.5 * (task.headings / task.heading_sigma) ** 2)
    np.testing.assert_allclose(table.values[0, 1], reward / (1 - task.discount), atol=1e-3)
    assert not table.values[0, 0].any()


def test_values_far_from_the_tolerance_are_said_to_be_unconverged():
    table = solve(random_steering_graph(0), TASK, max_sweeps=2)
    assert (table.converged, table.sweeps) == (False, 2)
    with pytest.raises(InputError, match=r"not converged: residual .* after 2 sweeps"):
        table.require_converged()


def test_progress_goes_from_nothing_to_all():
    told: list[float] = []
    assert solve(random_steering_graph(1), TASK, progress=told.append).converged
    assert told[-1] == 1.0
    assert all(0.0 <= share <= 1.0 for share in told)


def test_a_turn_slower_than_a_bin_is_not_stuck():
    """conventions.md 5: with nearest-bin rounding a turn of 1.5 degrees a frame never leaves its bin."""
    slow, asked = math.radians(1.5), math.radians(85.0)
    graph = replace(
        ring_graph(2, behaviours=("walk",)),
        edge_start=np.array([0, 2, 4], np.int32),
        target=np.array([0, 1, 0, 1], np.int32),
        cost=np.zeros(4, np.float32),
        smoothness=np.ones(4, np.float32),
        displacement=np.array([[0, 0.04, 0.0], [0, 0.04, slow]] * 2, np.float32),
        natural=np.ones(4, np.bool_),
    )
    controller = SteeringController(graph, solve(graph, SteeringTask(behaviours=("walk",))))
    node, facing, ticks = 0, 0.0, 0
    while asked - facing > slow and ticks < 200:
        edge, _ = chosen(controller, np.array([node]), np.zeros(1), np.array([asked - facing]))
        facing, node, ticks = facing + float(graph.displacement[edge[0], 2]), int(graph.target[edge[0]]), ticks + 1
    assert ticks <= 57


def test_a_graph_that_the_task_does_not_fit_is_refused():
    with pytest.raises(InputError, match="behaviours stop, walk, run, jump, the graph has stop, walk"):
        solve(ring_graph(4), SteeringTask())
    chain = replace(ring_graph(4), edge_start=np.array([0, 2, 2, 3, 4], np.int32))
    with pytest.raises(InputError, match="node 1 leads nowhere"):
        solve(chain, SteeringTask(behaviours=("stop", "walk")))


@pytest.mark.parametrize("reward", ["product", "sum"])
@pytest.mark.parametrize(("shown", "said"), [(-1, "shows none of"), (0, "shows stop of")])
def test_a_reward_that_is_the_same_whatever_is_done_is_refused(reward, shown, said):
    graph = replace(ring_graph(4), behaviour=np.full(4, shown, np.int16))
    with pytest.raises(InputError, match=f"the reward is the same whatever is done.*{said}"):
        solve(graph, SteeringTask(behaviours=("stop", "walk"), reward=reward))


@pytest.mark.parametrize("player", PLAYERS)
def test_from_values_that_are_nearly_right_it_is_there_sooner(player):
    graph, model = random_steering_graph(5, nodes=8, degree=3), PLAYERS[player]
    cold = solve(graph, WARPED, player=model, tolerance=1e-5)
    warm = solve(graph, WARPED, player=model, start=cold.values + 0.01, tolerance=1e-5)
    np.testing.assert_allclose(warm.values, cold.values, atol=2e-4)
    assert warm.sweeps < cold.sweeps
    with pytest.raises(InputError, match="values to start from"):
        solve(graph, WARPED, start=cold.values[:, :, 1:])


def test_a_discount_of_one_is_refused():
    with pytest.raises(InputError, match=r"discount is 1\.0, expected 0 <= discount < 1"):
        SteeringTask(discount=1.0)


def test_a_player_model_of_other_axes_is_refused():
    with pytest.raises(InputError, match="12 heading bins, the task has 16"):
        solve(ring_graph(4), replace(TASK, heading_bins=16), player=fickle_player())
    values = np.zeros((4, 2, 12), np.float32)
    other = PlayerModel(("walk", "stop"), fickle_player().change)
    with pytest.raises(InputError, match="behaviours walk, stop, the task has stop, walk"):
        PolicyTable(TASK, exact(values), 0.0, 1, True, other)
