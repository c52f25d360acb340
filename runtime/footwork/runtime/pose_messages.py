"""Pose messages of many characters at once, by compiled code: the very bytes that the codec makes of a ``Pose``.

MessagePack's own words: numbers take the shortest form that holds them, all are big-endian; the float32 in the two
binary fields are the wire's little-endian ones (SPEC.md), as processors that numba compiles for hold them.
"""

from collections.abc import Sequence
from itertools import chain

import numba
import numpy as np
from msgspec import msgpack
from numpy.typing import NDArray

from footwork.motion.kept import Kept, keep
from footwork.protocol.messages import Pose
from footwork.runtime.pose_frames import PoseFrames

Row = tuple[int, int, int, int]
"""A slot, the client's number for its character, the sequence acknowledged, and how many poses were lost."""
_LONGEST_NUMBER = 9
_WORD = 16  # bytes that every key is copied in, which takes one instruction; what follows writes over the rest
_MAP, _TRUE, _FALSE, _FLOAT64, _BIN8, _BIN16 = 0x80, 0xC3, 0xC2, 0xCB, 0xC4, 0xC5
_UINT8, _UINT16, _UINT32, _UINT64 = 0xCC, 0xCD, 0xCE, 0xCF
_OF_FIGHTERS = 2  # fields that only their poses have, the last ones


@numba.njit(cache=True, nogil=True)
def _big_endian(out, at, value, count):
    """The last ``count`` bytes of a whole number."""
    for byte in range(count):
        out[at + byte] = (value >> (8 * (count - 1 - byte))) & 0xFF
    return at + count


@numba.njit(cache=True, nogil=True)
def _whole(out, at, value):
    """A whole number from -32 on."""
    if value < 128:
        out[at] = value & 0xFF
        return at + 1
    if value < 1 << 8:
        out[at] = _UINT8
        return _big_endian(out, at + 1, value, 1)
    if value < 1 << 16:
        out[at] = _UINT16
        return _big_endian(out, at + 1, value, 2)
    if value < 1 << 32:
        out[at] = _UINT32
        return _big_endian(out, at + 1, value, 4)
    out[at] = _UINT64
    return _big_endian(out, at + 1, value, 8)


@numba.njit(cache=True, nogil=True)
def _real(out, at, value, room):
    """A float64; ``room`` (1,) is where its bits are looked at."""
    room[0] = value
    out[at] = _FLOAT64
    return _big_endian(out, at + 1, room.view(np.int64)[0], 8)


@numba.njit(cache=True, nogil=True)
def _binary(out, at, data):
    """Bytes, up to 65,535."""
    count = data.shape[0]
    out[at] = _BIN8 if count < 1 << 8 else _BIN16
    at = _big_endian(out, at + 1, count, 1 if count < 1 << 8 else 2)
    room = out[at : at + count]
    for k in range(count):
        room[k] = data[k]
    return at + count


@numba.njit(cache=True, nogil=True)
def _key(out, at, keys, k):
    """The name of field ``k``: row ``k`` of ``keys`` has how many bytes count, then these and others."""
    room, word = out[at : at + _WORD], keys[k]
    for byte in range(_WORD):
        room[byte] = word[1 + byte]
    return at + int(word[0])


@numba.njit(cache=True, nogil=True)
def write_poses(rows: NDArray, tick: int, frame: int, kept: Kept) -> None:
    """Write the pose messages of some characters one after the other.

    Args:
        rows: a ``Row`` each.  # (n, 4) int64
        tick: that they show.
        frame: which of the tick's frames.
        kept: the keys of the message and its field ``type``; the fields of PoseFrames, those of fighters without a row
            where nobody fights, root and rotations as bytes; and what is written: the messages, uint8 with room for
            all, and where each ends, int64.
    """
    keys, facing, behaviour, clip, source_frame, transition, root, rotations, health, stamina, out, ends = kept.parts
    fights, room, at = health.shape[0] > 0, np.empty(1), 0
    for n in range(rows.shape[0]):
        slot, number, acknowledged, lost = rows[n]
        out[at] = _MAP + keys.shape[0] - (0 if fights else _OF_FIGHTERS)
        at = _key(out, at + 1, keys, 0)
        at = _whole(out, _key(out, at, keys, 1), tick)
        at = _whole(out, _key(out, at, keys, 2), frame)
        at = _whole(out, _key(out, at, keys, 3), number)
        at = _whole(out, _key(out, at, keys, 4), acknowledged)
        at = _real(out, _key(out, at, keys, 5), facing[slot], room)
        at = _whole(out, _key(out, at, keys, 6), behaviour[slot])
        at = _whole(out, _key(out, at, keys, 7), clip[slot])
        at = _whole(out, _key(out, at, keys, 8), source_frame[slot])
        at = _key(out, at, keys, 9)
        out[at] = _TRUE if transition[slot] else _FALSE
        at = _binary(out, _key(out, at + 1, keys, 10), root[slot])
        at = _binary(out, _key(out, at, keys, 11), rotations[slot])
        at = _whole(out, _key(out, at, keys, 12), lost)
        if fights:
            at = _real(out, _key(out, at, keys, 13), health[slot], room)
            at = _real(out, _key(out, at, keys, 14), stamina[slot], room)
        ends[n] = at


class PoseMessages:
    """Makes the pose messages of what a simulation shows.

    Args:
        shown: the arrays that all is shown in.
    """

    def __init__(self, shown: PoseFrames) -> None:
        capacity, nobody = len(shown.root), np.zeros(0)
        root, rotations = (array.reshape(capacity, -1).view(np.uint8) for array in (shown.root, shown.rotations))
        fighters = tuple(nobody if array is None else array for array in (shown.health, shown.stamina))
        told = shown.facing, shown.behaviour, shown.clip, shown.source_frame, shown.transition
        keys = _keys()
        # every key at its whole width, so that none is copied beyond the end
        longest = keys.size + len(keys) * _LONGEST_NUMBER + root.shape[1] + rotations.shape[1]
        self._out = np.empty(capacity * longest, dtype=np.uint8)
        self._ends = np.empty(capacity, dtype=np.int64)
        self._kept = keep((keys, *told, root, rotations, *fighters, self._out, self._ends))
        self.of((), tick=0, frame=1)  # compiles it, or loads it from the cache

    def of(self, rows: Sequence[Row], *, tick: int, frame: int) -> list[bytes]:
        """The messages of some characters, each at most once, at shown frame ``frame`` of ``tick``."""
        count = len(rows)
        table = np.fromiter(chain.from_iterable(rows), np.int64, 4 * count).reshape(count, 4)
        write_poses(table, tick, frame, self._kept)
        ends = self._ends[:count].tolist()
        data = self._out[: ends[-1] if ends else 0].tobytes()
        return [data[start:end] for start, end in zip((0, *ends), ends, strict=False)]


def _keys() -> NDArray[np.uint8]:
    """Of each field of ``Pose`` in order, first its type and what that is: how many bytes, then these.  # (15, 17)"""
    config = Pose.__struct_config__
    words = [
        msgpack.encode(config.tag_field) + msgpack.encode(config.tag),
        *map(msgpack.encode, Pose.__struct_fields__),
    ]
    keys = np.zeros((len(words), 1 + _WORD), dtype=np.uint8)
    for key, word in zip(keys, words, strict=True):
        key[0], key[1 : 1 + len(word)] = len(word), np.frombuffer(word, np.uint8)
    return keys
