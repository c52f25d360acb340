"""Checks of servers that bring an opponent with each character; others pass them."""

from collections.abc import Iterator
from contextlib import contextmanager

from msgspec import UNSET

from footwork.protocol import messages as m
from footwork.protocol.compliance.peer import Dial, Peer, expect, in_session
from footwork.protocol.errors import OPPONENT


@contextmanager
def _watching(dial: Dial) -> Iterator[Peer]:
    with in_session(dial) as peer:
        peer.watches = True
        yield peer


def _spawned(peer: Peer, character: int) -> int:
    """Put a character into the world; the number of its opponent."""
    own = peer.spawn(character)
    other = peer.hear(m.Event)
    told = (other.kind, other.sequence, other.opponent, own.opponent)
    expect(told, ("spawned", own.sequence, character, other.character), "what is told of the opponent")
    return other.character


def an_opponent_comes_with_a_character(dial: Dial) -> None:
    """Two events, each with the other's number, and poses of both with their health and stamina."""
    with _watching(dial) as peer:
        if peer.company > 1:
            expected = {7, _spawned(peer, 7)}
            poses = [peer.pose(), peer.pose()]
            expect({pose.character for pose in poses}, expected, "characters shown")
            expect([(pose.health, pose.stamina) for pose in poses], [(1.0, 1.0)] * 2, "health and stamina")


def an_opponent_decides_for_itself(dial: Dial) -> None:
    """Commands to it and its despawn are refused; with the character that it fights it leaves."""
    with _watching(dial) as peer:
        if peer.company == 1:
            return
        other = _spawned(peer, 7)
        keys, despawn = m.Keys(view_yaw=0.0, forward=1), m.Despawn(sequence=peer.next() + 1, character=other)
        for message in (m.Command(sequence=despawn.sequence - 1, character=other, keys=keys), despawn):
            peer.say(message)
            peer.refusal(OPPONENT, message.sequence)
        peer.next()
        sequence = peer.next()
        peer.say(m.Despawn(sequence=sequence, character=7))
        left = [peer.event("despawned", sequence), peer.event("despawned", sequence)]
        expect([event.character for event in left], [7, other], "characters that left")


def who_does_not_fight_has_no_health(dial: Dial) -> None:
    """Where no opponents come, what tells of fights is left out."""
    with _watching(dial) as peer:
        if peer.company == 1:
            event, pose = peer.spawn(), peer.pose()
            told = (event.opponent, pose.health, pose.stamina, peer.welcome.opponents)
            expect(told, (UNSET,) * 4, "opponent, health, stamina and opponents")
