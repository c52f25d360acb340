"""The rows in which recorded players steer characters: what they say without players, and what they judge."""

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.study.measures import Followed
from footwork.study.reproduction import workbench
from footwork.study.reproduction.character_tables import characters_table, control_chart, heading_chart, shares_table
from footwork.study.reproduction.motion_sets import MotionSets
from footwork.study.reproduction.players import Setting, bundle_of, motions_of, players_of, score_of, unseen
from footwork.study.reproduction.row import Verdict
from footwork.study.reproduction.rows import characters, control_policies
from footwork.study.reproduction.workbench import Workbench
from reproduction_motions import write_motion_sets
from shared_data import TRACES, needs_traces

ROWS = (control_policies.ROW, characters.ROW)


@pytest.fixture(scope="module")
def motions(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workbench, "WEIGHTS", 2)
        yield MotionSets(write_motion_sets(tmp_path_factory.mktemp("motions")))


def score_like(total: float, slide: float = 5.0, decision: float = 1.0) -> dict:
    return {
        "control": total,
        "transition": 1.0,
        "transition_jumps": None,
        "total": total,
        "switch_share": 0.1,
        "foot_slide_cm_s": slide,
        "source_foot_slide_cm_s": 4.0,
        "batch": {"decision_us": {"mean": decision, "p99": decision}},
        "intervals": {"total": [total - 0.1, total + 0.1]},
        "traces": [{"ticks": 10, "control": total, "transition": 1.0}],
        "frames": 10,
    }


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_without_players_nothing_is_judged_and_nothing_fails(motions, row):
    result = row.run(Workbench(motions, quick=True))
    assert {judgement.verdict for judgement in result.judgements} == {Verdict.OPEN}
    assert "--traces" in result.judgements[0].reason


def test_too_few_players_to_learn_from_are_told(motions, tmp_path):
    (tmp_path / "one.csv").write_text("")
    with pytest.raises(InputError, match="1 CSV files in it, expected traces to learn from and others to score"):
        players_of(Workbench(motions, traces=tmp_path))


def test_characters_are_judged_against_the_strong_rival_and_their_clips():
    graphs = {"standard 5, mirrored, warped": score_like(0.5), "well-connected 0.2, mirrored, warped": score_like(0.6)}
    others = {"motion matching, strong": score_like(0.58, slide=40.0, decision=20.0)}
    judged = characters._judgements(graphs, "well-connected 0.2, mirrored, warped", others)
    assert [one.verdict for one in judged] == [Verdict.HOLDS] * 5
    sliding = graphs | {"well-connected 0.2, mirrored, warped": score_like(0.45, slide=7.0, decision=2.5)}
    judged = characters._judgements(sliding, "well-connected 0.2, mirrored, warped", others)
    assert [one.verdict for one in judged] == [Verdict.FAILS] * 5


def test_table_6_is_judged_by_the_best_standard_graph():
    found = {(kind, setting.threshold): score_like(0.3) for kind, setting in control_policies.SETTINGS}
    found["wcMG", 0.2] = score_like(0.6)
    assert control_policies._total("", found).verdict is Verdict.HOLDS
    found["MG", 5.0] = score_like(0.7)
    assert control_policies._total("", found).verdict is Verdict.FAILS
    assert control_policies._control("", found).verdict is Verdict.FAILS


def test_characters_that_could_not_be_made_have_a_line_of_dashes():
    table = characters_table("", {"there": score_like(0.5), "not there": None})
    assert all(len(line) == len(table.columns) for line in table.rows)
    assert set(table.rows[1][1:]) == {None}
    assert shares_table("", {"a": 0.2, "b": 0.4}).rows[0] == ["a", 0.2, 50.0]


def test_charts_are_drawn():
    ticks, no = np.arange(60), np.zeros(60, bool)
    nothing, turning = np.zeros(60, np.int32), np.radians(9.0 * ticks)
    followed = Followed(turning, nothing, nothing, turning - 0.2, nothing, np.zeros(60), no, no)
    assert "var(--rival)" in heading_chart({"rival": ("rival", followed)}, 1.0).svg
    assert "var(--well)" in control_chart({"ours": ("well", [score_like(0.5)]), "none": ("ink", [])}).svg


@needs_traces
def test_a_quick_run_scores_a_character_on_the_beginnings_of_real_players(motions):
    bench = Workbench(motions, traces=TRACES, quick=True)
    assert [trace.seconds for trace in players_of(bench)] == [20.0, 20.0]
    assert len(unseen(bench)) == 1
    bundle = bundle_of(bench, motions_of(bench, "dataset3"), Setting("standard", 20.0))
    assert bundle is not None
    assert bundle.table("steering").player is not None
    assert 0.0 < score_of(bench, bundle)["total"] < 1.0
    assert bundle_of(bench, motions_of(bench, "dataset3"), Setting("standard", 0.001)) is None
