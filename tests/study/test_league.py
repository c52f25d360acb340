"""Leagues: every pair meets, seeds differ, points add up, and workers change nothing."""

import pytest

from fighting_bundle import fighting_ground
from footwork.controllers.fighting_style import STYLES
from footwork.runtime.match_rules import MatchRules
from footwork.study.league import Bout, Outcome, bouts_of, outcomes, standings

NAMES = ["aggressive", "patient", "evasive"]


def test_every_pair_meets_as_often_each_style_first_in_every_other_match():
    bouts = bouts_of(NAMES, 4, 10)
    assert [bout.seed for bout in bouts] == list(range(10, 22))
    assert sum(bout.first == "aggressive" and bout.second == "patient" for bout in bouts) == 2
    assert sum(bout.first == "patient" and bout.second == "aggressive" for bout in bouts) == 2
    assert all(sum(name in (bout.first, bout.second) for bout in bouts) == 8 for name in NAMES)


def test_the_outcome_does_not_hang_on_how_many_work():
    def fought(workers):
        run = outcomes(
            fighting_ground(), STYLES, bouts_of(NAMES, 1, 3), 300, rules=MatchRules(round_seconds=2), workers=workers
        )
        return list(run)

    assert fought(1) == fought(3)


def test_standings_add_up():
    results = [
        Outcome(Bout("aggressive", "patient", 1), 0, (5, 2), (0.5, 0.2)),
        Outcome(Bout("patient", "aggressive", 2), None, (1, 1), (0.1, 0.1)),
        Outcome(Bout("evasive", "patient", 3), 1, (0, 4), (0.0, 0.4)),
    ]
    table = standings(NAMES, results)
    assert [row["style"] for row in table] == ["aggressive", "patient", "evasive"]
    first, second, third = table
    assert (first["won"], first["drawn"], first["points"], first["hits"], first["hits_taken"]) == (1, 1, 1.5, 6, 3)
    assert (second["matches"], second["points"]) == (3, 1.5)
    assert third["points"] == pytest.approx(0.0)
