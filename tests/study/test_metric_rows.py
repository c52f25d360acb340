"""The rows of the paper on metrics: made of a folder of one's own, of real capture, and without their motions."""

import json

import pytest

from footwork.motion.bvh import write_bvh
from footwork.study.reproduction import matsunaga_zordan, registry
from footwork.study.reproduction.run import reproduce
from footwork.training.embedded import embedded_clips
from reproduction_motions import write_motion_sets
from shared_data import MOTIONS, needs_motions

EVERY_ROW = ["M-D", "M-F3", "M-U", "M-F4", "M-T1", "M-F5a,b", "M-P"]


@pytest.fixture(scope="module")
def motions(tmp_path_factory):
    folder = write_motion_sets(tmp_path_factory.mktemp("motions"))
    clips = {clip.name: clip for clip in embedded_clips()}
    for name, files in {"fighting": ["walk_paces"], "reactions": ["walk_duck", "walk_leap"]}.items():
        (folder / name).mkdir()
        for file in files:
            write_bvh(folder / name / f"{file}.bvh", clips[file])
        labels = "".join(f"{name},{file}.bvh,0,10,walk\n" for file in files)
        (folder / "labels.csv").write_text((folder / "labels.csv").read_text() + labels)
    ranges = (folder / "core_ranges.csv").read_text() + "fighting,walk_paces.bvh,0,160\n"
    (folder / "core_ranges.csv").write_text(ranges)
    return folder


def test_every_row_of_the_paper_is_there_in_order():
    assert [row.name for row in registry.all_rows() if row.paper.letter == "M"] == EVERY_ROW


def test_the_published_numbers_say_what_the_paper_claims():
    for table in (matsunaga_zordan.START_TO_END, matsunaga_zordan.ARC_LENGTH):
        assert all(of["dynamics"] < min(of["H1"], of["H2"]) for of in table.values())
    for name, of in matsunaga_zordan.START_TO_END.items():
        assert all(matsunaga_zordan.ARC_LENGTH[name][metric] > length for metric, length in of.items())


def test_a_run_makes_every_row_of_a_folder_of_ones_own(motions, tmp_path):
    report = reproduce(motions, tmp_path, only=["M"], quick=True)
    assert [made["name"] for made in report["rows"]] == EVERY_ROW
    assert [made["error"] for made in report["rows"]] == [None] * len(EVERY_ROW)
    assert all(made["judgements"] and made["tables"] for made in report["rows"])
    assert json.loads((tmp_path / "reproduction.json").read_text()) == report


def test_without_motions_for_them_rows_cannot_be_judged(tmp_path):
    motions = write_motion_sets(tmp_path / "motions")
    report = reproduce(motions, tmp_path / "out", only=["M"], quick=True)
    assert [made["error"] for made in report["rows"]] == [None] * len(EVERY_ROW)
    assert {made["verdict"] for made in report["rows"]} == {"cannot be judged"}


@needs_motions
def test_on_real_fighting_the_dynamics_metric_skates_less_and_picks_active_frames(tmp_path):
    report = reproduce(MOTIONS, tmp_path, only=["M-U", "M-T1", "M-P"], quick=True)
    unique, skate, activity = (made["ours"] for made in report["rows"])
    for name in ("fighting, one sequence", "reactions"):
        gain = skate[name]["gain_of_dynamics"]["uniform"]["arc length"]
        assert gain["high"] < -0.3
        of = skate[name]["equal_numbers"]["dynamics"]["arc length"]
        assert of["blend"]["value"] > of["sources"]["value"] > 0.5
        assert unique[name]["as many as the paper"]["neither"] > 10
    assert activity["fighting, one sequence"]["picks"]["dynamics"]["low"] > activity["fighting, one sequence"]["mean"]
