"""A folder of GLB files as motion to train on: one clip or several a file, labelled and cut like other formats."""

from pathlib import Path

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.bvh import write_bvh
from footwork.motion.capture import read_capture
from footwork.motion.glb_writer import take_of, write_glb
from footwork.motion.kinematics import clip_places
from footwork.training.dataset import load_clips
from footwork.training.embedded import embedded_clips
from motion_samples import sample_clip


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A file of one clip and a file of two."""
    motions = tmp_path / "motions"
    motions.mkdir()
    write_glb(motions / "one.glb", [take_of(sample_clip(0, 40))])
    write_glb(motions / "two.GLB", [take_of(sample_clip(seed, 40)) for seed in (1, 2)])
    return motions


def table(folder: Path, *rows: str) -> Path:
    path = folder.parent / "table.csv"
    path.write_text("\n".join(["file,start_frame,end_frame,label", *rows]))
    return path


def test_every_animation_is_a_clip_and_can_be_labelled(folder: Path):
    labels = table(folder, "one.glb,0,10,walk", "two.GLB#sample2,0,40,run")
    data = load_clips(folder, labels=labels)
    assert [clip.name for clip in data.clips] == ["one.glb", "two.GLB#sample1", "two.GLB#sample2"]
    assert [set(clip.labels) for clip in data.clips] == [{"walk", ""}, {""}, {"run"}]
    assert [entry["clip"] for entry in data.files] == [clip.name for clip in data.clips]
    assert data.files[1]["sha256"] == data.files[2]["sha256"]


def test_parts_of_one_animation_leave_the_others_out(folder: Path):
    data = load_clips(folder, ranges=table(folder, "two.GLB#sample2,5,20,x", "two.GLB#sample2,25,30,x"))
    assert [clip.name for clip in data.clips] == ["two.GLB#sample2[5:20]", "two.GLB#sample2[25:30]"]


def test_the_same_motion_as_bvh_and_as_glb_becomes_the_same_clip(folder: Path, tmp_path: Path):
    (tmp_path / "bvh").mkdir()
    write_bvh(tmp_path / "bvh" / "one.bvh", sample_clip(0, 40))
    (folder / "two.GLB").unlink()
    ours, theirs = load_clips(folder).clips[0], load_clips(tmp_path / "bvh").clips[0]
    np.testing.assert_allclose(clip_places(ours)[0], clip_places(theirs)[0], atol=1e-3)


def test_motion_that_a_graph_was_made_of_comes_back_from_a_file(tmp_path: Path):
    clips = [clip for clip in embedded_clips() if clip.name in ("walk_normal", "jump", "curve_tight_left")]
    write_glb(tmp_path / "all.glb", [take_of(clip) for clip in clips])
    for clip, again in zip(clips, load_clips(tmp_path).clips, strict=True):
        assert again.name == f"all.glb#{clip.name}"
        np.testing.assert_allclose(clip_places(again)[0], clip_places(clip)[0], atol=1e-3)


def test_rows_for_what_a_file_does_not_hold_are_refused(folder: Path):
    for row, said in (
        ("two.GLB,0,9,x", r"table.csv:2: names two.GLB, but two.GLB holds two.GLB#sample1, two.GLB#sample2"),
        ("two.GLB#sample9,0,9,x", "names two.GLB#sample9, but"),
        ("three.glb#x,0,9,x", "no row for the files of"),
    ):
        with pytest.raises(InputError, match=said):
            load_clips(folder, labels=table(folder, row))
    with pytest.raises(InputError, match="holds 2 clips, expected one"):
        read_capture(folder / "two.GLB")
