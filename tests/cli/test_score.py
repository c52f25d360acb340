"""``footwork score`` as a user meets it: which controller, which player, and what means nothing."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from footwork.cli.main import main
from footwork.motion.bundle import read_bundle, write_bundle
from footwork.motion.trace import COLUMNS, read_trace
from footwork.training.player_model import learned
from footwork.training.value_iteration import solve
from toy_bundle import toy_bundle

BAD_INPUT = 2


def write_trace(path: Path, turn: float) -> Path:
    """A player who runs for a second, turns by so many degrees a tick, jumps, stands."""
    rows = [f"{tick},{int(tick < 60)},0,0,{turn if tick > 35 else 0},{int(tick == 50)},0" for tick in range(70)]
    path.write_text("\n".join([",".join(COLUMNS), *rows]) + "\n")
    return path


@pytest.fixture(scope="module")
def traces(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("traces")
    for number in range(3):
        write_trace(folder / f"player{number}.csv", 1.0 + number)
    return folder


@pytest.fixture(scope="module")
def bundle(tmp_path_factory) -> Path:
    """A bundle whose policy is for persistent players."""
    path = tmp_path_factory.mktemp("bundles") / "toy.footwork"
    toy = toy_bundle()
    write_bundle(path, replace(toy, tables={"steering": solve(toy.graph, toy.table("steering").task)}))
    return path


@pytest.fixture(scope="module")
def taught(bundle, traces) -> Path:
    """The same with a player model that learned from the traces."""
    plain = read_bundle(bundle)
    task = plain.table("steering").task
    player = learned([read_trace(path) for path in sorted(traces.iterdir())], task, ("stop", "walk", "jump"))
    write_bundle(
        bundle.with_name("taught.footwork"),
        replace(plain, tables={"steering": solve(plain.graph, task, player=player)}),
    )
    return bundle.with_name("taught.footwork")


def scored(capsys, *arguments: object) -> dict:
    assert main(["score", *map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(
    "options",
    [
        (),
        ("--controller", "table", "--no-exact-facing", "--no-shortlist"),
        ("--controller", "greedy", "--no-inertialise"),
        ("--controller", "oracle", "--no-foot-lock"),
        ("--controller", "oracle", "--foresight", "0.5"),
    ],
)
def test_every_controller_is_scored(capsys, bundle, traces, options):
    report = scored(capsys, bundle, "--traces", traces, *options)
    assert report["total"] == pytest.approx(report["control"] * report["transition"])
    assert [trace["file"] for trace in report["traces"]] == ["player0.csv", "player1.csv", "player2.csv"]


def test_motion_matching_plays_the_frames_of_the_bundle_or_of_motions(capsys, bundle, traces):
    options = ("--traces", traces / "player0.csv", "--controller", "motion-matching")
    own = scored(capsys, bundle, *options)
    assert 0.0 <= own["total"] <= 1.0
    other = scored(capsys, bundle, *options, "--form", "strong", "--motions", "embedded:locomotion")
    assert other["clip_mb"] > own["clip_mb"]


def test_who_knows_the_player_scores_no_less(capsys, bundle, traces):
    totals = [
        scored(capsys, bundle, "--traces", traces, "--controller", name)["total"] for name in ("greedy", "oracle")
    ]
    assert totals[0] < totals[1] + 0.02


def test_players_that_a_policy_learned_from_are_refused_or_left_out(capsys, taught, traces):
    assert main(["score", str(taught), "--traces", str(traces)]) == BAD_INPUT
    said = capsys.readouterr().err
    assert re.search(r"player0\.csv: .*SHA-256 [0-9a-f]{64}\).*--leave-one-out", said)
    assert said.count("\n") == 1
    report = scored(capsys, taught, "--traces", traces, "--leave-one-out")
    assert len(report["traces"]) == 3


def test_a_copy_under_another_name_is_refused_and_another_player_is_not(capsys, taught, traces, tmp_path):
    (tmp_path / "copy.csv").write_bytes((traces / "player1.csv").read_bytes())
    assert main(["score", str(taught), "--traces", str(tmp_path / "copy.csv")]) == BAD_INPUT
    capsys.readouterr()
    other = write_trace(tmp_path / "other.csv", -2.0)
    assert scored(capsys, taught, "--traces", other)["ticks"] == 60


def test_a_policy_that_knows_nobody_needs_no_leaving_out(capsys, bundle, traces):
    assert main(["score", str(bundle), "--traces", str(traces), "--leave-one-out"]) == BAD_INPUT
    assert "--leave-one-out: no player model learned from traces" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--controller", "magic"), "--controller: 'magic' is none, there is table, greedy, oracle, motion-matching"),
        (("--foresight", "1"), "--foresight: means nothing for --controller table, only for oracle"),
        (("--controller", "greedy", "--foresight", "1"), "--foresight: means nothing for --controller greedy"),
        (("--controller", "oracle", "--form", "strong"), "--form: means nothing for --controller oracle"),
        (("--controller", "motion-matching", "--form", "odd"), "--form: 'odd' is none, there is reference, strong"),
        (("--controller", "greedy", "--no-exact-facing"), "--no-exact-facing: means nothing for --controller greedy"),
        (("--controller", "oracle", "--no-shortlist"), "--no-shortlist: means nothing for --controller oracle"),
        (("--motions", "captures"), "--motions: means nothing for --controller table, only for motion-matching"),
        (("--labels", "labels.csv"), "--labels, --ranges, --table, --bvh-unit: no motions to read"),
        (("--controller", "motion-matching", "--motions", "embedded:x"), "there are locomotion, fighting"),
        (("--controller", "oracle", "--leave-one-out"), "--leave-one-out: means nothing for --controller oracle"),
        (("--controller", "oracle", "--foresight", "-1"), "--foresight: -1"),
        (("--controller", "oracle", "--foresight", "nan"), "--foresight: nan"),
        (("--controller", "oracle", "--foresight", "99"), "--foresight: 99"),
    ],
)
def test_what_means_nothing_is_said_in_one_line(capsys, bundle, traces, options, said):
    assert main(["score", str(bundle), "--traces", str(traces), *options]) == BAD_INPUT
    shown = capsys.readouterr()
    assert said in shown.err
    assert shown.err.count("\n") == 1
    assert shown.out == ""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("tick,forward\n0,1\n1,1\n", "no column strafe"),
        (",".join(COLUMNS) + "\n0,1,0,0,0,0,0\n", "rows: 1, expected at least 2"),
        (",".join(COLUMNS) + "\n0,1,0,0,nan,0,0\n1,1,0,0,0,0,0\n", "bad.csv:2: 'nan' is not a finite number"),
        (",".join(COLUMNS) + "\n0,1,0,0,0,0,0\n2,1,0,0,0,0,0\n4,1,0,0,0,0,0\n", "17.5 rows a second"),
        ("", "is empty"),
    ],
)
def test_a_bad_trace_among_good_ones_stops_the_score(capsys, bundle, traces, tmp_path, text, said):
    for path in traces.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "bad.csv").write_text(text)
    assert main(["score", str(bundle), "--traces", str(tmp_path)]) == BAD_INPUT
    shown = capsys.readouterr()
    assert said in shown.err
    assert "bad.csv" in shown.err
    assert shown.err.count("\n") == 1


def test_a_folder_without_traces_is_refused(capsys, bundle, tmp_path):
    assert main(["score", str(bundle), "--traces", str(tmp_path)]) == BAD_INPUT
    assert "no CSV files in it" in capsys.readouterr().err


def test_a_build_with_a_bad_trace_writes_nothing(capsys, tmp_path):
    (tmp_path / "bad.csv").write_text("tick\n0\n")
    out = tmp_path / "x.footwork"
    for players, said in ((tmp_path, "bad.csv:1: no column forward"), (tmp_path / "none", "cannot be read")):
        assert main(["build", "embedded:locomotion", "--out", str(out), "--players", str(players)]) == BAD_INPUT
        assert said in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["bad.csv"]


def test_values_that_were_read_are_those_that_were_solved_for(taught):
    assert np.isfinite(read_bundle(taught).table("steering").values).all()
