"""The row on state-annotated graphs, and paths through states: on the embedded fighting motions."""

import json
from itertools import groupby

import pytest

from footwork.cli.motions import embedded_dataset
from footwork.study.graph_paths import path_nodes
from footwork.study.reproduction import registry
from footwork.study.reproduction.motion_sets import LABELS, RANGES, SETS, MotionSets
from footwork.study.reproduction.row import Verdict
from footwork.study.reproduction.rows import state_statistics
from footwork.study.reproduction.state_annotated import MACHINE, MOVING, STATES
from footwork.study.reproduction.workbench import Workbench
from footwork.study.state_paths import path_through_states
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions


@pytest.fixture
def motions(tmp_path) -> MotionSets:
    for name in SETS:
        (tmp_path / name).mkdir()
    for name in (LABELS, RANGES):
        (tmp_path / name).touch()
    return MotionSets(tmp_path)


def test_the_row_is_there():
    assert [row.name for row in registry.chosen_rows(["A"])] == ["A-T1", "A-R", "A-C"]


def test_without_fighting_it_cannot_be_judged(motions):
    result = state_statistics.ROW.run(Workbench(motions, quick=True))
    assert {judgement.verdict for judgement in result.judgements} == {Verdict.OPEN}


def test_states_stand_beside_the_published_ones(motions, monkeypatch):
    # generated motions repeat themselves, so that their costs have a knee far too low
    monkeypatch.setattr(state_statistics, "THRESHOLD", 1.0)
    (motions.folder / state_statistics.SET).mkdir()
    bench = Workbench(motions, quick=True)
    bench.once(("dataset", state_statistics.SET, True), lambda: embedded_dataset("fighting"))
    result = state_statistics.ROW.run(bench)
    json.dumps(result.numbers, allow_nan=False)
    for table in result.tables:
        assert all(len(line) == len(table.columns) for line in table.rows)
    assert [line[0] for line in result.tables[0].rows] == list(STATES)
    by_claim = {judgement.claim: judgement.verdict for judgement in result.judgements}
    assert by_claim[state_statistics.SHORT_AND_MANY] is Verdict.HOLDS
    assert by_claim[state_statistics.REACHED] is Verdict.HOLDS
    assert result.figures[0].png.startswith(b"\x89PNG")


def report_like(near: float, without: int = 0) -> dict:
    states = [
        {"state": name, "segments": 9, "mean_segment_s": 0.2 if name == MOVING else 1.0, "nodes": 9} for name in STATES
    ]
    pairs = [
        {"to": name, "pairs": 9, "pairs_without_way": without, "nearest_s": near, "mean_s": near}
        for name in ("attack", "evade")
    ]
    return {"states": states, "at_once": pairs}


def test_delays_are_judged_against_a_mean_locomotion_node():
    assert state_statistics._quick({state_statistics.AT_KNEE: report_like(0.05)}).verdict is Verdict.HOLDS
    slow = state_statistics._quick({state_statistics.AT_KNEE: report_like(0.15), "at 9": report_like(0.01)})
    assert slow.verdict is Verdict.FAILS
    assert "at 9 0.01 s and 0.01 s against 0.20 s" in slow.reason


def test_what_cannot_be_reached_is_named():
    judged = state_statistics._reached({state_statistics.AT_KNEE: report_like(0.05), "at 9": report_like(0.05, 2)})
    assert judged.verdict is Verdict.FAILS
    assert "at 9: 2 of 9 pairs to attack" in judged.reason


def test_a_path_comes_through_the_states_in_turn():
    bundle, _ = build_bundle(embedded_dataset("fighting"), GraphOptions(graph="annotated"), machine=MACHINE)
    graph, notes = bundle.graph, bundle.annotation
    assert notes is not None
    edges = path_through_states(graph, notes, 0, [1, 0, 2, 0], 20)
    shown = notes.state[notes.segment[path_nodes(graph, edges)]]
    assert [state for state, _ in groupby(shown.tolist())] == [0, 1, 0, 2, 0]
