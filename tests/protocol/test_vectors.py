"""The golden vectors against our codec, and that they leave nothing out."""

import json
from importlib.resources import files

import msgspec
import pytest

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_client, decode_from_server, encode
from footwork.protocol.connection import TRANSITIONS, Role, State
from footwork.protocol.errors import MALFORMED, TOO_LARGE, PeerError

VECTORS = json.loads(files("footwork.protocol").joinpath("vectors.json").read_text())
DECODE = {"client": decode_from_client, "server": decode_from_server}
UNION = {"client": m.FromClient, "server": m.FromServer}


def message_of(vector: dict):
    def plain(value):
        if isinstance(value, dict):
            return bytes.fromhex(value["hex"]) if set(value) == {"hex"} else {k: plain(v) for k, v in value.items()}
        return [plain(each) for each in value] if isinstance(value, list) else value

    return msgspec.convert(plain(vector["message"]), UNION[vector["from"]])


def data_of(vector: dict) -> bytes:
    return bytes.fromhex(vector["hex"])


def test_they_are_of_this_protocol():
    assert VECTORS["protocol"] == m.PROTOCOL_VERSION


@pytest.mark.parametrize("sender", DECODE)
def test_every_message_is_there_and_is_written_like_this(sender):
    vectors = [vector for vector in VECTORS["messages"] if vector["from"] == sender]
    for vector in vectors:
        assert DECODE[sender](data_of(vector)) == message_of(vector), vector["name"]
        assert encode(message_of(vector)) == data_of(vector), vector["name"]
    kinds = {kind.__name__.lower() for state in State for kind in TRANSITIONS[Role(sender)][state]}
    assert {vector["message"]["type"] for vector in vectors} == kinds


def test_those_written_in_other_ways_are_taken_for_what_they_say():
    for vector in VECTORS["accepted"]:
        assert DECODE[vector["from"]](data_of(vector)) == message_of(vector), vector["name"]


def test_those_out_of_bounds_or_malformed_are_refused_with_their_code():
    for vector in VECTORS["refused"]:
        with pytest.raises(PeerError) as caught:
            DECODE[vector["from"]](data_of(vector))
        assert caught.value.code == vector["code"], vector["name"]
    assert {vector["code"] for vector in VECTORS["refused"]} == {MALFORMED, TOO_LARGE}


def test_every_field_that_a_client_fills_has_its_limits_among_them():
    fields = {f"{kind.__name__.lower()}.{name}" for kind in m.FromClient.__args__ for name in kind.__struct_fields__}
    fields = fields - {"command.keys"} | {f"command.keys.{name}" for name in m.Keys.__struct_fields__}
    for section in ("accepted", "refused"):
        named = {vector["name"].split(" ")[0] for vector in VECTORS[section]}
        assert fields <= named, section


def test_names_tell_them_apart():
    names = [
        (vector["from"], vector["name"]) for part in ("messages", "accepted", "refused") for vector in VECTORS[part]
    ]
    assert len(set(names)) == len(names)
