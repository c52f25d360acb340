"""Tables of frame ranges: which parts of the files to use, and what the body does in them.

CSV with a header line and the columns ``set`` (may be left out), ``file``, ``start_frame``, ``end_frame`` and, for
labels, ``label``. Ranges are half-open and count the frames of the source file from 0. ``set`` is the name of the
folder that the files lie in.
"""

import csv
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import UNLABELLED
from footwork.motion.textfile import read_lines, whole_number

RANGE_COLUMNS = ("file", "start_frame", "end_frame")
LABEL_COLUMNS = (*RANGE_COLUMNS, "label")
MAX_LABEL = 64
_CONTROL = {chr(code) for code in range(32)} - {"\t"}


@dataclass(frozen=True)
class FrameRange:
    """Frames start..end-1 of a source file.

    Args:
        set_name: name of the folder the file lies in, empty for any.
        file: name of the file.
        start: first frame.
        end: one past the last frame.
        label: what the body does, empty in a table of ranges.
        where: table and line, for messages.
    """

    set_name: str
    file: str
    start: int
    end: int
    label: str
    where: str


def read_ranges(path: str | Path) -> tuple[FrameRange, ...]:
    """The rows of a table of ranges.

    Raises:
        InputError: naming the line, for text that is not UTF-8, columns that are missing or there twice, numbers
            that are no frames, and reversed, empty or overlapping ranges.
    """
    return _read(path, RANGE_COLUMNS)


def read_labels(path: str | Path) -> tuple[FrameRange, ...]:
    """The rows of a table of labels.

    Raises:
        InputError: as ``read_ranges`` does, and for a row without a label.
    """
    return _read(path, LABEL_COLUMNS)


def rows_of_set(rows: Iterable[FrameRange], set_name: str) -> list[FrameRange]:
    """The rows for the files of one folder.

    Raises:
        InputError: for rows that overlap, one of them for this folder and one for any.
    """
    own = [row for row in rows if row.set_name in ("", set_name)]
    _require_apart(own)
    return own


def rows_of_file(rows: Iterable[FrameRange], file: str) -> list[FrameRange]:
    """The rows for one file, by start."""
    return sorted((row for row in rows if row.file == file), key=lambda row: row.start)


def require_inside(rows: Iterable[FrameRange], frames: int) -> None:
    """Raise InputError, naming the row, if one reaches past the ``frames`` frames of its file."""
    for row in rows:
        if row.end > frames:
            raise InputError(f"frames {row.start}..{row.end} of {row.file}, which has {frames}", row.where)


def frame_labels(rows: Sequence[FrameRange], frames: int) -> NDArray[np.str_]:
    """The label of each frame of a file, empty where no row covers it.  # (frames,) str

    Args:
        rows: the rows for that file.
        frames: how many frames it has.

    Raises:
        InputError: for a row that reaches past the end.
    """
    require_inside(rows, frames)
    width = max((len(row.label) for row in rows), default=1)
    labels = np.full(frames, UNLABELLED, dtype=f"<U{width}")
    for row in rows:
        labels[row.start : row.end] = row.label
    return labels


def _read(path: str | Path, columns: tuple[str, ...]) -> tuple[FrameRange, ...]:
    table = csv_rows(path)
    line, header = next(table, (1, []))
    missing = [name for name in columns if name not in header]
    if missing:
        raise InputError(f"no column {', '.join(missing)}; expected {', '.join(columns)}", f"{path}:{line}")
    twice = [name for name in columns if header.count(name) > 1]
    if twice:
        raise InputError(f"column {twice[0]} is there twice", f"{path}:{line}")
    rows = tuple(_frame_range(header, values, columns, f"{path}:{line}") for line, values in table)
    for set_name in {row.set_name for row in rows}:
        _require_apart([row for row in rows if row.set_name == set_name])
    return rows


def csv_rows(path: str | Path) -> Iterator[tuple[int, list[str]]]:
    """Line number and cells of each row that is not blank; the file is known to have one."""
    reader = csv.reader(_texts(path), strict=True)
    try:
        for row in reader:
            if any(row):
                yield reader.line_num, [cell.strip() for cell in row]
    except csv.Error as error:
        raise InputError(f"not comma-separated values ({error})", f"{path}:{reader.line_num}") from None


def _texts(path: str | Path) -> Iterator[str]:
    """The lines of the file, without control characters but for tabs."""
    for number, line in enumerate(read_lines(path), start=1):
        try:
            text = line.decode("utf-8")
        except UnicodeDecodeError:
            raise InputError("not UTF-8 text, expected comma-separated values in UTF-8", f"{path}:{number}") from None
        if not _CONTROL.isdisjoint(text):
            raise InputError("a control character, expected comma-separated values", f"{path}:{number}")
        yield text


def _frame_range(header: list[str], values: list[str], columns: tuple[str, ...], where: str) -> FrameRange:
    if len(values) != len(header):
        raise InputError(f"{len(values)} cells, but the header has {len(header)}", where)
    cells = dict(zip(header, values, strict=True))
    empty = [name for name in columns if not cells[name]]
    if empty:
        raise InputError(f"{empty[0]} is empty", where)
    start, end = (whole_number(cells[name], where) for name in ("start_frame", "end_frame"))
    if start >= end:
        raise InputError(f"frames {start}..{end}, expected start_frame < end_frame", where)
    label = cells.get("label", UNLABELLED)
    if len(label) > MAX_LABEL:
        raise InputError(f"a label of {len(label)} letters, expected {MAX_LABEL} at most", where)
    return FrameRange(cells.get("set", ""), cells["file"], start, end, label, where)


def _require_apart(rows: Sequence[FrameRange]) -> None:
    """Raise InputError if two rows for one file of one folder overlap."""
    ordered = sorted(rows, key=lambda row: (row.file, row.start))
    for one, two in pairwise(ordered):
        if one.file == two.file and two.start < one.end:
            raise InputError(
                f"frames {two.start}..{two.end} of {two.file} overlap {one.start}..{one.end} of {one.where}", two.where
            )
