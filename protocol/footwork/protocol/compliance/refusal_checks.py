"""Checks of refusals: each error code, and that the session goes on."""

import json
import time
from collections.abc import Iterator
from importlib.resources import files

from footwork.protocol import messages as m
from footwork.protocol.compliance.peer import PATIENCE, Dial, Failed, Peer, calling, expect, in_session
from footwork.protocol.errors import (
    BEHAVIOUR,
    CHARACTER_TAKEN,
    CHARACTER_UNKNOWN,
    CHARACTERS,
    NO_SESSION,
    RATE,
    STALE,
    TICK,
)

_TRIES = 100
_QUIET = 0.05
_ERRORS_PER_TICK = 4


def _vectors(section: str) -> Iterator[dict]:
    """What a client may send, of a section of the golden vectors."""
    vectors = json.loads(files("footwork.protocol").joinpath("vectors.json").read_text())
    return (each for each in vectors[section] if each["from"] == "client")


def _expect_answers(dial: Dial, cases: list[tuple[str, bytes, str]]) -> None:
    """Each message is answered with an error code; a stranger gets so many answers within a tick, so several ask."""
    for first in range(0, len(cases), _ERRORS_PER_TICK):
        with calling(dial) as peer:
            for name, data, code in cases[first : first + _ERRORS_PER_TICK]:
                peer.line.send(data)
                answer = peer.listen(PATIENCE)
                expect(answer.code if isinstance(answer, m.Error) else answer, code, f"answer to {name}")


def malformed_messages_are_refused(dial: Dial) -> None:
    """Every one of the golden vectors, with its code."""
    _expect_answers(dial, [(each["name"], bytes.fromhex(each["hex"]), each["code"]) for each in _vectors("refused")])


def messages_may_be_written_in_other_ways(dial: Dial) -> None:
    """Those of the golden vectors are taken for messages: a stranger is told to say hello first."""
    taken = (each for each in _vectors("accepted") if each["message"]["type"] != "hello")
    _expect_answers(dial, [(each["name"], bytes.fromhex(each["hex"]), NO_SESSION) for each in taken])


def an_unknown_behaviour_is_refused_with_those_there_are(dial: Dial) -> None:
    """For spawn as for command."""
    with in_session(dial) as peer:
        peer.spawn()
        welcome, sequence = peer.welcome, peer.next()
        peer.say(m.Command(sequence=sequence, character=0, heading=0.0, behaviour="no such behaviour"))
        expect(peer.refusal(BEHAVIOUR, sequence).valid, welcome.behaviours, "what would be valid")
        sequence = peer.next()
        peer.say(m.Spawn(sequence=sequence, character=9, behaviour="no such behaviour"))
        peer.refusal(BEHAVIOUR, sequence)


def a_sequence_rises(dial: Dial) -> None:
    """A message with one that was there already is refused."""
    with in_session(dial) as peer:
        peer.spawn()
        peer.say(m.Despawn(sequence=1, character=0))
        peer.refusal(STALE, 1)
        expect(peer.pose().character, 0, "character")


def a_command_may_not_lie_far_ahead(dial: Dial) -> None:
    """31 ticks after the next one at most."""
    with in_session(dial) as peer:
        peer.spawn()
        sequence, tick = peer.next(), peer.pose().tick + 1000
        peer.say(m.Command(sequence=sequence, character=0, keys=m.Keys(view_yaw=0.0), tick=tick))
        peer.refusal(TICK, sequence)


def characters_are_the_sessions_own(dial: Dial) -> None:
    """Numbers that are taken, and numbers of nobody, are refused; another session's are no business of this one."""
    with in_session(dial) as other, in_session(dial) as peer:
        other.spawn(5)
        if other.welcome.lockstep:
            sequence = other.next()
            other.say(m.Despawn(sequence=sequence, character=5))  # or it would hold the others up
            other.event("despawned", sequence)
        sequence = peer.next()
        peer.say(m.Despawn(sequence=sequence, character=5))
        peer.refusal(CHARACTER_UNKNOWN, sequence)
        peer.spawn(0)
        sequence = peer.next()
        peer.say(m.Spawn(sequence=sequence, character=0))
        peer.refusal(CHARACTER_TAKEN, sequence)


def a_session_may_have_so_many_characters(dial: Dial) -> None:
    """As many as the welcome says."""
    with in_session(dial) as peer:
        welcome = peer.welcome
        for number in range(0, min(welcome.characters, 64), peer.company):
            peer.spawn(number)
        if welcome.characters <= 64:
            sequence = peer.next()
            peer.say(m.Spawn(sequence=sequence, character=64))
            peer.refusal(CHARACTERS, sequence)


def _refusal_of_a_flood(peer: Peer) -> m.Error:
    """The first one; a flood that was sent so slowly that all of it was answered is followed by another."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        for _ in range(4 * min(peer.welcome.messages_per_tick, 1024)):
            peer.say(m.Ping(nonce=1))
        while (message := peer.listen(_QUIET)) is not None:
            if isinstance(message, m.Error):
                return message
    raise Failed("all of a flood was answered")


def a_flood_is_cut_off(dial: Dial) -> None:
    """More messages within a tick than the welcome allows are refused, and the session goes on."""
    with in_session(dial) as peer:
        expect(_refusal_of_a_flood(peer).code, RATE, "error code")
        for _ in range(_TRIES):
            peer.say(m.Ping(nonce=2))
            while isinstance(message := peer.listen(_QUIET), m.Pong | m.Error):
                if isinstance(message, m.Pong) and message.nonce == 2:
                    return
        raise Failed("the session does not go on")
