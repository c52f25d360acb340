"""Messages that are wrong in every way that one can think of, and in some that one cannot."""

import math
import random
from collections.abc import Callable
from typing import Any

import msgpack

Fields = dict[str, Any]

VALID: tuple[Fields, ...] = (
    {"type": "hello", "version": 1, "client": "odd", "events": ["behaviour"], "resume": b""},
    {"type": "spawn", "sequence": 1, "character": 0, "x": 1.0, "z": 2.0, "yaw": 0.5, "behaviour": "stop"},
    {"type": "command", "sequence": 2, "character": 0, "heading": 1.0, "behaviour": "walk", "tick": 0},
    {"type": "command", "sequence": 3, "character": 0, "keys": {"view_yaw": 0.0, "forward": 1, "strafe": -1}},
    {"type": "correct", "sequence": 4, "character": 0, "x": 0.0, "z": 0.0, "yaw": 0.0},
    {"type": "teleport", "sequence": 5, "character": 0, "x": 0.0, "z": 0.0, "yaw": 0.0},
    {"type": "despawn", "sequence": 6, "character": 0},
    {"type": "step", "ticks": 1},
    {"type": "ping", "nonce": 7},
    {"type": "bye", "reason": "done"},
)
ODD: tuple[Any, ...] = (
    *(None, True, False, -1, 2**31, 2**53, 2**63 - 1, 2**64 - 1, -(2**63), 0.5, 1e308, -1e308, 5e-324),
    *(math.nan, math.inf, -math.inf, "", "walk", "\u0000", "\ud7ff\U0010ffff" * 8, "x" * 900, b"", b"\xff" * 64),
    *([], [[]] * 20, {}, {"type": "bye"}, {"view_yaw": math.nan}, msgpack.ExtType(5, b"x" * 20), msgpack.Timestamp(1)),
)


def odd_message(rng: random.Random, sequence: int) -> bytes:
    """A message with the next sequence number, mutated in its fields, in its bytes, or not at all."""
    fields = dict(rng.choice(VALID))
    if "sequence" in fields:
        fields["sequence"] = sequence
    return rng.choice(_MUTATIONS)(rng, fields)


def _as_it_is(rng: random.Random, fields: Fields) -> bytes:
    return _packed(fields)


def _odd_field(rng: random.Random, fields: Fields) -> bytes:
    fields[rng.choice(list(fields))] = rng.choice(ODD)
    return _packed(fields)


def _less_or_more(rng: random.Random, fields: Fields) -> bytes:
    fields.pop(rng.choice(list(fields)))
    if rng.random() < 0.5:
        fields[rng.choice(("type", "sequence", "unknown", "x" * 40))] = rng.choice(ODD)
    return _packed(fields)


def _said_twice(rng: random.Random, fields: Fields) -> bytes:
    """The same keys again with other values."""
    other = rng.choice(VALID)
    packer = msgpack.Packer()
    pairs = [*fields.items(), *other.items()]
    return packer.pack_map_header(len(pairs)) + b"".join(packer.pack(part) for pair in pairs for part in pair)


def _deep(rng: random.Random, fields: Fields) -> bytes:
    return _packed(fields)[:-1] + b"\x91" * rng.randrange(1, 900)


def _bits_flipped(rng: random.Random, fields: Fields) -> bytes:
    data = bytearray(_packed(fields))
    for _ in range(rng.randrange(1, 5)):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def _cut_and_joined(rng: random.Random, fields: Fields) -> bytes:
    one, other = _packed(fields), _packed(rng.choice(VALID))
    return one[: rng.randrange(len(one))] + other[rng.randrange(len(other)) :]


def _noise(rng: random.Random, fields: Fields) -> bytes:
    return rng.randbytes(rng.choice((0, 1, 2, 16, 200, 1024, 1025, 3000)))


def _packed(fields: Fields) -> bytes:
    return msgpack.Packer().pack(fields)


_MUTATIONS: tuple[Callable[[random.Random, Fields], bytes], ...] = (
    _as_it_is,
    _odd_field,
    _odd_field,
    _less_or_more,
    _said_twice,
    _deep,
    _bits_flipped,
    _bits_flipped,
    _cut_and_joined,
    _noise,
)
