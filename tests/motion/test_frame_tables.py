from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.errors import InputError
from footwork.motion.frame_tables import frame_labels, read_labels, read_ranges, rows_of_file, rows_of_set
from shared_data import MOTIONS, needs_motions

LABELS = """set,file,start_frame,end_frame,label
walks,b.bvh,3,5,idle
walks,b.bvh,0,3,walk

others,b.bvh,0,9,jump
"""


def table(folder: Path, text: str) -> Path:
    path = folder / "labels.csv"
    path.write_bytes(text.encode())
    return path


def test_rows_of_a_folder_and_file_come_by_start(tmp_path: Path):
    rows = rows_of_file(rows_of_set(read_labels(table(tmp_path, LABELS)), "walks"), "b.bvh")
    assert [(row.start, row.end, row.label) for row in rows] == [(0, 3, "walk"), (3, 5, "idle")]
    assert rows[1].where.endswith("labels.csv:2")


def test_frames_without_a_row_are_unlabelled(tmp_path: Path):
    rows = rows_of_set(read_labels(table(tmp_path, LABELS)), "walks")
    assert frame_labels(rows, 6).tolist() == ["walk", "walk", "walk", "idle", "idle", ""]
    assert frame_labels([], 2).tolist() == ["", ""]


def test_set_column_may_be_left_out(tmp_path: Path):
    path = table(tmp_path, "end_frame,file,start_frame,note\r\n20,a.amc,10,long walk\r\n")
    (row,) = rows_of_set(read_ranges(path), "anything")
    assert (row.file, row.start, row.end, row.label) == ("a.amc", 10, 20, "")


def test_label_past_the_end_is_refused_with_its_line(tmp_path: Path):
    rows = rows_of_set(read_labels(table(tmp_path, LABELS)), "walks")
    with pytest.raises(InputError, match=r"labels.csv:2: frames 3..5 of b.bvh, which has 4"):
        frame_labels(rows, 4)


BAD = {
    "missing column": ("label\n", "lable\n", "labels.csv:1: no column label"),
    "reversed": (",3,5,", ",5,3,", "labels.csv:2: frames 5..3"),
    "empty range": (",3,5,", ",3,3,", "labels.csv:2"),
    "negative": (",3,5,", ",-3,5,", "labels.csv:2"),
    "fraction": (",3,5,", ",3.5,5,", "labels.csv:2"),
    "not a number": (",3,5,", ",three,5,", "labels.csv:2"),
    "NaN": (",3,5,", ",nan,5,", "labels.csv:2"),
    "infinite": (",3,5,", ",3,1e999,", "labels.csv:2"),
    "overlapping": (",3,5,", ",2,5,", "labels.csv:2: frames 2..5 of b.bvh overlap 0..3"),
    "cell missing": (",idle", "", "labels.csv:2: 4 cells"),
    "cell too many": ("idle", "idle,x", "labels.csv:2: 6 cells"),
    "no file": ("walks,b.bvh,3", "walks,,3", "labels.csv:2: file is empty"),
    "no label": ("idle", "", "labels.csv:2: label is empty"),
    "quote left open": ("idle", '"idle', "labels.csv:"),
    "long label": ("idle", "i" * 65, "labels.csv:2: a label of 65"),
    "control character": ("idle", "id\0le", "labels.csv:2: a control character"),
    "column twice": ("set,file", "file,file", "labels.csv:1: column file is there twice"),
}


@pytest.mark.parametrize(("old", "new", "said"), BAD.values(), ids=BAD.keys())
def test_bad_table_is_refused_with_its_line(tmp_path: Path, old: str, new: str, said: str):
    with pytest.raises(InputError, match=said):
        read_labels(table(tmp_path, LABELS.replace(old, new, 1)))


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16"])
def test_text_that_is_not_utf_8_is_refused(tmp_path: Path, encoding: str):
    path = tmp_path / "labels.csv"
    path.write_bytes(LABELS.replace("idle", "arrêt").encode(encoding))
    with pytest.raises(InputError, match=r"labels.csv:\d: not UTF-8 text"):
        read_labels(path)


def test_letters_of_any_language_are_kept(tmp_path: Path):
    rows = read_labels(table(tmp_path, LABELS.replace("idle", '"arrêt, 停"')))
    assert rows[0].label == "arrêt, 停"


def test_a_row_for_any_folder_may_not_overlap_one_for_this_folder(tmp_path: Path):
    rows = read_labels(table(tmp_path, LABELS + ",b.bvh,4,9,run\n"))
    assert len(rows_of_set(rows, "elsewhere")) == 1
    with pytest.raises(InputError, match=r"labels.csv:6: frames 4..9 of b.bvh overlap 3..5"):
        rows_of_set(rows, "walks")


@pytest.mark.parametrize("text", ["", "\n", ",,\n", "file,start_frame,end_frame,label"])
def test_table_without_rows_has_none_or_is_refused(tmp_path: Path, text: str):
    path = table(tmp_path, text)
    if "label" in text:
        assert read_labels(path) == ()
    else:
        with pytest.raises(InputError, match=r"labels\.csv"):
            read_labels(path)


@given(st.integers(0, len(LABELS)), st.integers(0, 8), st.binary(max_size=8))
@settings(max_examples=150, deadline=None)
def test_mutated_table_gives_rows_or_an_input_error(
    tmp_path_factory: pytest.TempPathFactory, place: int, removed: int, added: bytes
):
    path = tmp_path_factory.getbasetemp() / "mutated.csv"
    path.write_bytes(LABELS.encode()[:place] + added + LABELS.encode()[place + removed :])
    try:
        rows = read_labels(path)
    except InputError:
        return
    assert all(0 <= row.start < row.end for row in rows)


@needs_motions
def test_tables_of_the_capture_are_read_whole():
    assert len(read_labels(MOTIONS / "labels.csv")) == len((MOTIONS / "labels.csv").read_text().split()) - 1
    ranges = rows_of_set(read_ranges(MOTIONS / "core_ranges.csv"), "dataset3")
    assert sum(row.end - row.start for row in ranges) == 2721
