"""Shadowing measured, and the rows on fights, on the embedded fighting motions with a coarse table."""

import json
from dataclasses import replace

import numpy as np
import pytest

from footwork.cli.motions import embedded_dataset
from footwork.motion.shadowing_task import ShadowingTask
from footwork.runtime.match import fight_ground, table_of
from footwork.study.reproduction import fights
from footwork.study.reproduction.motion_sets import LABELS, RANGES, SETS, MotionSets
from footwork.study.reproduction.row import Verdict
from footwork.study.reproduction.rows import fight_speed
from footwork.study.reproduction.rows import fights as fights_row
from footwork.study.reproduction.state_annotated import MACHINE
from footwork.study.reproduction.workbench import Workbench
from footwork.study.shadowing_trials import PATIENCE, bearings, distances, shadowing_trials
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions
from footwork.training.shadowing import solve_shadowing

COARSE = ShadowingTask(distance_bins=16, bearing_bins=12)


@pytest.fixture(scope="module")
def built():
    bundle, report = build_bundle(embedded_dataset("fighting"), GraphOptions(graph="annotated"), machine=MACHINE)
    assert bundle.annotation is not None
    table = solve_shadowing(bundle.graph, bundle.annotation, 0, COARSE)
    return replace(bundle, shadowing=table), report


@pytest.fixture(scope="module")
def ground(built):
    return fight_ground(built[0])


@pytest.fixture
def bench(tmp_path):
    for name in SETS:
        (tmp_path / name).mkdir()
    for name in (LABELS, RANGES):
        (tmp_path / name).touch()
    return Workbench(MotionSets(tmp_path), quick=True)


def test_distance_and_bearing_are_as_seen_by_each():
    places = np.array([[[0.0, 0.0, 0.0], [3.0, 4.0, np.pi]]])
    np.testing.assert_allclose(distances(places), [5.0])
    ahead = np.arctan2(3.0, 4.0)
    np.testing.assert_allclose(bearings(places), [[ahead, ahead]])


def test_the_table_shadows_better_than_the_rule(ground):
    size = {"matches": 3, "pushes": 6, "seconds": 20.0}
    rule, table = (shadowing_trials(ground, by, turn=3.0, **size) for by in (None, table_of(ground.bundle)))
    for name in ("distance", "facing", "recovery"):
        ours, theirs = (getattr(one, name).value for one in (table, rule))
        assert 0.0 < ours < theirs
    assert table.recovered == 1.0
    assert (table.recovery.high or PATIENCE) < PATIENCE
    json.dumps(table.record(), allow_nan=False)


def test_a_bout_adds_up(ground):
    one = fights.bout(ground, 20.0, None)
    assert sum(one.share.values()) == pytest.approx(1.0)
    assert one.counts["hits"] <= one.counts["strikes"]
    assert 0.0 < one.longest < one.seconds
    assert one.nearest > 0.0
    assert fights.bout(ground, 20.0, None) == one


@pytest.mark.parametrize("row", [fights_row.ROW, fight_speed.ROW])
def test_without_fighting_nothing_can_be_judged(bench, row):
    assert {judgement.verdict for judgement in row.run(bench).judgements} == {Verdict.OPEN}


@pytest.mark.parametrize("row", [fights_row.ROW, fight_speed.ROW])
def test_rows_have_tables_and_verdicts(bench, built, ground, row, monkeypatch):
    monkeypatch.setattr(fight_speed, "TICKS", 60)
    (bench.motions.folder / fights.SET).mkdir()
    bench.once(("fight bundle", False), lambda: built)
    bench.once(("fight ground", False), lambda: ground)
    result = row.run(bench)
    json.dumps(result.numbers, allow_nan=False)
    assert result.tables
    for table in result.tables:
        assert all(len(line) == len(table.columns) for line in table.rows)
    verdicts = [judgement.verdict for judgement in result.judgements]
    assert Verdict.OPEN not in verdicts
    assert Verdict.HOLDS in verdicts
