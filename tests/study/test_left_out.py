"""Policies are scored on players that their player model has not seen."""

from dataclasses import replace

import numpy as np
import pytest

from footwork.controllers.controller import present_behaviours
from footwork.errors import InputError
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.motion.trace import Trace
from footwork.study.left_out import require_unseen, tables_without
from footwork.training.player_model import learned
from footwork.training.value_iteration import solve
from made_traces import trace
from toy_bundle import toy_bundle

GRAPH = toy_bundle().graph
TASK = SteeringTask(behaviours=GRAPH.behaviours, heading_bins=8)
PLAYERS = [
    replace(trace(f"{number}.csv", turn=0.03 * number, attack=number % 2), digest=f"{number:064}")
    for number in range(3)
]
STRANGER = replace(trace("stranger.csv"), digest="f" * 64)


def solved(traces: list[Trace]) -> PolicyTable:
    return solve(GRAPH, TASK, player=learned(traces, TASK, present_behaviours(GRAPH))).compact


@pytest.fixture(scope="module")
def table() -> PolicyTable:
    return solved(PLAYERS)


def test_a_trace_that_was_learned_from_is_refused_with_its_name_and_digest(table):
    with pytest.raises(InputError, match=rf"^2\.csv: .*{PLAYERS[2].digest}.*--leave-one-out"):
        require_unseen(table, [STRANGER, PLAYERS[2]])


def test_the_file_counts_and_not_its_name(table):
    with pytest.raises(InputError, match="copy"):
        require_unseen(table, [replace(PLAYERS[0], name="copy.csv")])
    require_unseen(table, [replace(STRANGER, name=PLAYERS[0].name)])


def test_a_policy_for_persistent_players_has_seen_nobody():
    require_unseen(solve(GRAPH, TASK), PLAYERS)


def test_each_trace_has_the_table_of_all_the_others(table):
    tables = tables_without(GRAPH, table, [*PLAYERS, STRANGER])
    for number, left_out in enumerate(PLAYERS):
        own = tables[left_out.digest]
        require_unseen(own, [left_out])
        again = solved([player for player in PLAYERS if player is not left_out])
        np.testing.assert_allclose(own.values, again.values, atol=own.error_bound + again.error_bound)
        assert not np.array_equal(own.values, table.values), number
    assert tables[STRANGER.digest] is table


def test_how_far_it_has_come_is_told(table):
    told: list[tuple[str, float]] = []
    tables_without(GRAPH, table, PLAYERS, progress=lambda what, share: told.append((what, share)))
    assert list(dict.fromkeys(what for what, _ in told)) == [f"without {one.name}" for one in PLAYERS]
    shares = [share for _, share in told]
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)


def test_all_that_was_learned_from_must_be_there(table):
    with pytest.raises(InputError, match=rf"^1\.csv \(SHA-256 {PLAYERS[1].digest}\): .*not among the traces"):
        tables_without(GRAPH, table, [PLAYERS[0], PLAYERS[2]])


def test_nothing_to_leave_out_and_nothing_left_are_refused():
    with pytest.raises(InputError, match="--leave-one-out: no player model"):
        tables_without(GRAPH, solve(GRAPH, TASK), PLAYERS)
    with pytest.raises(InputError, match="it alone"):
        tables_without(GRAPH, solved(PLAYERS[:1]), PLAYERS)
