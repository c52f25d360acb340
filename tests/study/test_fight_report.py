"""Reports of fights, against the places that they are made from."""

import math

import numpy as np

from fighting_bundle import fighting_bundle, fighting_ground
from footwork.controllers.fighting_style import STYLES
from footwork.runtime.match import Match
from footwork.study.exchange_sheet import exchange_sheet
from footwork.study.fight_report import counts_report, distances, facing_errors, longest_run, timed


def test_distance_and_facing_are_those_that_the_match_tells():
    match = Match(fighting_ground(), [STYLES["balanced"]] * 2, 3)
    for _ in range(40):
        match.step()
        for who in range(2):
            seen = match.relative(who)
            assert math.isclose(distances(match.track)[0], seen.distance, abs_tol=1e-12)
            assert math.isclose(facing_errors(match.track)[0, who], abs(seen.bearing), abs_tol=1e-9)


def test_a_report_adds_up():
    match = Match(fighting_ground(), [STYLES["balanced"]] * 2, 3)
    watched, wall = timed(match, 1200)
    seen, counts = watched.report(), counts_report(match)
    assert wall > 0.0
    assert match.tick == 1200
    assert seen["distance_m"]["smallest"] <= seen["distance_m"]["mean"] <= seen["distance_m"]["p95"]
    assert seen["facing_error_deg"]["mean"] <= seen["facing_error_deg"]["p95"] <= 180.0
    assert math.isclose(sum(counts["activity_share"].values()), 1.0)
    assert 0.0 <= seen["longest_pause_s"] <= 40.0
    assert counts["attacks"] == sum(one["attacks"] for one in counts["fighters"])
    assert counts["hits"] <= counts["strikes"]
    assert counts["dead_ends"] == 0


def test_the_longest_run_is_found():
    assert longest_run(np.array([1, 1, 0, 1, 1, 1, 0], dtype=bool)) == 3
    assert longest_run(np.zeros(4, dtype=bool)) == 0


def test_an_exchange_is_drawn(tmp_path):
    match = Match(fighting_ground(), [STYLES["balanced"]] * 2, 3)
    poses = match.play(24, shown=True)[::8]
    path = exchange_sheet(tmp_path / "sheet.png", fighting_bundle().graph.skeleton, poses, ["a", "b", "c"])
    assert path.read_bytes().startswith(b"\x89PNG")
    assert np.isfinite(poses).all()
