"""footwork export: clips, walks and recordings, as other tools will read them."""

import json
from pathlib import Path

import numpy as np
import pytest

from footwork.cli.main import main
from footwork.motion.bundle import write_bundle
from footwork.motion.bvh import read_bvh
from footwork.motion.clip import Clip
from footwork.motion.glb_reader import read_glb
from footwork.motion.kinematics import clip_places, forward
from footwork.runtime.recording import read_recording
from footwork.runtime.replay import start_recording
from footwork.runtime.simulation import Simulation
from footwork.study.graph_clips import clips_of_graph
from footwork.study.graph_paths import best_path_through, path_clip
from footwork.study.recorded_motion import recorded_motion
from footwork.study.shown_path import places_called, shown_walk
from toy_bundle import FRAMES, lively_bundle

BUNDLE = lively_bundle()
NAMES = BUNDLE.graph.skeleton.names


def places(clip: Clip) -> np.ndarray:
    return clip_places(clip)[0][:, clip.skeleton.indices(NAMES)]


def played(path: Path) -> list[np.ndarray]:
    """Record two characters, the second of them late and gone before a third takes its slot; their places as shown."""
    simulation = Simulation(BUNDLE, 2)
    recorder = start_recording(simulation, path, rate=60)
    shown: dict[str, list[np.ndarray]] = {"first": [], "second": [], "third": []}
    simulation.spawn(0.0, 0.0, 0.0)
    for tick in range(90):
        if tick in (20, 60):
            simulation.spawn(2.0, 1.0, 1.0, "walk")
        if tick == 50:
            simulation.remove(1)
        simulation.give(0, simulation.vocabulary.outright(0.1 * tick, "walk"))
        for poses in simulation.play(1, 2)[0]:
            who = ["first"] + (["second"] * (20 <= tick < 50) or ["third"] * (tick >= 60))
            for name, pose in zip(who, poses, strict=True):
                shown[name].append(forward(BUNDLE.graph.skeleton, pose[:3], pose[3:].reshape(-1, 4))[0])
    simulation.end_recording()
    recorder.wait()
    return [np.array(frames) for frames in shown.values()]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("export")
    write_bundle(folder / "toy.footwork", BUNDLE)
    return folder


def export(capsys: pytest.CaptureFixture, *arguments: object) -> dict:
    capsys.readouterr()
    assert main(["export", *map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_all_clips_of_a_bundle_are_animations_of_one_file(folder: Path, tmp_path: Path, capsys):
    report = export(capsys, folder / "toy.footwork", "--out", tmp_path / "a.glb")
    clips, back = clips_of_graph(BUNDLE.graph), read_glb(tmp_path / "a.glb")
    assert [take["name"] for take in report["takes"]] == [clip.name for clip in clips]
    assert report["attribution"] == ["toy motion, nobody's"]
    assert b"toy motion, nobody's" in (tmp_path / "a.glb").read_bytes()
    for clip, other in zip(clips, back, strict=True):
        np.testing.assert_allclose(places(other), places(clip), atol=1e-3)


def test_every_character_of_a_recording_is_there_as_it_was_shown(folder: Path, tmp_path: Path, capsys):
    shown = played(tmp_path / "x.footrec")
    glb = tmp_path / "x.glb"
    report = export(capsys, tmp_path / "x.footrec", "--bundle", folder / "toy.footwork", "--out", glb)
    assert [(take["characters"], take["fps"]) for take in report["takes"]] == [(3, 60.0)]
    for clip, frames in zip(read_glb(glb), shown, strict=True):
        assert clip.fps == 60.0
        np.testing.assert_allclose(places(clip), frames, atol=1e-3)
    parts = recorded_motion(read_recording(tmp_path / "x.footrec"), BUNDLE)
    assert [part.start for part in parts] == pytest.approx([0.0, 20 / 30, 2.0])


def test_bvh_files_of_several_clips_come_into_a_folder(folder: Path, tmp_path: Path, capsys):
    report = export(capsys, folder / "toy.footwork", "--out", tmp_path / "all", "--format", "bvh", "--fps", 60)
    assert len(report["files"]) == 3
    for file, clip in zip(report["files"], clips_of_graph(BUNDLE.graph), strict=True):
        back = read_bvh(file)
        assert (back.fps, back.frame_count) == (60.0, 2 * FRAMES - 1)
        np.testing.assert_allclose(places(back)[::2], places(clip), atol=1e-3)


def test_one_clip_is_one_file(folder: Path, tmp_path: Path, capsys):
    name = BUNDLE.graph.clips[1]
    report = export(capsys, folder / "toy.footwork", "--clip", name, "--out", tmp_path / "a.bvh")
    assert report["files"] == [str(tmp_path / "a.bvh")]
    np.testing.assert_allclose(places(read_bvh(tmp_path / "a.bvh")), places(clips_of_graph(BUNDLE.graph)[1]), atol=1e-3)


def test_a_walk_along_a_path_is_smooth_where_the_frames_themselves_leap(folder: Path, tmp_path: Path, capsys):
    report = export(capsys, folder / "toy.footwork", "--path", "3", "60", "--out", tmp_path / "a.glb")
    assert report["takes"][0]["name"] == "3 to 60"
    graph = BUNDLE.graph
    frames = path_clip(graph, best_path_through(graph, [3, 60]))
    (shown,) = read_glb(tmp_path / "a.glb")
    leaps = [np.abs(np.diff(places(clip)[: frames.frame_count], n=2, axis=0)).max() for clip in (shown, frames)]
    assert leaps[0] < 0.5 * leaps[1]


def test_places_are_numbers_labels_or_behaviours():
    graph = BUNDLE.graph
    assert places_called(graph, "7").tolist() == [7]
    assert {graph.behaviours[graph.behaviour[node]] for node in places_called(graph, "jump")} == {"jump"}
    assert shown_walk(graph, "walk", "walk").frame_count > 1


REFUSED = {
    "unknown clip": (("--clip", "nobody"), "no clip 'nobody', it has"),
    "unknown place": (("--path", "stop", "fly"), "no place 'fly', expected a node's number or one of"),
    "node that is not there": (("--path", "0", "99999"), "node 99999, expected 0 to 71"),
    "two ways": (("--path", "0", "1", "--clip", "x"), "expected one of --clip and --path"),
    "bundle for a bundle": (("--bundle", "x.footwork"), "is for recordings"),
    "rate of nothing": (("--fps", "0"), "0.0 frames a second, expected a positive number"),
    "rate beyond all use": (("--fps", "1e9"), "more than 1000000 frames"),
}


@pytest.mark.parametrize(("options", "said"), REFUSED.values(), ids=REFUSED.keys())
def test_what_cannot_be_exported_is_one_line(folder: Path, tmp_path: Path, capsys, options, said: str):
    assert main(["export", str(folder / "toy.footwork"), "--out", str(tmp_path / "a.glb"), *options]) == 2
    err = capsys.readouterr().err
    assert said in err
    assert err.count("\n") == 1
    assert not (tmp_path / "a.glb").exists()


def test_a_format_that_nothing_says_and_a_recording_without_its_bundle_are_refused(folder, tmp_path: Path, capsys):
    played(tmp_path / "x.footrec")
    for arguments, said in (
        ((folder / "toy.footwork", "--out", tmp_path / "a.fbx"), "'.fbx' says no format, expected .glb or .bvh"),
        ((tmp_path / "x.footrec", "--out", tmp_path / "a.glb"), "--bundle: a recording holds no motion itself"),
        ((tmp_path / "none", "--out", tmp_path / "a.glb"), "No such file"),
        ((folder / "toy.footwork", "--out", tmp_path / "no" / "a.glb"), "cannot be written"),
    ):
        assert main(["export", *map(str, arguments)]) == 2
        assert said in capsys.readouterr().err
