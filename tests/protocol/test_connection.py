"""The table of states: what may come when."""

import pytest

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.connection import TRANSITIONS, Connection, Role, State
from footwork.protocol.errors import STATE, LocalError, PeerError

WELCOME = m.Welcome(
    version=1, tick=0, tick_rate=30, frame_rate=30, joints=(), parents=(), offsets=(), ends=(), behaviours=(), clips=()
)
POSE = m.Pose(
    tick=1,
    frame=1,
    character=0,
    acknowledged=0,
    facing=0.0,
    behaviour=0,
    clip=0,
    source_frame=0,
    transition=False,
    root=bytes(12),
    rotations=bytes(16),
)
EXAMPLES = {
    Role.CLIENT: [
        m.Hello(version=1),
        m.Spawn(sequence=1, character=0),
        m.Command(sequence=2, character=0, heading=0.0, behaviour="walk"),
        m.Correct(sequence=3, character=0, x=0.0, z=0.0, yaw=0.0),
        m.Teleport(sequence=4, character=0, x=0.0, z=0.0, yaw=0.0),
        m.Despawn(sequence=5, character=0),
        m.Step(ticks=2),
        m.Ping(),
        m.Bye(),
    ],
    Role.SERVER: [
        WELCOME,
        POSE,
        m.Event(tick=1, kind="spawned", character=0),
        m.Error(code="x", message=""),
        m.Stepped(tick=1),
        m.Pong(nonce=0, tick=0),
        m.Bye(),
    ],
}
CASES = [(sender, state, message) for sender in Role for state in State for message in EXAMPLES[sender]]


def test_a_session_from_hello_to_bye():
    client, server = Connection(Role.CLIENT), Connection(Role.SERVER)
    talk = [
        (client, server, m.Hello(version=1)),
        (server, client, WELCOME),
        (client, server, m.Spawn(sequence=1, character=0)),
        (server, client, POSE),
        (client, server, m.Bye()),
    ]
    for sender, receiver, message in talk:
        assert receiver.receive(sender.send(message)) == message
    assert client.state is server.state is State.CLOSED


@pytest.mark.parametrize(("sender", "state", "message"), CASES)
def test_both_sides_hold_to_the_table(sender, state, message):
    ours, theirs = Connection(sender), Connection(Role.SERVER if sender is Role.CLIENT else Role.CLIENT)
    ours.state = theirs.state = state
    following = TRANSITIONS[sender][state].get(type(message))
    if following is None:
        with pytest.raises(LocalError, match=state.value):
            ours.send(message)
        with pytest.raises(PeerError) as caught:
            theirs.receive(encode(message))
        assert caught.value.code == STATE
        assert caught.value.sequence == getattr(message, "sequence", 0)
    else:
        assert theirs.receive(ours.send(message)) == message
    assert ours.state is theirs.state is (following or state)


def test_every_message_may_come_in_some_state():
    for sender, examples in EXAMPLES.items():
        allowed = {kind for state in State for kind in TRANSITIONS[sender][state]}
        assert allowed == {type(message) for message in examples}


def test_garbage_leaves_the_state_as_it_was():
    server = Connection(Role.SERVER)
    with pytest.raises(PeerError):
        server.receive(b"garbage")
    assert server.state is State.NEW
