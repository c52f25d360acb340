import hashlib
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import footwork.motion
from footwork.errors import InputError
from footwork.motion.bvh import read_bvh, write_bvh
from footwork.motion.name_table import table_for
from footwork.motion.resample import resample
from footwork.motion.retarget import common_body_of, onto_common_body
from footwork.training.dataset import load_clips
from motion_samples import sample_clip
from shared_data import MOTIONS, needs_motions

LABELS = """set,file,start_frame,end_frame,label
walks,a.bvh,0,20,walk
walks,a.bvh,20,60,run
elsewhere,b.bvh,0,9999,jump
"""
TABLES = Path(footwork.motion.__file__).parent / "skeletons"


@pytest.fixture
def walks(tmp_path: Path) -> Path:
    """A folder with two clips of 60 frames at 30 Hz and one of 97 at 120 Hz."""
    folder = tmp_path / "walks"
    folder.mkdir()
    write_bvh(folder / "b.bvh", sample_clip(0, 60))
    write_bvh(folder / "a.bvh", sample_clip(1, 60))
    write_bvh(folder / "fast.BVH", resample(sample_clip(2, 25), 120.0))
    (folder / "notes.txt").write_text("not motion")
    (folder / "._a.bvh").write_text("not motion either")
    return folder


def table(folder: Path, text: str) -> Path:
    path = folder / "table.csv"
    path.write_text(text)
    return path


def test_files_come_by_name_on_one_body_at_30_frames_a_second(walks: Path):
    data = load_clips(walks)
    assert [clip.name for clip in data.clips] == ["a.bvh", "b.bvh", "fast.BVH"]
    assert [clip.frame_count for clip in data.clips] == [60, 60, 25]
    assert {clip.fps for clip in data.clips} == {30.0}
    assert all(clip.skeleton is data.clips[0].skeleton for clip in data.clips)
    assert all((clip.labels == "").all() for clip in data.clips)
    assert data.attribution == ()


def test_files_are_told_with_their_digests(walks: Path):
    entry = load_clips(walks).files[2]
    assert entry["sha256"] == hashlib.sha256((walks / "fast.BVH").read_bytes()).hexdigest()
    assert (entry["file"], entry["start_frame"], entry["end_frame"], entry["source_fps"]) == ("fast.BVH", 0, 97, 120.0)


def test_labels_of_other_folders_are_left_out(walks: Path):
    data = load_clips(walks, labels=table(walks, LABELS))
    assert data.clips[0].labels.tolist() == ["walk"] * 20 + ["run"] * 40
    assert (data.clips[1].labels == "").all()


def test_parts_are_cut_from_the_mapping_of_the_whole_file(walks: Path):
    ranges = table(walks.parent, "file,start_frame,end_frame\na.bvh,30,50\na.bvh,5,20\n")
    data = load_clips(walks, ranges=ranges, labels=table(walks, LABELS))
    source = read_bvh(walks / "a.bvh")
    whole = onto_common_body(source, common_body_of([source]), table_for(source.skeleton))
    assert [clip.name for clip in data.clips] == ["a.bvh[5:20]", "a.bvh[30:50]"]
    assert [(entry["start_frame"], entry["end_frame"]) for entry in data.files] == [(5, 20), (30, 50)]
    np.testing.assert_array_equal(data.clips[1].rotations, whole.rotations[30:50])
    np.testing.assert_array_equal(data.clips[1].contacts, whole.contacts[30:50])
    assert data.clips[0].labels.tolist() == ["walk"] * 15


@pytest.mark.parametrize(("start", "end", "frames"), [(0, 97, 25), (5, 46, 11), (6, 46, 10), (7, 8, 1), (90, 97, 2)])
def test_part_of_a_faster_file_starts_at_its_first_frame(walks: Path, start: int, end: int, frames: int):
    ranges = table(walks.parent, f"file,start_frame,end_frame\nfast.BVH,{start},{end}\n")
    rows = "".join(f"fast.BVH,{frame},{frame + 1},frame {frame}\n" for frame in range(97))
    part = load_clips(walks, ranges=ranges, labels=table(walks, f"file,start_frame,end_frame,label\n{rows}")).clips[0]
    source = read_bvh(walks / "fast.BVH")
    kept = range(start, end, 4)
    assert part.frame_count == frames
    assert part.labels.tolist() == [f"frame {frame}" for frame in kept]
    elbow = Rotation.from_quat(source.rotations[kept, source.skeleton.index("left_forearm")])
    mapped = Rotation.from_quat(part.rotations[:, part.skeleton.index("left_forearm")])
    assert (elbow.inv() * mapped).magnitude().max() < 2e-3


def test_own_name_table_brings_its_own_attribution(walks: Path):
    text = (TABLES / "common.toml").read_text()
    lines = [line for line in text.splitlines() if not line.startswith(("name =", "attribution ="))]
    own = walks / "own.toml"
    own.write_text("\n".join(['name = "studio"', 'attribution = "Danced by Ann."', *lines]))
    data = load_clips(walks, tables=[own])
    assert data.attribution == ("Danced by Ann.",)
    assert data.files[0]["name_table"] == "studio"


BAD = {
    "range of a file not there": ("ranges", "a.bvh,0,9\nc.bvh,0,9", r"table.csv:3: names c.bvh"),
    "range past the end": ("ranges", "a.bvh,0,61", r"table.csv:2: frames 0..61 of a.bvh, which has 60"),
    "label past the end": ("labels", "a.bvh,0,61,walk", r"table.csv:2: frames 0..61 of a.bvh, which has 60"),
    "nothing for this folder": ("ranges", "c.bvh,0,9", r"table.csv: no row for the files of"),
}


@pytest.mark.parametrize(("option", "rows", "said"), BAD.values(), ids=BAD.keys())
def test_tables_that_do_not_fit_are_refused(walks: Path, option: str, rows: str, said: str):
    header = "file,start_frame,end_frame" + (",label" if option == "labels" else "")
    path = table(walks, f"{header}\n{rows}\n")
    with pytest.raises(InputError, match=said):
        load_clips(walks, **{option: path})  # type: ignore[arg-type]


def test_empty_and_missing_folders_are_refused(tmp_path: Path):
    with pytest.raises(InputError, match="has no motion files"):
        load_clips(tmp_path)
    with pytest.raises(InputError, match="expected a folder"):
        load_clips(tmp_path / "none")


def test_lengths_in_another_unit_are_noticed(walks: Path):
    with pytest.raises(InputError, match="another unit"):
        load_clips(walks, bvh_unit=1.0)


@needs_motions
def test_core_ranges_of_real_capture_are_whole_and_labelled():
    data = load_clips(MOTIONS / "dataset3", labels=MOTIONS / "labels.csv", ranges=MOTIONS / "core_ranges.csv")
    assert sum(clip.frame_count for clip in data.clips) == 2721
    assert all((clip.labels != "").all() for clip in data.clips)
    assert {label for clip in data.clips for label in clip.labels} >= {"walk", "idle", "run", "turn", "jump", "duck"}
    assert data.attribution[0].startswith("Motion capture: Open Motion Project by ACCAD")


@needs_motions
def test_capture_of_both_sources_shares_a_body_and_carries_both_attributions():
    data = load_clips(MOTIONS / "reactions", labels=MOTIONS / "labels.csv")
    assert len({clip.skeleton for clip in data.clips}) == 1
    assert len(data.attribution) == 2
    assert all((clip.labels != "").all() for clip in data.clips)
