"""Sessions whose connection is gone, and their clients that come back."""

import pytest

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_server, encode
from footwork.protocol.errors import NO_SESSION, RESUME
from talk import LIMITS, SECOND, Talk, codes, spawn, the_pose, walk
from toy_bundle import SHOWN


@pytest.fixture
def talk():
    return Talk()


def test_a_lost_session_is_resumed_with_its_characters_and_numbers(talk):
    first = talk.open(b"a")
    assert (len(first.token), first.resumed, first.spawned) == (16, False, ())
    talk.say(b"a", spawn(1, 7, behaviour="walk"), walk(2, 7))
    before = the_pose([message for message in talk.tick(b"a") if isinstance(message, m.Pose)])
    talk.say(b"a", walk(3, 7))
    talk.host.lose(b"a", 0)
    for _ in range(30):
        talk.host.tick()
    welcome = talk.open(b"b", resume=first.token)
    assert (welcome.token, welcome.resumed, welcome.sequence, welcome.spawned) == (first.token, True, 3, (7,))
    pose = the_pose(talk.tick(b"b"))
    assert (before.acknowledged, pose.acknowledged) == (2, 2)
    assert SHOWN[pose.behaviour] == "stop"
    talk.say(b"b", walk(4, 7))
    assert the_pose(talk.tick(b"b")).acknowledged == 4
    assert talk.host.scenes.first.sessions_begun == 1


def test_a_session_whose_old_connection_seems_alive_is_taken_over(talk):
    token = talk.open(b"a").token
    talk.say(b"a", spawn(1, 0))
    talk.tick(b"a")
    talk.host.receive(b"b", encode(m.Hello(version=1, resume=token)), 0)
    said = {peer: decode_from_server(data) for peer, data in talk.host.outgoing()}
    assert said[b"a"] == m.Bye(reason="resumed")
    assert isinstance(said[b"b"], m.Welcome)
    assert codes(talk.say(b"a", walk(2))) == [NO_SESSION]
    assert the_pose(talk.tick(b"b")).character == 0


@pytest.mark.parametrize("end", ["time", "bye", "never"])
def test_a_token_that_no_session_has_any_more_is_refused(talk, end):
    token = talk.open(b"a").token
    talk.say(b"a", spawn(1, 0))
    talk.tick(b"a")
    if end == "time":
        talk.host.lose(b"a", 0)
        talk.host.end_overdue(int(LIMITS.resume_seconds * SECOND) + 1)
    elif end == "bye":
        talk.say(b"a", m.Bye())
    else:
        token = bytes(16)
    error, bye = talk.say(b"b", m.Hello(version=1, resume=token))
    assert (error.code, bye.reason) == (RESUME, "resume")
    assert talk.host.simulation.world.active.sum() == (end == "never")


def test_sessions_that_wait_make_room_oldest_first(talk):
    tokens = []
    for peer in (b"a", b"b", b"c"):
        tokens.append(talk.open(peer).token)
        talk.say(peer, spawn(1, 0))
        talk.tick(peer)
        talk.host.lose(peer, 0)
    talk.open(b"d")
    talk.say(b"d", *(spawn(n, n) for n in range(1, 4)))
    assert codes(talk.tick(b"d")) == []
    assert codes(talk.say(b"e", m.Hello(version=1, resume=tokens[0]))) == [RESUME]
    assert codes(talk.say(b"f", m.Hello(version=1, resume=tokens[2]))) == []


def test_a_thousand_reconnections_leave_nothing_behind(talk):
    token = talk.open((0).to_bytes(2, "big")).token
    talk.say((0).to_bytes(2, "big"), spawn(1, 0))
    for number in range(1, 1001):
        talk.host.lose((number - 1).to_bytes(2, "big"), 0)
        talk.host.tick()
        talk.host.receive(number.to_bytes(2, "big"), encode(m.Hello(version=1, resume=token)), 0)
        talk.host.receive(b"other" + number.to_bytes(2, "big"), encode(m.Hello(version=1)), 0)
        talk.host.receive(b"other" + number.to_bytes(2, "big"), encode(spawn(1, 1)), 0)
        talk.host.tick()
        talk.host.lose(b"other" + number.to_bytes(2, "big"), 0)
        talk.host.outgoing()
    assert len(talk.host.sessions) == 1
    assert talk.host.simulation.world.active.sum() <= LIMITS.sessions
    talk.host.end_overdue(int(LIMITS.resume_seconds * SECOND) + 1)
    assert talk.host.simulation.world.active.sum() == 0  # idle for too long, too
    assert not talk.host._roster._by_token
