"""From a folder of motion capture to clips on the common body at 30 Hz, with contacts, labels and their origin."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from footwork.errors import InputError
from footwork.motion.bvh import CENTIMETRE
from footwork.motion.capture import EXTENSIONS, file_of, read_motions, skeleton_of
from footwork.motion.clip import Clip
from footwork.motion.floor_plane import Floor
from footwork.motion.frame_tables import (
    FrameRange,
    frame_labels,
    read_labels,
    read_ranges,
    require_inside,
    rows_of_file,
    rows_of_set,
)
from footwork.motion.name_table import NameTable, read_name_table, table_for
from footwork.motion.resample import COMMON_RATE, resample, whole_steps
from footwork.motion.retarget import common_body_of, floors_of, onto_common_body
from footwork.motion.skeleton import Skeleton

# From the root to the furthest tip a person measures about 1.2 m; outside these the unit must be wrong.
SMALLEST, LARGEST = 0.3, 5.0  # metres


@dataclass(frozen=True, eq=False)
class Dataset:
    """Motion to train on.

    Args:
        clips: on one common body, at 30 frames a second, with contacts and labels.
        files: where each clip comes from: JSON-able, in the order of the clips.
        attribution: what the licences of the sources ask to have shown, a line each.
    """

    clips: Sequence[Clip]
    files: Sequence[dict[str, Any]]
    attribution: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Source:
    """One clip of a file of the folder as read, with the parts of it to use."""

    path: Path
    clip: Clip
    table: NameTable
    parts: Sequence[tuple[int, int]]


def load_clips(
    directory: str | Path,
    *,
    labels: str | Path | None = None,
    ranges: str | Path | None = None,
    body: Skeleton | None = None,
    tables: Sequence[str | Path] = (),
    bvh_unit: float = CENTIMETRE,
) -> Dataset:
    """Every motion file of a folder, by name, as clips on one common body.

    Files are mapped whole and cut afterwards, so that the contacts of a short part rest on all of its file, and its
    floor on all files used of the same person. Times of a part start at its first source frame. A part's clip is
    called ``FILE[START:END]``.

    Args:
        directory: folder of ``.bvh``, ``.amc`` and ``.glb`` files; folders in it are not looked into. Tables name a
            clip of a GLB file that holds several as ``FILE#ANIMATION``.
        labels: table of labels; frames without one, or all without a table, are unlabelled.
        ranges: table of the parts to use, each a clip; without it every file is used whole.
        body: the common body to map onto; without it the mean of the people in the files used.
        tables: name tables to try before those that come along.
        bvh_unit: metres in one unit of length of the BVH files.

    Raises:
        InputError: for a folder or file that cannot be read or holds no motion, tables that name no file of the
            folder, a file that is not there or frames that it has not, and skeletons that no name table fits or
            that are not of a person's size.
    """
    paths = _motion_files(Path(directory))
    name_tables = tuple(read_name_table(path) for path in tables)
    label_rows = _rows(read_labels(labels), directory, paths, labels) if labels else []
    range_rows = _rows(read_ranges(ranges), directory, paths, ranges) if ranges else None
    if range_rows is not None:
        paths = _named(paths, range_rows)
    sources = [source for path in paths for source in _read(path, label_rows, range_rows, name_tables, bvh_unit)]
    resampled = [resample(source.clip) for source in sources]
    if body is None:
        body = common_body_of(resampled, name_tables)
    floors = floors_of(resampled, body, name_tables)
    attribution = dict.fromkeys(source.table.attribution for source in sources if source.table.attribution)
    return Dataset(
        clips=tuple(
            clip for source, floor in zip(sources, floors, strict=True) for clip in _mapped(source, body, floor)
        ),
        files=tuple(entry for source in sources for entry in _provenance(source)),
        attribution=tuple(attribution),
    )


def _motion_files(folder: Path) -> list[Path]:
    try:
        entries = sorted(folder.iterdir())
    except (OSError, ValueError) as error:
        raise InputError(f"cannot be read ({_why(error)}), expected a folder of motion files", folder) from None
    paths = [path for path in entries if path.suffix.lower() in EXTENSIONS and not path.name.startswith(".")]
    if not paths:
        raise InputError(f"has no motion files, expected some of {', '.join(EXTENSIONS)}", folder)
    return paths


def _why(error: OSError | ValueError) -> str:
    """The reason without the path, which the message names already."""
    return getattr(error, "strerror", None) or str(error)


def _rows(
    rows: Sequence[FrameRange], directory: str | Path, paths: Sequence[Path], table: str | Path
) -> list[FrameRange]:
    """The rows of a table for this folder, at least one of them for a file that is there."""
    set_name = Path(directory).resolve().name
    own = rows_of_set(rows, set_name)
    if not {file_of(row.file) for row in own} & {path.name for path in paths}:
        sets = ", ".join(sorted({row.set_name for row in rows if row.set_name})[:8]) or "none"
        raise InputError(f"no row for the files of {directory} (set {set_name!r}); its sets are {sets}", table)
    return own


def _named(paths: Sequence[Path], rows: Sequence[FrameRange]) -> list[Path]:
    there = {path.name: path for path in paths}
    for row in rows:
        if file_of(row.file) not in there:
            raise InputError(f"names {row.file}, which is not in the folder", row.where)
    return [there[name] for name in sorted({file_of(row.file) for row in rows})]


def _read(
    path: Path,
    labels: Sequence[FrameRange],
    ranges: Sequence[FrameRange] | None,
    tables: Sequence[NameTable],
    bvh_unit: float,
) -> list[_Source]:
    clips = read_motions(path, bvh_unit)
    _require_there([*labels, *(ranges or ())], path, clips)
    return [
        _source(path, clip, labels, ranges, tables)
        for clip in clips
        if ranges is None or rows_of_file(ranges, clip.name)
    ]


def _require_there(rows: Sequence[FrameRange], path: Path, clips: Sequence[Clip]) -> None:
    names = [clip.name for clip in clips]
    for row in rows:
        if file_of(row.file) == path.name and row.file not in names:
            raise InputError(f"names {row.file}, but {path.name} holds {', '.join(names[:8])}", row.where)


def _source(
    path: Path,
    clip: Clip,
    labels: Sequence[FrameRange],
    ranges: Sequence[FrameRange] | None,
    tables: Sequence[NameTable],
) -> _Source:
    _require_human_size(clip)
    clip = replace(clip, labels=frame_labels(rows_of_file(labels, clip.name), clip.frame_count))
    if ranges is None:
        return _Source(path, clip, table_for(clip.skeleton, tables), [(0, clip.frame_count)])
    rows = rows_of_file(ranges, clip.name)
    require_inside(rows, clip.frame_count)
    return _Source(path, clip, table_for(clip.skeleton, tables), [(row.start, row.end) for row in rows])


def _require_human_size(clip: Clip) -> None:
    skeleton = clip.skeleton
    bones = skeleton.offsets if clip.translations is None else clip.translations[0]
    reach = np.zeros(skeleton.joint_count)
    for joint in range(1, skeleton.joint_count):
        reach[joint] = reach[skeleton.parents[joint]] + np.linalg.norm(bones[joint])
    if not SMALLEST <= reach.max() <= LARGEST:
        raise InputError(
            f"its joints reach {reach.max():.3g} m from the root, expected {SMALLEST} to {LARGEST} m: "
            "are its lengths in another unit?",
            skeleton.where,
        )


def _mapped(source: _Source, body: Skeleton, floor: Floor) -> list[Clip]:
    """A clip for each part, cut from the mapping of the whole file whose times meet the part's first frame."""
    step = source.clip.fps / COMMON_RATE
    whole: dict[float, Clip] = {}
    clips: list[Clip] = []
    for start, end in source.parts:
        phase = round(start % step, 6)
        if phase not in whole:
            whole[phase] = onto_common_body(resample(source.clip, through=start), body, source.table, floor)
        first = whole_steps(start, source.clip.fps, COMMON_RATE)
        count = 1 + whole_steps(end - 1 - start, source.clip.fps, COMMON_RATE)
        clips.append(replace(whole[phase].cut(first, first + count), name=_name(source, start, end)))
    return clips


def _name(source: _Source, start: int, end: int) -> str:
    whole = (start, end) == (0, source.clip.frame_count)
    return source.clip.name if whole else f"{source.clip.name}[{start}:{end}]"


def _provenance(source: _Source) -> list[dict[str, Any]]:
    entry: dict[str, Any] = {
        "file": source.path.name,
        "sha256": _digest(source.path),
        "source_fps": source.clip.fps,
        "name_table": source.table.name,
    }
    if source.path.suffix.lower() == ".amc":
        skeleton = skeleton_of(source.path)
        entry |= {"skeleton": skeleton.name, "skeleton_sha256": _digest(skeleton)}
    return [
        entry | {"clip": _name(source, start, end), "start_frame": start, "end_frame": end}
        for start, end in source.parts
    ]


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
