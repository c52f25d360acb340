"""``footwork fight``: one match, a league, a recording, and input that is refused in a line."""

import json
from pathlib import Path

import msgpack
import numpy as np
import pytest

from fighting_bundle import fighting_bundle
from footwork.cli.main import main
from footwork.cli.recorded_film import recorded_film
from footwork.motion.bundle import write_bundle
from footwork.runtime.arena import Arena
from footwork.runtime.opponent import opponent_named
from footwork.runtime.replay import start_recording
from toy_bundle import toy_bundle


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    path = tmp_path_factory.mktemp("fight") / "fighters.footwork"
    write_bundle(path, fighting_bundle())
    return str(path)


def told(capsys, *arguments):
    assert main(["fight", *arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_one_match_is_told_recorded_and_made_again(bundle, tmp_path, capsys):
    path = tmp_path / "match.footrec"
    report = told(
        capsys, bundle, "--seconds", "20", "--seed", "3", "--styles", "aggressive,evasive", "--record", str(path)
    )
    assert {"seconds", "wall_s", "ticks_per_second", "decision_us", "attacks", "hits", "evades"} <= set(report)
    assert {"mean", "p95"} <= set(report["facing_error_deg"]) & set(report["distance_m"])
    assert report["seconds"] == 20.0
    assert report["styles"] == ["aggressive", "evasive"]
    assert main(["replay", str(path), "--bundle", bundle, "--verify", "--json"]) == 0
    replayed = json.loads(capsys.readouterr().out)
    assert (replayed["ticks"], replayed["departed_at"]) == (600, None)


def test_a_league_is_told_as_a_table(bundle, capsys):
    report = told(
        capsys, bundle, "--seconds", "4", "--styles", "aggressive,patient,evasive", "--league", "--matches", "2"
    )
    assert report["matches"] == 6
    assert sorted(row["style"] for row in report["table"]) == ["aggressive", "evasive", "patient"]
    assert sum(row["points"] for row in report["table"]) == 6.0


def test_a_file_brings_styles_and_rules(bundle, tmp_path, capsys):
    config = tmp_path / "fight.toml"
    config.write_text("[styles.still]\neagerness = 0.0\nreadiness = 0.0\n\n[match]\nround_seconds = 2\n")
    report = told(
        capsys, bundle, "--seconds", "4", "--styles", "still,still", "--config", str(config), "--matches", "3"
    )
    assert report["table"][0]["drawn"] == 6


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["--styles", "drunken,patient"], "no style 'drunken', expected balanced"),
        (["--styles", "patient"], "1 styles, expected two"),
        (["--styles", "patient,patient", "--league"], "expected two different styles or more"),
        (["--seconds", "0"], "--seconds: 0, expected 0.0333333 to 36000"),
        (["--matches", "0"], "--matches: 0, expected 1"),
        (["--workers", "0"], "--workers: 0, expected 1 to 1024"),
        (["--seed", "-1"], "--seed: -1, expected 0"),
        (["--matches", "2", "--record", "x.footrec"], "one match alone can be recorded"),
        (["--config", "nowhere.toml"], "nowhere.toml: cannot be read"),
    ],
)
def test_bad_input_is_refused_in_one_line(bundle, capsys, arguments, problem):
    assert main(["fight", bundle, *arguments]) == 2
    error = capsys.readouterr().err
    assert problem in error
    assert error.count("\n") == 1


def test_a_number_out_of_range_is_refused_with_the_range(bundle, tmp_path, capsys):
    config = tmp_path / "fight.toml"
    config.write_text("[match]\npush = 99\n")
    assert main(["fight", bundle, "--config", str(config)]) == 2
    assert "match: push is 99, expected a number from 0 to 3" in capsys.readouterr().err


def test_a_bundle_without_states_is_refused(tmp_path, capsys):
    path = tmp_path / "toy.footwork"
    write_bundle(path, toy_bundle())
    assert main(["fight", str(path)]) == 2
    assert "no states, expected a bundle built with --graph annotated" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["serve", "BUNDLE", "--opponent", "nobody"], "no style 'nobody', expected balanced"),
        (["serve", "BUNDLE", "--config", "fight.toml"], "expected --opponent too"),
        (["serve", "BUNDLE", "--opponent", "patient", "--seed", "-1"], "expected 0 to"),
        (["serve", "TOY", "--opponent", "patient"], "no states"),
        (["play", "tcp://127.0.0.1:1", "--opponent", "patient", "--text"], "has opponents or none"),
        (["play", "BUNDLE", "--fight", "--opponent", "patient"], "--opponent: is for a fight of one's own"),
        (["play", "BUNDLE", "--fight", "--config", "fight.toml"], "--config: is for a fight of one's own"),
    ],
)
def test_opponents_that_cannot_be_are_refused_in_a_line(arguments, problem, bundle, tmp_path, capsys):
    toy = tmp_path / "toy.footwork"
    write_bundle(toy, toy_bundle())
    places = {"BUNDLE": bundle, "TOY": str(toy)}
    assert main([places.get(argument, argument) for argument in arguments]) != 0
    said = capsys.readouterr().err
    assert problem in said
    assert "Traceback" not in said


def test_a_recorded_fight_of_players_is_shown_as_a_film_with_everyones_health(bundle, tmp_path, capsys):
    arena, path = Arena(fighting_bundle(), 2, opponent=opponent_named("aggressive")), tmp_path / "fight.footrec"
    recorder = start_recording(arena, path, rate=30)
    for ticks in (40, 20):
        slot = arena.spawn(0.0, 0.0, 0.0)
        arena.play(ticks, 0)
        arena.remove(slot)
    arena.end_recording()
    recorder.wait()
    film = msgpack.unpackb(recorded_film(path, Path(bundle), 0.0, None))
    assert [(role["first"], len(role["health"])) for role in film["roles"]] == [(0, 160), (0, 160), (40, 80), (40, 80)]
    assert main(["play", str(path), "--bundle", str(bundle), "--opponent", "patient"]) == 2
    assert "or was recorded" in capsys.readouterr().err
    assert np.frombuffer(film["roles"][0]["health"], "<f4")[0] == 1.0
