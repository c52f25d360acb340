"""Messages to bytes and back, and every bound."""

import math
import random
from contextlib import suppress

import msgpack
import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footwork.protocol import messages as m
from footwork.protocol.codec import (
    CLIENT_MESSAGE_BYTES,
    SERVER_MESSAGE_BYTES,
    decode_from_client,
    decode_from_server,
    encode,
    encode_checked,
)
from footwork.protocol.errors import MALFORMED, TOO_LARGE, LocalError, PeerError

place = st.floats(-1e5, 1e5)
sequence = st.integers(1, 2**53 - 1)
counter = st.integers(0, 2**53 - 1)
character = st.integers(0, 65535)
index = st.integers(-1, 2**31 - 1)
name = st.text(max_size=64)
sign = st.integers(-1, 1)
keys = st.builds(m.Keys, view_yaw=place, forward=sign, strafe=sign, run=st.booleans(), jump=st.booleans())
moved = {"sequence": sequence, "character": character}
from_clients = st.one_of(
    st.builds(
        m.Hello,
        version=st.integers(0, 2**31 - 1),
        client=name,
        events=st.lists(name, max_size=2).map(tuple),
        resume=st.binary(max_size=16),
    ),
    st.builds(m.Spawn, **moved, x=place, z=place, yaw=place, behaviour=name),
    st.builds(m.Command, **moved, keys=keys, tick=counter),
    st.builds(m.Command, **moved, heading=place, behaviour=name, tick=counter, speed=st.none() | st.floats(0, 20)),
    st.builds(m.Correct, **moved, x=place, z=place, yaw=place),
    st.builds(m.Teleport, **moved, x=place, z=place, yaw=place),
    st.builds(m.Despawn, **moved),
    st.builds(m.Step, ticks=st.integers(1, 30)),
    st.builds(m.Ping, nonce=counter),
    st.builds(m.Bye, reason=name),
)
offset = st.tuples(place, place, place)
share = st.one_of(st.just(msgspec.UNSET), st.floats(-1, 1))
from_servers = st.one_of(
    st.builds(
        m.Pose,
        tick=counter,
        frame=st.integers(1, 1000),
        character=character,
        acknowledged=counter,
        facing=place,
        behaviour=index,
        clip=index,
        source_frame=index,
        transition=st.booleans(),
        root=st.binary(min_size=12, max_size=12),
        rotations=st.integers(1, 31).flatmap(lambda joints: st.binary(min_size=16 * joints, max_size=16 * joints)),
        lost=counter,
        health=share,
        stamina=share,
    ),
    st.builds(
        m.Welcome,
        version=st.just(1),
        tick=counter,
        tick_rate=st.just(30),
        frame_rate=st.just(60),
        joints=st.lists(name, max_size=3).map(tuple),
        parents=st.lists(index, max_size=3).map(tuple),
        offsets=st.lists(offset, max_size=3).map(tuple),
        ends=st.lists(offset, max_size=3).map(tuple),
        behaviours=st.lists(name, max_size=3).map(tuple),
        clips=st.lists(name, max_size=3).map(tuple),
        lockstep=st.booleans(),
        token=st.binary(max_size=16),
        resumed=st.booleans(),
        sequence=counter,
        spawned=st.lists(character, max_size=3).map(tuple),
        opponents=st.one_of(st.just(msgspec.UNSET), st.lists(st.tuples(character, character), max_size=3).map(tuple)),
    ),
    st.builds(
        m.Event,
        tick=counter,
        kind=name,
        character=character,
        sequence=counter,
        behaviour=index,
        opponent=st.one_of(st.just(msgspec.UNSET), index),
        damage=share,
    ),
    st.builds(m.Error, code=name, message=name, sequence=counter, valid=st.lists(name, max_size=3).map(tuple)),
    st.builds(m.Stepped, tick=counter),
    st.builds(m.Pong, nonce=counter, tick=counter),
)


@given(from_clients)
def test_what_a_client_says_comes_back_the_same(message):
    assert decode_from_client(encode_checked(message)) == message


@given(from_servers)
def test_what_a_server_says_comes_back_the_same(message):
    assert decode_from_server(encode_checked(message)) == message


@given(st.one_of(from_clients, from_servers))
def test_another_messagepack_library_reads_the_same_fields(message):
    fields = msgpack.unpackb(encode(message))
    assert fields.pop("type") == type(message).__name__.lower()
    said = [name for name in message.__struct_fields__ if getattr(message, name) is not msgspec.UNSET]
    assert list(fields) == said


def test_a_pose_of_31_joints_fits_one_packet():
    most = 2**53 - 1
    pose = m.Pose(
        tick=most,
        frame=1000,
        character=65535,
        acknowledged=most,
        facing=3.0,
        behaviour=2**31 - 1,
        clip=2**31 - 1,
        source_frame=2**31 - 1,
        transition=True,
        root=bytes(12),
        rotations=bytes(31 * 16),
        lost=most,
        health=1.0,
        stamina=1.0,
    )
    assert len(encode_checked(pose)) <= 1200


def test_the_longest_command_fits_the_size_a_server_takes():
    long = "\U0001f9b6" * 64
    command = m.Command(sequence=2**53 - 1, character=65535, heading=-1e5, behaviour=long, tick=2**53 - 1)
    assert len(encode_checked(command)) <= CLIENT_MESSAGE_BYTES


def raw(**fields) -> bytes:
    return bytes(msgpack.packb(fields) or b"")


BAD = {
    "empty": b"",
    "text": b"hello",
    "a number": msgpack.packb(7),
    "an array": msgpack.packb([1, 2]),
    "no type": raw(version=1),
    "unknown type": raw(type="fly"),
    "a server's message": raw(type="pong", nonce=1, tick=1),
    "type is no word": raw(type=3),
    "trailing bytes": raw(type="ping") + b"\x00",
    "truncated": raw(type="ping", nonce=1)[:-1],
    "a map of four thousand million": b"\xdf\xff\xff\xff\xff",
    "nested too deeply": b"\x82\xa4type\xa4ping\xa1y" + b"\x91" * 1000 + b"\xc0",
    "text that is not UTF-8": b"\x83\xa4type\xa5hello\xa7version\x01\xa6client\xa2\xff\xfe",
    "NaN": raw(type="correct", sequence=1, character=0, x=math.nan, z=0, yaw=0),
    "infinity": raw(type="correct", sequence=1, character=0, x=0, z=math.inf, yaw=0),
    "minus infinity": raw(type="correct", sequence=1, character=0, x=0, z=0, yaw=-math.inf),
    "too far": raw(type="correct", sequence=1, character=0, x=100001, z=0, yaw=0),
    "a float32 NaN": b"\x84\xa4type\xa5spawn\xa8sequence\x01\xa9character\x00\xa1x\xca\x7f\xc0\x00\x00",
    "sequence 0": raw(type="despawn", sequence=0, character=0),
    "sequence below 0": raw(type="despawn", sequence=-1, character=0),
    "sequence too high": raw(type="despawn", sequence=2**53, character=0),
    "sequence past 64 bits": raw(type="despawn", sequence=2**64 - 1, character=0),
    "a sequence that is a float": raw(type="despawn", sequence=1.0, character=0),
    "a sequence that is true": raw(type="despawn", sequence=True, character=0),
    "a character too high": raw(type="despawn", sequence=1, character=65536),
    "a missing field": raw(type="despawn", sequence=1),
    "a long name": raw(type="hello", version=1, client="x" * 65),
    "forward 2": raw(type="command", sequence=1, character=0, keys={"view_yaw": 0, "forward": 2}),
    "view yaw NaN": raw(type="command", sequence=1, character=0, keys={"view_yaw": math.nan}),
    "neither keys nor heading": raw(type="command", sequence=1, character=0),
    "heading alone": raw(type="command", sequence=1, character=0, heading=0.0),
    "behaviour alone": raw(type="command", sequence=1, character=0, behaviour="walk"),
    "keys and heading": raw(
        type="command", sequence=1, character=0, keys={"view_yaw": 0}, heading=0.0, behaviour="walk"
    ),
    "no ticks": raw(type="step", ticks=0),
    "too many ticks": raw(type="step", ticks=31),
    "too many kinds of events": raw(type="hello", version=1, events=["x"] * 17),
    "a token that is too long": raw(type="hello", version=1, resume=bytes(17)),
    "a token that is text": raw(type="hello", version=1, resume="x"),
    "a type that changes": b"\x82\xa4type\xa4ping\xa4type\xa3bye",
}


@pytest.mark.parametrize("data", BAD.values(), ids=BAD)
def test_bad_bytes_are_malformed(data):
    with pytest.raises(PeerError) as caught:
        decode_from_client(data)
    assert caught.value.code == MALFORMED
    assert "\n" not in str(caught.value)


def test_the_path_to_the_bad_field_is_told():
    with pytest.raises(PeerError, match=r"\$\.keys\.forward"):
        decode_from_client(raw(type="command", sequence=1, character=0, keys={"view_yaw": 0, "forward": 2}))


def test_length_is_judged_before_anything_is_read():
    for decode, limit in ((decode_from_client, CLIENT_MESSAGE_BYTES), (decode_from_server, SERVER_MESSAGE_BYTES)):
        with pytest.raises(PeerError) as caught:
            decode(b"\xff" * (limit + 1))
        assert caught.value.code == TOO_LARGE


def test_unknown_fields_are_skipped():
    assert decode_from_client(raw(type="ping", nonce=4, colour={"red": [1, 2]})) == m.Ping(nonce=4)


def test_a_repeated_key_counts_at_its_last_value():
    assert decode_from_client(b"\x83\xa4type\xa4ping\xa5nonce\x01\xa5nonce\x02") == m.Ping(nonce=2)


def test_whole_numbers_are_taken_for_floats():
    data = raw(type="correct", sequence=1, character=0, x=1, z=2, yaw=0)
    assert decode_from_client(data) == m.Correct(sequence=1, character=0, x=1.0, z=2.0, yaw=0.0)


def test_rotations_that_are_not_whole_joints_are_malformed():
    whole = {"tick": 1, "frame": 1, "character": 0, "acknowledged": 0, "behaviour": 0, "clip": 0, "source_frame": 0}
    data = raw(type="pose", **whole, facing=0.0, transition=False, root=bytes(12), rotations=bytes(17))
    with pytest.raises(PeerError, match="16 bytes"):
        decode_from_server(data)


def test_our_own_message_out_of_bounds_is_our_own_bug():
    for message in (m.Hello(version=-1), m.Correct(sequence=1, character=0, x=math.nan, z=0, yaw=0)):
        with pytest.raises(LocalError):
            encode_checked(message)


def test_random_and_mutated_bytes_never_raise_anything_but_peer_errors():
    rng = random.Random(2)
    seeds = [data for data in BAD.values() if data] + [
        encode(m.Hello(version=1, client="x")),
        encode(m.Command(sequence=9, character=1, keys=m.Keys(view_yaw=1.0, forward=1))),
        encode(m.Command(sequence=9, character=1, heading=0.5, behaviour="walk")),
        encode(m.Spawn(sequence=1, character=0, behaviour="run")),
    ]
    for _ in range(20000):
        data = bytearray(rng.choice(seeds) if rng.random() < 0.8 else rng.randbytes(rng.randrange(64)))
        for _ in range(rng.randrange(4)):
            if data:
                data[rng.randrange(len(data))] = rng.randrange(256)
        for decode in (decode_from_client, decode_from_server):
            with suppress(PeerError):
                decode(bytes(data))
