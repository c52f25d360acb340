"""The file of a recording: what is on it can be read, up to where it was cut off, and nothing else can."""

import zlib
from pathlib import Path

import msgspec
import pytest

from footwork.errors import InputError
from footwork.runtime import recording as r

HEADER = r.Header(
    version=r.VERSION,
    bundle="abc",
    footwork="1",
    processor="any",
    rate=60,
    capacity=4,
    inertialise=True,
    foot_lock=False,
    seed=7,
)
RECORDS = (
    r.Spawned(1, 2, 0.1, 1.0 / 3.0, -1e-17, "walk", -1),
    r.Commanded(1, 2, 0.30000000000000004, 1, -1),
    r.Commanded(1, 2, 0.5, 1, -1, 1.1),
    r.Corrected(9, 2, 5e-324, 1.0, 2.0),
    r.Teleported(9, 2, 1.0, 1.0, 2.0),
    r.Restored(40, (2,), b"blob"),
    r.Resimulated(40, (2,), 8, ((0, 2, 0.5, 1, -1, None), (3, 2, 0.5, 1, -1, 1.25))),
    r.State(60, bytes(range(16))),
    r.Removed(61, 2),
    r.End(61),
)
WHOLE = r.MAGIC + r.framed(HEADER) + b"".join(map(r.framed, RECORDS))


def read(folder: Path, data: bytes) -> r.Recording:
    path = folder / "a.footrec"
    path.write_bytes(data)
    return r.read_recording(path)


def test_what_was_written_is_read_in_full_precision(tmp_path: Path):
    found = read(tmp_path, WHOLE)
    assert (found.header, found.records) == (HEADER, RECORDS)
    assert (found.whole, found.first, found.last) == (True, 0, 61)


def test_a_recording_cut_anywhere_is_read_up_to_its_last_whole_record(tmp_path: Path):
    ends, at = [], len(r.MAGIC + r.framed(HEADER))
    for record in RECORDS:
        at += len(r.framed(record))
        ends.append(at)
    for length in range(len(r.MAGIC + r.framed(HEADER)), len(WHOLE)):
        found = read(tmp_path, WHOLE[:length])
        assert found.records == RECORDS[: sum(end <= length for end in ends)]
        assert not found.whole


def test_a_changed_byte_anywhere_is_found(tmp_path: Path):
    for place in range(len(WHOLE)):
        with pytest.raises(InputError, match=r"a\.footrec"):
            read(tmp_path, WHOLE[:place] + bytes([WHOLE[place] ^ 0x10]) + WHOLE[place + 1 :])


def test_files_that_are_none_are_refused_in_one_line(tmp_path: Path):
    huge = b"\xff\xff\xff\x7f"
    prefixed = r.MAGIC + r.framed(HEADER) + huge + zlib.crc32(huge).to_bytes(4, "little") + bytes(4)
    for data, problem in (
        (b"", "no recording"),
        (b"PK\3\4 something else", "no recording"),
        (r.MAGIC, "cut short"),
        (r.MAGIC + r.framed(r.End(3)), "its header"),
        (prefixed, "would have 2147483647 bytes"),
    ):
        with pytest.raises(InputError, match=problem) as caught:
            read(tmp_path, data)
        assert "\n" not in str(caught.value)
    with pytest.raises(OSError, match="No such file"):
        r.read_recording(tmp_path / "none.footrec")


@pytest.mark.parametrize(
    ("records", "problem"),
    [
        ((r.State(70, bytes(16)), r.State(60, bytes(16))), "tick 60 after tick 70"),
        ((r.State(0, bytes(16)), r.State(10**9, bytes(16))), "tick 1000000000 after tick 0"),
        ((r.Removed(0, 0), r.State(10**9, bytes(16))), "record 1 is for tick 0"),
        ((r.End(3), r.End(4)), "tick 4 after tick 3"),
        ((r.State(0, b"short"),), "record 1"),
        ((r.Corrected(1, 0, float("nan"), 0.0, 0.0),), "record 1"),
    ],
)
def test_records_that_cannot_be_are_refused(tmp_path: Path, records: tuple, problem: str):
    with pytest.raises(InputError, match=problem):
        read(tmp_path, r.MAGIC + r.framed(HEADER) + b"".join(map(r.framed, records)))


def test_another_version_and_too_many_characters_are_refused(tmp_path: Path):
    for changed, problem in (({"version": 2}, "version 2, expected version 1"), ({"capacity": 1 << 40}, "header")):
        header = msgspec.structs.replace(HEADER, **changed)
        with pytest.raises(InputError, match=problem):
            read(tmp_path, r.MAGIC + r.framed(header))
