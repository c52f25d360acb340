import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.lookahead import best_edges, edge_value
from footwork.motion.task import SteeringTask
from footwork.training.value_iteration import solve
from motion_samples import ring_graph

TASK = SteeringTask(behaviours=("stop", "walk"), heading_bins=12, discount=0.9)


def random_graph(seed: int, nodes: int = 5, degree: int = 2) -> MotionGraph:
    """A graph whose nodes have 1 to ``degree`` edges of random turns and smoothness."""
    rng = np.random.default_rng(seed)
    counts = rng.integers(1, degree + 1, nodes)
    edges = int(counts.sum())
    return replace(
        ring_graph(nodes),
        behaviour=rng.integers(-1, 2, nodes).astype(np.int16),
        edge_start=np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
        target=rng.integers(0, nodes, edges).astype(np.int32),
        cost=np.zeros(edges, np.float32),
        smoothness=rng.uniform(0.3, 1.0, edges).astype(np.float32),
        displacement=np.column_stack([np.zeros((edges, 2)), rng.uniform(-3.5, 3.5, edges)]).astype(np.float32),
        natural=np.ones(edges, np.bool_),
    )


def backup(graph, task, values):
    """One sweep written out with the runtime's own edge_value."""
    new = np.empty_like(values)
    for node, wanted, h in product(*(range(length) for length in values.shape)):
        worth = []
        for edge in range(graph.edge_start[node], graph.edge_start[node + 1]):
            there = graph.target[edge]
            worth.append(
                edge_value(
                    task.headings[h],
                    wanted,
                    bool(task.headed[wanted]),
                    int(graph.behaviour[there]),
                    float(graph.displacement[edge, 2]),
                    float(graph.smoothness[edge]),
                    values[there, wanted],
                    task.heading_sigma,
                    task.discount,
                )
            )
        new[node, wanted, h] = max(worth)
    return new


def policy_values(graph, task, choice):
    """The values of always taking edge choice[node, b, h], by a dense linear solve."""
    shape = choice.shape
    count = choice.size
    matrix, reward = np.eye(count), np.zeros(count)
    for state in range(count):
        node, wanted, h = np.unravel_index(state, shape)
        edge = choice[node, wanted, h]
        there = graph.target[edge]
        yaw = float(graph.displacement[edge, 2])
        after = task.headings[h] - yaw
        shown = graph.behaviour[there]
        reward[state] = graph.smoothness[edge] * task.control_quality(np.array(after), np.array(wanted), shown)
        place = (after + math.pi) / (2 * math.pi) * shape[2]
        low = math.floor(place)
        for bin_, weight in ((low, 1 - (place - low)), (low + 1, place - low)):
            following = np.ravel_multi_index((there, wanted, bin_ % shape[2]), shape)
            matrix[state, following] -= task.discount * weight
    return np.linalg.solve(matrix, reward).reshape(shape)


@pytest.mark.parametrize("seed", range(6))
def test_values_are_a_fixed_point_of_the_runtimes_lookahead(seed):
    graph = random_graph(seed, 8, 3)
    values = solve(graph, TASK, tolerance=1e-10).values.astype(float)
    np.testing.assert_allclose(backup(graph, TASK, values), values, atol=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_without_choice_values_solve_the_linear_system(seed):
    graph = random_graph(seed, 6, 1)
    shape = (6, 2, 12)
    choice = np.broadcast_to(graph.edge_start[:-1, None, None], shape)
    table = solve(graph, TASK, tolerance=1e-9)
    np.testing.assert_allclose(table.values, policy_values(graph, TASK, choice), atol=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_no_policy_is_worth_more(seed):
    task = SteeringTask(behaviours=("stop", "walk"), heading_bins=4, discount=0.8)
    graph = random_graph(seed, 2, 2)
    rows = [range(graph.edge_start[n], graph.edge_start[n + 1]) for n in range(2)]
    best = np.full((2, 2, 4), -np.inf)
    for walk in product(*(row for row in rows for _ in range(4))):
        choice = np.broadcast_to(graph.edge_start[:-1, None, None], (2, 2, 4)).copy()
        choice[:, 1] = np.reshape(walk, (2, 4))
        best = np.maximum(best, policy_values(graph, task, choice))
    table = solve(graph, task, tolerance=1e-10)
    np.testing.assert_allclose(table.values[:, 1], best[:, 1], atol=1e-5)


def test_a_single_looping_node_has_its_closed_form():
    table = solve(ring_graph(1), SteeringTask(behaviours=("stop", "walk")), tolerance=1e-9)
    task = table.task
    reward = np.exp(-0.5 * (task.headings / task.heading_sigma) ** 2)
    np.testing.assert_allclose(table.values[0, 1], reward / (1 - task.discount), atol=1e-4)
    assert not table.values[0, 0].any()


def test_values_far_from_the_tolerance_are_said_to_be_unconverged():
    table = solve(random_graph(0), TASK, max_sweeps=3)
    assert (table.converged, table.sweeps) == (False, 3)
    with pytest.raises(InputError, match=r"not converged: residual .* after 3 sweeps"):
        table.require_converged()


def test_sweeps_residual_and_progress_are_reported():
    told: list[float] = []
    table = solve(random_graph(1), TASK, progress=told.append)
    assert table.converged
    assert 0.0 < table.residual < 1e-3
    assert len(told) == table.sweeps
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_a_turn_slower_than_a_bin_is_not_stuck():
    """conventions.md 5: with nearest-bin rounding a turn of 1.5 degrees a frame never leaves its bin."""
    slow = math.radians(1.5)
    task = SteeringTask(behaviours=("walk",))
    ring = ring_graph(2, behaviours=("walk",))
    turns = np.array([[0, 0.04, 0.0], [0, 0.04, slow]] * 2, np.float32)
    graph = replace(
        ring,
        edge_start=np.array([0, 2, 4], np.int32),
        target=np.array([0, 1, 0, 1], np.int32),
        cost=np.zeros(4, np.float32),
        smoothness=np.ones(4, np.float32),
        displacement=turns,
        natural=np.ones(4, np.bool_),
    )
    table = solve(graph, task)
    node, facing, best = np.zeros(1, np.int32), 0.0, np.zeros(1, np.int32)
    ticks = 0
    while math.radians(85.0) - facing > slow and ticks < 200:
        heading = np.array([math.radians(85.0) - facing])
        best_edges(
            node,
            heading,
            np.zeros(1, np.int32),
            task.headed,
            task.heading_sigma,
            task.discount,
            table.values,
            graph.edge_start,
            graph.target,
            graph.behaviour,
            graph.displacement[:, 2],
            graph.smoothness,
            best,
        )
        facing += float(graph.displacement[best[0], 2])
        node = graph.target[best]
        ticks += 1
    assert ticks <= 57


@pytest.mark.parametrize("seed", range(3))
def test_the_table_chooses_as_the_exact_values_do(seed):
    graph = random_graph(seed, 8, 3)
    exact = np.zeros((8, 2, 12))
    for _ in range(250):
        exact = backup(graph, TASK, exact)
    table = solve(graph, TASK, tolerance=1e-7)
    for wanted, heading in product((0, 1), np.linspace(-3, 3, 7)):
        nodes = np.arange(8, dtype=np.int32)
        chosen = []
        for values in (table.values, exact):
            best = np.zeros(8, np.int32)
            best_edges(
                nodes,
                np.full(8, heading),
                np.full(8, wanted),
                TASK.headed,
                TASK.heading_sigma,
                TASK.discount,
                values,
                graph.edge_start,
                graph.target,
                graph.behaviour,
                graph.displacement[:, 2],
                graph.smoothness,
                best,
            )
            chosen.append(_worth(graph, best, wanted, heading, exact))
        np.testing.assert_allclose(chosen[0], chosen[1], atol=1e-5)


def _worth(graph, edges, wanted, heading, values):
    return [
        edge_value(
            heading,
            wanted,
            bool(TASK.headed[wanted]),
            int(graph.behaviour[graph.target[edge]]),
            float(graph.displacement[edge, 2]),
            float(graph.smoothness[edge]),
            values[graph.target[edge], wanted],
            TASK.heading_sigma,
            TASK.discount,
        )
        for edge in edges
    ]


def test_a_graph_that_the_task_does_not_fit_is_refused():
    with pytest.raises(InputError, match="behaviours stop, walk, run, jump, the graph has stop, walk"):
        solve(ring_graph(4), SteeringTask())
    chain = replace(ring_graph(4), edge_start=np.array([0, 2, 2, 3, 4], np.int32))
    with pytest.raises(InputError, match="node 1 leads nowhere"):
        solve(chain, SteeringTask(behaviours=("stop", "walk")))
