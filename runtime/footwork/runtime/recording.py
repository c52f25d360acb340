"""Recordings: what took effect in a simulation at which tick, as an append-only file.

The file begins with ``MAGIC``. Then come records: the length of its bytes, the CRC-32 of those four and the CRC-32 of
its bytes as little-endian uint32, and the bytes, one MessagePack message. The first is the Header, then come effects in
their order. Every ``STATE_TICKS`` or so there is a State, and at the end an End. A file that ends within a record was
cut off; it holds all that is before.
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from operator import methodcaller
from pathlib import Path
from typing import Annotated

import msgspec
from msgspec import Meta, Struct

from footwork.errors import InputError
from footwork.motion.tick import TICK_RATE

MAGIC, VERSION = b"FOOTREC\n", 1
SUFFIX = ".footrec"
STATE_TICKS = 2 * TICK_RATE
"""How often the state's digest is recorded."""
LONGEST_GAP = 3600
"""Ticks from one record to the next: a longer gap is damage, so that no small file runs for ever."""
MOST_RECORD_BYTES = 1 << 22
MOST_CHARACTERS = 1 << 17
_FRAME = struct.Struct("<4sII")

Tick = Annotated[int, Meta(ge=0, le=2**53)]
Slot = Annotated[int, Meta(ge=0, lt=MOST_CHARACTERS)]
Number = Annotated[float, Meta(ge=-1e9, le=1e9)]
Index = Annotated[int, Meta(ge=-1, le=32767)]
Slots = Annotated[tuple[Slot, ...], Meta(max_length=4096)]
Given = tuple[Annotated[int, Meta(ge=0, le=LONGEST_GAP)], Slot, Number, Index, Index, Number | None]
"""A command in a run of ticks: before which of them, to whom, heading, behaviour, one-shot behaviour and speed."""


class Header(Struct, frozen=True, kw_only=True):
    """What a recording was made with.

    Args:
        version: of the format.
        bundle: the bundle's digest.
        footwork: version of the package.
        processor: the kind of processor: another may round otherwise.
        rate: shown frames a second.
        capacity: how many characters there was room for.
        inertialise: whether transitions were smoothed.
        foot_lock: whether feet that stand stayed.
        seed: of whatever chose the commands, 0 for players.
    """

    version: int
    bundle: str
    footwork: str
    processor: str
    rate: Annotated[int, Meta(ge=TICK_RATE, le=1000, multiple_of=TICK_RATE)]
    capacity: Annotated[int, Meta(ge=1, le=MOST_CHARACTERS)]
    inertialise: bool
    foot_lock: bool
    seed: int = 0


class Record(Struct, frozen=True, array_like=True, gc=False):
    """An array on file: the name of its kind, then its fields.

    Args:
        tick: before which tick it took effect.
    """

    tick: Tick


class Spawned(Record, frozen=True, array_like=True, gc=False, tag="spawn"):
    """A character came into a slot; ``node`` is -1 where its behaviour said where it began, ``held`` for no key."""

    slot: Slot
    x: Number
    z: Number
    yaw: Number
    behaviour: Annotated[str, Meta(max_length=256)]
    node: Annotated[int, Meta(ge=-1, lt=2**31)]
    held: Index = -1


class Commanded(Record, frozen=True, array_like=True, gc=False, tag="command"):
    """A command came into force."""

    slot: Slot
    heading: Number
    behaviour: Index
    one_shot: Index
    speed: Number | None = None


class Moved(Record, frozen=True, array_like=True, gc=False):
    """Where a character was put."""

    slot: Slot
    x: Number
    z: Number
    yaw: Number


class Corrected(Moved, frozen=True, array_like=True, gc=False, tag="correct"):
    """A root was moved, and the motion with it."""


class Teleported(Moved, frozen=True, array_like=True, gc=False, tag="teleport"):
    """A character was put elsewhere."""


class Removed(Record, frozen=True, array_like=True, gc=False, tag="remove"):
    """A character left its slot."""

    slot: Slot


class Restored(Record, frozen=True, array_like=True, gc=False, tag="restore"):
    """Characters of a snapshot were put into slots."""

    slots: Slots
    blob: bytes


class Resimulated(Record, frozen=True, array_like=True, gc=False, tag="resimulate"):
    """Some characters were taken through ticks by themselves."""

    slots: Slots
    ticks: Annotated[int, Meta(ge=0, le=LONGEST_GAP)]
    given: Annotated[tuple[Given, ...], Meta(max_length=65536)]


class Fought(Record, frozen=True, array_like=True, gc=False, tag="fight"):
    """A match of two fighters began; its seed is the header's.

    Args:
        styles: the numbers of both, as ``fighting_style.STYLE`` names them.
        rules: the numbers of the match, as ``match_rules.MatchRules`` names them.
        table: whether they shadow by the bundle's table.
    """

    styles: tuple[dict[str, Number], dict[str, Number]]
    rules: dict[str, Number]
    table: bool


class Opposed(Record, frozen=True, array_like=True, gc=False, tag="oppose"):
    """Each character that is spawned from now on brings an opponent, in the slot after its own.

    Args:
        name: of the opponents' style.
        styles: the numbers of the characters and of their opponents, as ``fighting_style.STYLE`` names them.
        rules: the numbers of their matches, as ``match_rules.MatchRules`` names them.
        seed: of the opponents.
        table: whether they shadow by the bundle's table.
    """

    name: Annotated[str, Meta(max_length=64)]
    styles: tuple[dict[str, Number], dict[str, Number]]
    rules: dict[str, Number]
    seed: Annotated[int, Meta(ge=0, le=2**32)]
    table: bool


class State(Record, frozen=True, array_like=True, gc=False, tag="state"):
    """The digest of all that was remembered of all characters after the tick."""

    digest: Annotated[bytes, Meta(min_length=16, max_length=16)]


class End(Record, frozen=True, array_like=True, gc=False, tag="end"):
    """The recording was ended on purpose after the tick."""


Effect = Spawned | Commanded | Corrected | Teleported | Removed | Restored | Resimulated | Fought | Opposed
AnyRecord = Effect | State | End
_encoder = msgspec.msgpack.Encoder(enc_hook=methodcaller("item"))  # numbers may be NumPy's
_header_decoder = msgspec.msgpack.Decoder(Header)
_record_decoder = msgspec.msgpack.Decoder(AnyRecord)


def framed(record: Header | AnyRecord) -> bytes:
    """The bytes of a record on file, with its length and checksum."""
    data = _encoder.encode(record)
    length = len(data).to_bytes(4, "little")
    return _FRAME.pack(length, zlib.crc32(length), zlib.crc32(data)) + data


def framed_soundly(record: AnyRecord) -> bytes:
    """``framed``, of a record that can be read again.

    Raises:
        InputError: for one with numbers that are out of bounds, and one that is too long.
    """
    data = framed(record)
    try:
        _record_decoder.decode(memoryview(data)[_FRAME.size :])
    except msgspec.DecodeError as error:
        raise InputError(f"cannot be recorded: {error}", type(record).__name__.lower()) from None
    if len(data) - _FRAME.size > MOST_RECORD_BYTES:
        raise InputError(f"is longer than {MOST_RECORD_BYTES} bytes", type(record).__name__.lower())
    return data


@dataclass(frozen=True, eq=False)
class Recording:
    """A recording that was read.

    Args:
        header: what it was made with.
        records: all whole ones, ticks never falling.
        whole: whether it was ended on purpose, rather than cut off.
        where: the file.
    """

    header: Header
    records: tuple[AnyRecord, ...]
    whole: bool
    where: str

    @property
    def first(self) -> int:
        """The tick last made when it began."""
        return made_by(self.records[0]) if self.records else 0

    @property
    def last(self) -> int:
        """The last tick of which something is known."""
        return made_by(self.records[-1]) if self.records else 0


def made_by(record: AnyRecord) -> int:
    """The tick last made when a record came about."""
    return record.tick if isinstance(record, State | End) else record.tick - 1


def read_recording(path: str | Path) -> Recording:
    """Read a recording; one that was cut off up to its last whole record.

    Raises:
        InputError: for a file that is missing, no recording, damaged before its end or of another version.
        OSError: where the file cannot be read.
    """
    where = str(path)
    data = memoryview(Path(path).read_bytes())
    if data[: len(MAGIC)] != MAGIC:
        raise InputError(f"no recording, expected a file that begins with {MAGIC.decode().strip()}", where)
    frames = _frames(data, where)
    header = _header(next(frames, None), where)
    records = tuple(_records(frames, where))
    return Recording(header, records, bool(records) and isinstance(records[-1], End), where)


def _frames(data: memoryview, where: str) -> Iterator[memoryview]:
    """The bytes of all whole records."""
    at, number = len(MAGIC), 0
    while len(data) - at >= _FRAME.size:
        written, length_crc, crc = _FRAME.unpack_from(data, at)
        length = int.from_bytes(written, "little")
        if zlib.crc32(written) != length_crc or length > MOST_RECORD_BYTES:
            raise InputError(f"damaged: record {number} would have {length} bytes", where)
        at += _FRAME.size
        if length > len(data) - at:
            return
        if zlib.crc32(data[at : at + length]) != crc:
            raise InputError(f"damaged: the checksum of record {number} does not fit", where)
        yield data[at : at + length]
        at, number = at + length, number + 1


def _header(data: memoryview | None, where: str) -> Header:
    if data is None:
        raise InputError("cut short: it holds no whole record", where)
    try:
        version = msgspec.msgpack.decode(data, type=_Version).version
        if version != VERSION:
            raise InputError(f"a recording of version {version}, expected version {VERSION}", where)
        return _header_decoder.decode(data)
    except msgspec.DecodeError as error:
        raise InputError(f"damaged: its header: {error}", where) from None


class _Version(Struct):
    version: int


def _records(frames: Iterator[memoryview], where: str) -> Iterator[AnyRecord]:
    tick, ended = -1, False  # a recording begins at any tick from 0 on: a simulation may have taken over from another
    for number, data in enumerate(frames, 1):
        try:
            record = _record_decoder.decode(data)
        except (msgspec.DecodeError, RecursionError) as error:
            raise InputError(f"damaged: record {number}: {error}", where) from None
        after = made_by(record)
        if ended or after < max(tick, 0) or (tick >= 0 and after > tick + LONGEST_GAP):
            raise InputError(f"damaged: record {number} is for tick {record.tick} after tick {tick}", where)
        tick, ended = after, isinstance(record, End)
        yield record
