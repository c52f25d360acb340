"""One client's inbox: sequence numbers, ticks, limits."""

import pytest

from footwork.errors import InputError
from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.connection import State
from footwork.protocol.errors import RATE, STALE, STATE, TICK, PeerError
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.session import Session
from footwork.runtime.simulation import Simulation
from toy_bundle import toy_bundle

LIMITS = Limits(messages_per_tick=4, ahead_ticks=10, idle_seconds=2.0)


@pytest.fixture
def session():
    session = Session(b"peer", Host(Simulation(toy_bundle(), 1), 30, LIMITS).scenes.first, LIMITS, now=0)
    session.connection.state = State.OPEN
    return session


def command(sequence: int, tick: int = 0) -> m.Command:
    return m.Command(sequence=sequence, character=0, heading=0.0, behaviour="walk", tick=tick)


def refusal(session: Session, message: m.FromClient, tick: int = 0) -> PeerError:
    with pytest.raises(PeerError) as caught:
        session.receive(encode(message), tick, now=0)
    return caught.value


def sequences(session: Session, tick: int) -> list[int]:
    return [message.sequence for message in session.due(tick)]


def test_commands_wait_for_their_tick_in_order(session):
    for message in (command(1, tick=9), command(2), command(3, tick=7), command(4, tick=2)):
        assert session.receive(encode(message), tick=4, now=0) is None
    assert [sequences(session, tick) for tick in range(5, 11)] == [[2, 4], [], [3], [], [1], []]


def test_a_sequence_must_rise(session):
    session.receive(encode(command(5)), 0, 0)
    for sequence in (5, 4, 1):
        error = refusal(session, command(sequence))
        assert (error.code, error.sequence) == (STALE, sequence)
    session.receive(encode(m.Despawn(sequence=6, character=0)), 1, 0) if sequences(session, 1) == [5] else None
    assert sequences(session, 2) == [6]


def test_a_command_too_far_ahead_is_refused_and_does_not_use_up_its_sequence(session):
    assert refusal(session, command(1, tick=16), tick=4).code == TICK
    session.receive(encode(command(1, tick=15)), tick=4, now=0)
    assert sequences(session, 15) == [1]


def test_a_flood_is_cut_off_before_it_is_read_and_begins_anew_with_the_tick(session):
    for sequence in range(1, 5):
        session.receive(encode(command(sequence)), 0, 0)
    with pytest.raises(PeerError) as caught:
        session.receive(b"garbage that nobody reads", 0, 0)
    assert caught.value.code == RATE
    assert sequences(session, 1) == [1, 2, 3, 4]
    session.receive(encode(command(5)), 1, 0)


def test_ping_and_bye_are_for_the_caller_to_answer(session):
    assert session.receive(encode(m.Ping(nonce=3)), 0, 0) == m.Ping(nonce=3)
    assert session.receive(encode(m.Bye(reason="done")), 0, 0) == m.Bye(reason="done")
    assert refusal(session, m.Ping()).code == STATE


def test_silence_is_counted_from_the_last_good_message(session):
    second = 1_000_000_000
    session.receive(encode(m.Ping()), 0, now=5 * second)
    with pytest.raises(PeerError):
        session.receive(b"garbage", 0, now=6 * second)
    assert not session.idle(7 * second)
    assert session.idle(7 * second + 1)


def test_limits_must_be_above_zero():
    with pytest.raises(InputError, match="sessions is 0"):
        Limits(sessions=0)
