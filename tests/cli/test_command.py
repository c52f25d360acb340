"""The command as a user meets it: JSON alone on stdout, bad input as one line and exit status 2."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from footwork.cli.main import BAD_INPUT, main
from footwork.motion.body import default_body
from footwork.motion.bundle import read_bundle
from footwork.motion.bvh import write_bvh
from footwork.motion.clip import Clip
from footwork.training.embedded import embedded_clips

CLIPS = ("idle", "walk_normal", "turn_90_left", "turn_90_right")


def footwork(*arguments: object, status: int = 0) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "footwork.cli.main", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)
    assert done.returncode == status, done.stderr
    assert "Traceback" not in done.stderr
    return done


@pytest.fixture
def refused(capsys):
    """What is said on stderr about arguments that are bad, without starting a process for each."""

    def said(*arguments: object) -> str:
        assert main([str(one) for one in arguments]) == BAD_INPUT
        shown = capsys.readouterr()
        assert shown.out == ""
        assert shown.err.splitlines()[-1].startswith("footwork: ")
        return shown.err

    return said


@pytest.fixture
def reported(capsys):
    """The JSON object that a subcommand prints, without starting a process for it."""

    def report(*arguments: object) -> dict:
        assert main([*map(str, arguments), "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return report


@pytest.fixture(scope="module")
def captures(tmp_path_factory):
    """A folder of BVH files with their labels, as a user would have it."""
    folder = tmp_path_factory.mktemp("captures")
    rows = ["set,file,start_frame,end_frame,label"]
    for clip in embedded_clips():
        if clip.name in CLIPS:
            write_bvh(folder / f"{clip.name}.bvh", clip)
            rows += [f"captures,{clip.name}.bvh,{k},{k + 1},{label}" for k, label in enumerate(clip.labels)]
    labels = folder.parent / "labels.csv"
    labels.write_text("\n".join(rows).replace("captures,", f"{folder.name},") + "\n")
    return folder, labels


@pytest.fixture(scope="module")
def bundle(captures):
    folder, labels = captures
    path = folder.parent / "walker.footwork"
    report = json.loads(footwork("build", folder, "--labels", labels, "--out", path, "--json").stdout)
    return path, report


def test_build_reports_what_it_did(bundle):
    path, report = bundle
    assert set(report) >= {"frames", "nodes", "edges", "scc_nodes", "scc_fraction", "threshold", "seconds", "digest"}
    assert set(report["seconds"]) == {"read", "compile", "metric", "graph", "policy", "total"}
    assert report["policy"]["converged"] is True
    assert report["digest"] == read_bundle(path).digest
    assert 0 < report["scc_nodes"] <= report["nodes"] == report["frames"]


def test_building_twice_gives_the_same_bytes(captures, bundle, tmp_path):
    folder, labels = captures
    footwork("build", folder, "--labels", labels, "--out", tmp_path / "again.footwork")
    assert (tmp_path / "again.footwork").read_bytes() == bundle[0].read_bytes()


def test_inspect_says_what_is_in_a_bundle_and_draws_it(reported, bundle, tmp_path):
    report = reported("inspect", bundle[0], "--plots", tmp_path / "plots")
    assert report["nodes"] == bundle[1]["scc_nodes"]
    assert report["plots"]
    begins = {".svg": b"<svg ", ".png": b"\x89PNG", ".html": b"<!doctype html>"}
    assert {Path(picture).suffix for picture in report["plots"]} >= {".svg", ".png"}
    assert all(Path(one).read_bytes().startswith(begins[Path(one).suffix]) for one in report["plots"])


def test_inspect_looks_at_motions_before_anything_is_built(reported, captures):
    folder, labels = captures
    report = reported("inspect", folder, "--labels", labels)
    assert report["clips"] == len(CLIPS)
    assert report["labels"]["walk"] > 0


def test_lengths_of_a_bvh_may_be_in_another_unit(reported, refused, tmp_path):
    clip = next(clip for clip in embedded_clips() if clip.name == "walk_normal")
    write_bvh(tmp_path / "walk.bvh", clip, unit=1.0)
    assert "another unit" in refused("inspect", tmp_path)
    report = reported("inspect", tmp_path, "--bvh-unit", "1")
    assert report["frames"] == clip.frame_count


def test_score_replays_traces(reported, bundle, tmp_path):
    rows = ["tick,forward,strafe,run,yaw_delta_deg,attack,use"]
    rows += [f"{tick},1,0,0,{1.40625 if 100 < tick < 160 else 0},0,0" for tick in range(350)]
    (tmp_path / "trace.csv").write_text("\n".join(rows) + "\n")
    report = reported("score", bundle[0], "--traces", tmp_path)
    assert report["total"] == pytest.approx(report["control"] * report["transition"])
    assert len(report["traces"]) == 1


@pytest.fixture(scope="module")
def demo(captures, tmp_path_factory):
    """How a demo on those captures is asked for, where it keeps their bundle, and what it reported."""
    folder, labels = captures
    cache = tmp_path_factory.mktemp("cache")
    asked = "demo", "--headless", "--json", "--cache", cache, "--motions", folder, "--labels", labels, "--seconds"
    return asked, cache, json.loads(footwork(*asked, "3").stdout)


def test_demo_steers_over_a_socket(demo):
    _, _, report = demo
    fields = {"frames", "nodes", "edges", "scc_fraction", "ticks", "late_ticks"}
    assert set(report) >= fields | {"tick_us", "command_to_pose_ms", "heading_error_deg"}
    assert report["ticks"] >= 85
    assert report["travelled_m"] > 0.8
    assert 0.0 < report["command_to_pose_ms"]["p50"] < 1000.0


def test_a_damaged_bundle_in_the_cache_is_built_anew(demo):
    asked, cache, _ = demo
    [kept] = cache.glob("*.footwork")
    whole = kept.read_bytes()
    kept.write_bytes(whole[:-7])
    assert "building anew" in footwork(*asked, "0.5").stderr
    assert kept.read_bytes() == whole


def test_a_process_ends_on_bad_input_with_one_line_and_status_two():
    done = footwork("inspect", "/no/such/bundle", status=2)
    assert "/no/such/bundle" in done.stderr
    assert done.stderr.count("\n") == 1
    assert done.stdout == ""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("build", "/no/such/folder", "--out", "x.footwork"), "/no/such/folder"),
        (("build", "embedded:dancing", "--out", "x.footwork"), "there are locomotion, fighting"),
        (("build", "embedded:locomotion", "--out", "/no/such/folder/x.footwork"), "--out: no folder"),
        (("build", "embedded:locomotion", "--out", "/tmp"), "--out: /tmp is a folder"),
        (("build", "embedded:locomotion", "--out", "x.footwork", "--graph", "round"), "expected one of standard"),
        (("build", "embedded:locomotion", "--out", "x.footwork", "--threshold", "nan"), "expected a positive number"),
        (("build", "embedded:locomotion", "--out", "x.footwork", "--discount", "1"), "expected 0 <= discount < 1"),
        (("build", "embedded:locomotion", "--out", "x.footwork", "--backend", "grid"), "there is threads, dask"),
        (("build", "embedded:locomotion", "--out", "x.footwork", "--backend", "dask"), "--scheduler: not given"),
        (("build", "embedded:locomotion", "--out", "x.footwork", "--scheduler", "tcp://h:1"), "--scheduler: threads"),
        (("build", "embedded:locomotion"), "--out"),
        (("inspect", "/no/such/bundle"), "/no/such/bundle"),
        (("inspect", "folder", "--bvh-unit", "-0.01"), "--bvh-unit: -0.01 metres, expected a positive number"),
        (("inspect", "embedded:locomotion", "--bvh-unit", "1"), "embedded motions are not read from files"),
        (("serve", "/no/such/bundle"), "/no/such/bundle"),
        (("score", "/no/such/bundle", "--traces", "/no/such/traces"), "/no/such"),
        (("demo", "--seconds", "-1"), "--seconds"),
        (("jump",), "jump"),
    ],
)
def test_bad_input_is_one_line_and_status_two(refused, arguments, message):
    said = refused(*arguments)
    assert message in said
    assert said.count("\n") == 1


def test_a_threshold_that_connects_nothing_is_answered_with_one_that_would(refused, captures, tmp_path):
    folder, labels = captures
    out = tmp_path / "x.footwork"
    assert "a threshold of" in refused("build", folder, "--labels", labels, "--out", out, "--threshold", "1e-9")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("seconds", ["-3", "nan", "0"])
def test_serve_refuses_a_time_that_never_ends_or_never_begins(refused, bundle, seconds):
    assert "expected more than 0" in refused("serve", bundle[0], "--seconds", seconds)


@pytest.mark.parametrize("rate", ["0", "50"])
def test_serve_refuses_a_rate_it_cannot_keep(refused, bundle, rate):
    assert "expected one of (30, 60, 120)" in refused("serve", bundle[0], "--rate", rate)


def test_serve_refuses_an_address_that_cannot_be_bound(refused, bundle):
    assert "tcp://nowhere" in refused("serve", bundle[0], "--bind", "tcp://nowhere")


def test_a_truncated_capture_names_file_and_line(refused, captures, tmp_path):
    folder, _ = captures
    text = (folder / "idle.bvh").read_text()
    (tmp_path / "idle.bvh").write_text(text[: len(text) // 2])
    assert "idle.bvh:" in refused("build", tmp_path, "--out", tmp_path / "x.footwork")


def test_a_clip_shorter_than_the_window_is_named(refused, tmp_path):
    body = default_body()
    clip = next(clip for clip in embedded_clips() if clip.name == "idle").cut(0, 5)
    write_bvh(tmp_path / "short.bvh", Clip(clip.name, body, clip.fps, clip.root_position, clip.rotations))
    said = refused("build", tmp_path, "--out", tmp_path / "x.footwork")
    assert "short.bvh" in said
    assert "window" in said
