"""Snapshots: all that is remembered of some characters as a small blob, and back.

A blob is a header and then one row after the other, each the bytes of every array's row. It belongs to one bundle, one
kind of controller and one layout of rows, which the header's key stands for. What is in it is checked before it takes
effect, as it may come from anywhere.
"""

import hashlib
import math
import struct
import zlib
from collections.abc import Callable, Sequence
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.orders import LATCH_TICKS, Orders
from footwork.errors import InputError
from footwork.motion.kept import keep
from footwork.runtime.foot_lock import STEP_TICKS
from footwork.runtime.world import World

MAGIC, VERSION = b"FWSN", 1
_HEADER = struct.Struct("<4sHHIQ8s")  # magic, version, characters, CRC-32 of what follows it, tick, key
_AFTER_CRC = 12
_BEYOND = 1e9  # no number that is remembered is as large, metres, radians or seconds


@numba.njit(cache=True, nogil=True)
def _take(kept, slots, blob):
    """Copy the rows of slots out of arrays of bytes, row by row, array by array."""
    rows, at = kept.parts, 0
    for who in slots:
        for array in rows:
            for k in range(array.shape[1]):
                blob[at] = array[who, k]
                at += 1


@numba.njit(cache=True, nogil=True)
def _put(kept, slots, blob):
    """The inverse of ``_take``."""
    rows, at = kept.parts, 0
    for who in slots:
        for array in rows:
            for k in range(array.shape[1]):
                array[who, k] = blob[at]
                at += 1


@numba.njit(cache=True, nogil=True)
def _bounded(numbers):
    wrong = 0
    for value in numbers.flat:
        wrong += not abs(value) < _BEYOND
    return wrong == 0


@numba.njit(cache=True, nogil=True)
def _all_between(numbers, first, last):
    wrong = 0
    for value in numbers.flat:
        wrong += not first <= value <= last
    return wrong == 0


@numba.njit(cache=True, nogil=True)
def _speeds(numbers):
    """Whether each is ANY_SPEED, which is no number, or one that can be asked for."""
    wrong = 0
    for value in numbers.flat:
        wrong += value < 0.0 or value > _BEYOND
    return wrong == 0


@numba.njit(cache=True, nogil=True)
def _sound(slots, remembered):
    """Whether what is remembered of characters can be: numbers that index are in range, the others bounded."""
    characters, in_force, truths, nodes, edges, behaviours, settle_ticks = remembered.parts
    node, place, edge, _, glide, ticks_left, offsets, roots, _, anchor, slip, stride = characters
    heading, lasting, asked, latched, held, latch_left, _, speed, asked_speed = in_force
    sound = True
    for who in slots:
        one = slice(who, who + 1)
        sound &= _all_between(node[one], 0, nodes - 1) and _all_between(edge[one], -1, edges - 1)
        sound &= _all_between(lasting[one], 0, behaviours - 1) and _all_between(asked[one], 0, behaviours - 1)
        sound &= _all_between(latched[one], -1, behaviours - 1) and _all_between(held[one], -1, behaviours - 1)
        sound &= _all_between(ticks_left[one], 0, settle_ticks) and _all_between(latch_left[one], 0, LATCH_TICKS)
        sound &= _all_between(stride[one], 0, STEP_TICKS)
        for array in truths:
            sound &= _all_between(array[one], 0, 1)
        sound &= _bounded(place[one]) and _bounded(glide[one]) and _bounded(heading[one])
        sound &= _speeds(speed[one]) and _speeds(asked_speed[one])
        sound &= _bounded(offsets[one]) and _bounded(roots[one])
        sound &= _bounded(anchor[one]) and _bounded(slip[one])
    return sound


@numba.njit(cache=True, nogil=True)
def _exchange(kept, remembered, slots, blob, before):
    """Take the rows of slots out and put others in their place; whether these can be."""
    _take(kept, slots, before)
    _put(kept, slots, blob)
    return _sound(slots, remembered)


def _as_bytes(array: NDArray) -> NDArray[np.uint8]:
    """A view of an array's rows as bytes.  # (C, bytes a row)"""
    return array.reshape(len(array), math.prod(array.shape[1:])).view(np.uint8)


class Snapshots:
    """Takes and puts back what is remembered of the characters of one world.

    Args:
        world: where they are.
        orders: what they are asked for.
        memory: what their controller remembers, arrays with a row for each slot.
        belongs_to: what else a snapshot belongs to, such as the bundle's digest.
        sound: whether what memory holds of some slots can be; None where anything can.
    """

    def __init__(
        self,
        world: World,
        orders: Orders,
        memory: Sequence[NDArray],
        belongs_to: str,
        sound: Callable[[NDArray[np.intp]], bool] | None = None,
    ) -> None:
        arrays = [*world.characters, *orders.in_force, *memory]
        self._memory_sound = sound or (lambda slots: True)
        rows = tuple(_as_bytes(array) for array in arrays if array[:1].size)
        self._rows, self._row_bytes = keep(rows), sum(row.shape[1] for row in rows)
        layout: list[Any] = [(array.dtype.str, array.shape[1:]) for array in arrays]
        self._key = hashlib.blake2b(f"{belongs_to} {layout}".encode(), digest_size=8).digest()
        graph = world.graph
        sizes = graph.node_count, graph.edge_count, len(graph.behaviours), world.smoothing.settle_ticks
        truths = tuple(_as_bytes(array) for array in arrays if array.dtype == np.bool_)
        self._remembered = keep((world.characters, orders.in_force, truths, *sizes))

    @property
    def row_bytes(self) -> int:
        """How many bytes are remembered of a character."""
        return self._row_bytes

    def rows(self, slots: NDArray[np.intp]) -> bytes:
        """The bytes of the rows of some slots, row by row."""
        blob = np.empty(len(slots) * self._row_bytes, dtype=np.uint8)
        _take(self._rows, slots, blob)
        return blob.tobytes()

    def take(self, slots: NDArray[np.intp], tick: int) -> bytes:
        """The blob of some characters after a tick."""
        rows = self.rows(slots)
        head = _HEADER.pack(MAGIC, VERSION, len(slots), 0, tick, self._key)
        crc = zlib.crc32(rows, zlib.crc32(head[_AFTER_CRC:]))
        return _HEADER.pack(MAGIC, VERSION, len(slots), crc, tick, self._key) + rows

    def put(self, blob: bytes, slots: NDArray[np.intp]) -> int:
        """Put the characters of a blob into as many slots, and return the tick after which it was taken.

        Raises:
            InputError: for a blob that is damaged, of another bundle, version or number of characters, or holds what
                cannot be; nothing has changed then.
        """
        tick = self._checked_header(blob, len(slots))
        rows = np.frombuffer(blob, np.uint8, offset=_HEADER.size)
        before = np.empty_like(rows)
        sound = _exchange(self._rows, self._remembered, slots, rows, before)
        if not (sound and self._memory_sound(slots)):
            _put(self._rows, slots, before)
            raise InputError("holds numbers that no character has", "snapshot")
        return tick

    def _checked_header(self, blob: bytes, count: int) -> int:
        if len(blob) < _HEADER.size or blob[: len(MAGIC)] != MAGIC:
            raise InputError("cut short, or not a snapshot", "snapshot")
        _, version, characters, crc, tick, key = _HEADER.unpack_from(blob)
        if version != VERSION:
            raise InputError(f"version {version}, expected version {VERSION}", "snapshot")
        if key != self._key:
            raise InputError("of another bundle or controller than the simulation's", "snapshot")
        if characters != count:
            raise InputError(f"{characters} characters, expected {count}, one for each slot", "snapshot")
        if len(blob) != _HEADER.size + count * self._row_bytes:
            expected = _HEADER.size + count * self._row_bytes
            raise InputError(f"{len(blob)} bytes, expected {expected}", "snapshot")
        if crc != zlib.crc32(memoryview(blob)[_AFTER_CRC:]):
            raise InputError("damaged: its checksum does not fit", "snapshot")
        return tick
