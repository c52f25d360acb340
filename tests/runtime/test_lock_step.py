"""Ticks that clients ask for."""

import pytest

from footwork.protocol import messages as m
from footwork.protocol.errors import LOCK_STEP
from talk import Talk, codes, spawn


@pytest.fixture
def talk():
    return Talk(60, lockstep=True)


def test_a_clock_is_not_stepped():
    talk = Talk()
    talk.open(b"a")
    assert codes(talk.say(b"a", m.Step())) == [LOCK_STEP]


def stepped(talk, peer):
    """Ticks as far as they are asked for; what a peer gets."""
    while talk.host.step():
        pass
    return talk.answers(peer)


def test_a_session_gets_the_ticks_that_it_asks_for(talk):
    assert talk.open(b"a").lockstep
    assert stepped(talk, b"a") == []
    event, pose, answer = talk.say(b"a", spawn(1, 0), m.Step()) or stepped(talk, b"a")
    assert (event.kind, event.tick) == ("spawned", 1)
    assert (pose.tick, pose.frame, pose.acknowledged) == (1, 2, 1)
    assert answer == m.Stepped(tick=1)
    pose, answer = talk.say(b"a", m.Step(ticks=30)) or stepped(talk, b"a")
    assert (pose.tick, pose.frame, answer.tick) == (31, 2, 31)


def test_a_tick_waits_for_all_that_have_characters(talk):
    for peer in (b"a", b"b", b"c"):
        talk.open(peer)
    talk.say(b"a", spawn(1, 0), m.Step())
    stepped(talk, b"a")
    talk.say(b"b", spawn(1, 0), m.Step(ticks=3))
    assert stepped(talk, b"b") == []  # a has a character, and has not asked
    talk.say(b"a", m.Step(ticks=2))
    assert [type(message) for message in stepped(talk, b"a")] == [m.Pose, m.Stepped]
    assert talk.host.simulation.tick == 3
    assert codes(talk.say(b"b", m.Step())) == [LOCK_STEP]
    talk.say(b"a", m.Bye())
    assert stepped(talk, b"b")[-1] == m.Stepped(tick=4)
    talk.say(b"c", m.Step())
    assert stepped(talk, b"c") == []  # now b has a character
    talk.say(b"b", m.Step())
    assert stepped(talk, b"c") == [m.Stepped(tick=5)]
