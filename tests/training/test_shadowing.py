"""Values of shadowing against dense solves, and the policy that plays them against the exact one."""

from dataclasses import replace

import numpy as np
import pytest

from exact_shadowing import MOVING, ExactShadowing, wandering_segments
from footwork.controllers.shadowing import NotShadowing, TableShadowing
from footwork.errors import InputError
from footwork.motion.shadowing_task import ShadowingTask
from footwork.training import shadowing
from footwork.training.annotated_recipe import annotated
from footwork.training.shadowing import solve_shadowing
from toy_graphs import graph_of, wandering_clip

TASK = ShadowingTask(distance=0.6, discount=0.9, farthest=2.0, distance_bins=4, bearing_bins=6)


@pytest.fixture(scope="module", params=[3, 8])
def solved(request):
    graph, notes = wandering_segments(request.param)
    exact = ExactShadowing(graph, notes, TASK)
    return exact, exact.solved(), solve_shadowing(graph, notes, 0, TASK, tolerance=1e-6)


def test_values_are_those_of_policy_iteration_with_dense_solves(solved):
    _, values, table = solved
    assert table.converged
    np.testing.assert_allclose(table.values, values, atol=1e-4)
    assert table.error_bound < 1e-4


def test_the_tables_greedy_policy_is_the_exact_one(solved):
    exact, values, table = solved
    policy = TableShadowing(exact.graph, exact.notes, table)
    random = np.random.default_rng(5)
    for segment in range(exact.notes.segment_count):
        choices = exact.choices(segment)
        for _ in range(6):
            x, z = random.uniform(-1.8, 1.8, 2)
            worth = exact.worths(values, segment, np.array([x, 0.0, z, 1.0]))
            taken = policy.next_edge(segment, x, z)
            assert worth[choices.index(taken)] == pytest.approx(worth.min(), abs=1e-4)


def test_an_opponent_out_of_reach_is_answered_too(solved):
    exact, _, table = solved
    assert np.isfinite(TableShadowing(exact.graph, exact.notes, table).next_edge(0, 1e6, -1e6))


def test_results_are_the_same_on_any_number_of_threads(solved, monkeypatch):
    exact, _, table = solved
    monkeypatch.setattr(shadowing, "THREADS", 7)
    again = solve_shadowing(exact.graph, exact.notes, 0, TASK, tolerance=1e-6)
    np.testing.assert_array_equal(again.values, table.values)


def test_a_table_that_did_not_converge_is_refused(solved):
    exact, _, _ = solved
    short = solve_shadowing(exact.graph, exact.notes, 0, TASK, max_sweeps=3)
    assert (short.converged, short.sweeps) == (False, 3)
    with pytest.raises(InputError, match=r"not converged: residual [\d.]+ after 3 sweeps"):
        TableShadowing(exact.graph, exact.notes, short)


def test_tables_of_other_segments_are_refused(solved):
    exact, _, table = solved
    with pytest.raises(InputError, match=r"values of \d+ segments, 'move' has"):
        TableShadowing(exact.graph, exact.notes, replace(table, values=table.values[1:]))
    with pytest.raises(InputError, match="state holds 1 to 1"):
        TableShadowing(exact.graph, exact.notes, replace(table, state=1))
    with pytest.raises(InputError, match="values has shape"):
        replace(table, values=table.values[:, :, 1:])


def test_segments_that_lead_nowhere_and_tasks_out_of_range_are_refused():
    graph = graph_of([wandering_clip(0, 8)], [])
    with pytest.raises(InputError, match=r"machine: states\.move: segment 0 leads to none of its own state"):
        solve_shadowing(graph, annotated(graph, MOVING, np.zeros(8, dtype=np.int16)), 0, TASK)
    with pytest.raises(InputError, match=r"distance_scale is 0\.0, expected a positive number"):
        ShadowingTask(distance_scale=0.0)
    with pytest.raises(InputError, match="1 distance bins, expected 2 to"):
        ShadowingTask(distance_bins=1)


def test_a_hop_from_another_states_segment_is_refused(solved):
    exact, _, table = solved
    policy = TableShadowing(exact.graph, exact.notes, table)
    policy.hops = policy.hops._replace(row=np.full_like(policy.hops.row, -1))
    with pytest.raises(NotShadowing, match="segment 2 is of another state"):
        policy.next_edge(2, 0.0, 1.0)
