"""SPEC.md against the code: its tables, its transcript and its axes."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from footwork.motion import kinematics
from footwork.motion.body import default_body
from footwork.protocol import messages as m
from footwork.protocol.codec import (
    CLIENT_MESSAGE_BYTES,
    SERVER_MESSAGE_BYTES,
    decode_from_client,
    decode_from_server,
    encode,
)
from footwork.protocol.connection import TRANSITIONS, Connection, Role, State
from footwork.protocol.errors import CODES

SPEC = (Path(__file__).parents[2] / "protocol" / "SPEC.md").read_text(encoding="utf-8")
MESSAGES = {kind.__name__.lower(): kind for sender in Role for state in State for kind in TRANSITIONS[sender][state]}


def section(title: str) -> str:
    return re.split(r"^#{2,3} ", SPEC.split(f"# {title}\n", 1)[1], maxsplit=1, flags=re.MULTILINE)[0]


def rows(text: str) -> list[list[str]]:
    lines = [line.strip("| ") for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.split("|")] for line in lines]


def transcripts() -> list[list[tuple[str, str, bytes]]]:
    blocks = [rest.split("```", 1)[0] for rest in SPEC.split("```transcript\n")[1:]]
    return [entries_of(block) for block in blocks]


def entries_of(block: str) -> list[tuple[str, str, bytes]]:
    entries = re.findall(r"^([CS]) (\w+)\n((?:  [0-9a-f]+\n)+)", block, flags=re.MULTILINE)
    assert len(entries) == sum(line[0] in "CS" for line in block.splitlines())
    return [(sender, name, bytes.fromhex(digits)) for sender, name, digits in entries]


@pytest.mark.parametrize("name", MESSAGES)
def test_every_field_of_every_message_is_listed_in_order(name):
    table = re.split(r"\n\n(?=\| kind)", section(name))[0]
    fields = [row[0] for row in rows(table) if row[0] not in ("field", "---")]
    keys = list(m.Keys.__struct_fields__) if name == "command" else []
    assert fields == [*MESSAGES[name].__struct_fields__, *keys]


def test_the_states_are_those_of_the_table():
    said = {}
    for state, client, server in rows(section("States"))[2:]:
        for role, cell in ((Role.CLIENT, client), (Role.SERVER, server)):
            moves = [] if cell == "nothing" else [part.split(" -> ") for part in cell.split(", ")]
            said[role, State(state)] = {
                MESSAGES[move[0]]: State(move[-1]) if move[1:] else State(state) for move in moves
            }
    assert said == {(role, state): TRANSITIONS[role][state] for role in Role for state in State}


def test_the_error_codes_are_all_there():
    assert [row[0] for row in rows(section("Error codes"))[2:]] == list(CODES)


def test_version_and_sizes_are_the_codes():
    assert f"# The footwork protocol, version {m.PROTOCOL_VERSION}\n" in SPEC
    assert f"at most {CLIENT_MESSAGE_BYTES:,} bytes" in SPEC
    assert f"from it at most {SERVER_MESSAGE_BYTES:,}" in SPEC


@pytest.mark.parametrize("transcript", transcripts())
def test_a_transcript_encodes_to_the_same_bytes_and_keeps_to_the_states(transcript):
    client, server = Connection(Role.CLIENT), Connection(Role.SERVER)
    for sender, name, data in transcript:
        message = decode_from_client(data) if sender == "C" else decode_from_server(data)
        assert isinstance(message, MESSAGES[name])
        assert encode(message) == data
        ours, theirs = (client, server) if sender == "C" else (server, client)
        assert theirs.receive(ours.send(message)) == message
    assert client.state is server.state is State.CLOSED


def test_the_transcripts_show_every_message():
    assert {name for transcript in transcripts() for _, name, _ in transcript} == set(MESSAGES)


def test_the_kinds_of_events_that_a_client_asks_for_are_listed():
    kinds = [row for row in rows(section("event")) if row[-1] and row[1].startswith("if hello asks")]
    assert tuple(row[0] for row in kinds) == m.EVENTS


def reordered(formula: str, values: np.ndarray) -> np.ndarray:
    """The components of ``values`` as a formula such as (-x, y, z) takes them."""
    terms = formula.strip("()").split(", ")
    return np.stack([(-1 if term[0] == "-" else 1) * values[..., "xyzw".index(term[-1])] for term in terms], axis=-1)


@pytest.mark.parametrize("row", rows(section("Units and axes"))[2:], ids=lambda row: row[0].split()[0])
def test_converted_poses_are_the_mirror_image_in_every_joint(row):
    _, position, rotation, yaw, _ = row
    random = np.random.default_rng(1)
    body = default_body()
    turns = Rotation.random(body.joint_count, rng=random).as_quat()
    root = random.normal(size=3)
    places, _ = kinematics.forward(body, root, turns)
    offsets = np.broadcast_to(reordered(position, body.offsets), (body.joint_count, 3))
    converted, _ = kinematics.forward(body, reordered(position, root), reordered(rotation, turns), offsets)
    np.testing.assert_allclose(converted, reordered(position, places), atol=1e-12)
    assert np.linalg.det(reordered(position, np.eye(3)).T) == pytest.approx(-1.0)
    assert yaw == "-yaw"
    up, left_turn = reordered(position, np.array([0.0, 1.0, 0.0])), np.array([0.0, 0.6, 0.0, 0.8])
    angle = 2.0 * np.arctan2(0.6, 0.8)
    np.testing.assert_allclose(reordered(rotation, left_turn), Rotation.from_rotvec(-angle * up).as_quat())
