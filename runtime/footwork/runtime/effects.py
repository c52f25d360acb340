"""How the messages of a session take effect on its characters, at the tick that they are for."""

from collections.abc import Callable, Collection, Iterable
from typing import Any, cast

from msgspec import UNSET

from footwork.controllers.command import Command, UnknownBehaviour, UnknownSpeed
from footwork.protocol import messages as m
from footwork.protocol.errors import (
    BEHAVIOUR,
    CHARACTER_TAKEN,
    CHARACTER_UNKNOWN,
    CHARACTERS,
    OPPONENT,
    SPEED,
    PeerError,
)
from footwork.runtime.arena import Arena
from footwork.runtime.limits import Limits
from footwork.runtime.session import Character, Sequenced, Session
from footwork.runtime.simulation import Simulation

JUMP = "jump"


class Effects:
    """Messages onto a simulation.

    Args:
        simulation: the world that the characters live in.
        limits: how many characters a session may have.
        find_room: whether there is room for another character, if need be in place of one that nobody needs.
    """

    def __init__(self, simulation: Simulation, limits: Limits, find_room: Callable[[], bool]) -> None:
        self._simulation = simulation
        self._limits = limits
        self._find_room = find_room
        self._by_type: dict[type, Callable[[Session, Any], Iterable[m.Event]]] = {
            m.Spawn: self._spawn,
            m.Command: self._command,
            m.Correct: self._correct,
            m.Teleport: self._teleport,
            m.Despawn: self._despawn,
        }

    def apply(self, session: Session, message: Sequenced) -> Iterable[m.Event]:
        """Let a message take effect; the events to tell of it.

        Raises:
            PeerError: for a message that cannot; nothing has changed then.
        """
        try:
            return self._by_type[type(message)](session, message)
        except UnknownBehaviour as error:
            raise PeerError(BEHAVIOUR, error.problem, message.sequence, self._simulation.behaviours) from None
        except UnknownSpeed as error:
            raise PeerError(SPEED, error.problem, message.sequence, self._simulation.vocabulary.with_speed) from None

    def _event(self, kind: str, message: Sequenced, number: int, opponent: int | None = None) -> m.Event:
        other = UNSET if opponent is None else opponent
        tick = self._simulation.tick + 1
        return m.Event(tick=tick, kind=kind, character=number, sequence=message.sequence, opponent=other)

    def _spawn(self, session: Session, message: m.Spawn) -> Iterable[m.Event]:
        number, sequence = message.character, message.sequence
        most = self._limits.session_characters
        if number in session.characters:
            raise PeerError(CHARACTER_TAKEN, f"character {number} is there already", sequence)
        if len(session.characters) + self._simulation.company > most:
            raise PeerError(CHARACTERS, f"the session has its {most} characters already", sequence)
        if not self._find_room():
            raise PeerError(CHARACTERS, "the server has all the characters it takes", sequence)
        slot = self._simulation.spawn(message.x, message.z, message.yaw, message.behaviour)
        session.characters[number] = Character(slot, sequence)
        if not isinstance(self._simulation, Arena):
            return (self._event("spawned", message, number),)
        opponent = _unused(session.characters)
        session.characters[number].opponent = opponent
        there = self._simulation.opponent_of(slot)
        session.characters[opponent] = Character(there, sequence, opponent=number, steered=False)
        pairs = (number, opponent), (opponent, number)
        return tuple(self._event("spawned", message, one, other) for one, other in pairs)

    def _command(self, session: Session, message: m.Command) -> Iterable[m.Event]:
        character = self._steered(session, message)
        self._simulation.give(character.slot, self._read(message))
        character.acknowledge(message.sequence)
        return ()

    def _read(self, message: m.Command) -> Command:
        vocabulary = self._simulation.vocabulary
        if message.keys is None:
            # The message's own check lets none through that lacks either.
            return vocabulary.outright(cast(float, message.heading), cast(str, message.behaviour), message.speed)
        keys = message.keys
        return vocabulary.of_keys(keys.view_yaw, keys.forward, keys.strafe, keys.run, JUMP if keys.jump else "")

    def _correct(self, session: Session, message: m.Correct) -> Iterable[m.Event]:
        character = self._character(session, message)
        self._simulation.correct(character.slot, message.x, message.z, message.yaw)
        character.acknowledge(message.sequence)
        return (self._event("corrected", message, message.character),)

    def _teleport(self, session: Session, message: m.Teleport) -> Iterable[m.Event]:
        character = self._character(session, message)
        self._simulation.teleport(character.slot, message.x, message.z, message.yaw)
        character.acknowledge(message.sequence)
        return (self._event("teleported", message, message.character),)

    def _despawn(self, session: Session, message: m.Despawn) -> Iterable[m.Event]:
        character = self._steered(session, message)
        self._simulation.remove(character.slot)
        leave = [message.character] if character.opponent is None else [message.character, character.opponent]
        for number in leave:
            del session.characters[number]
        return tuple(self._event("despawned", message, number) for number in leave)

    def _steered(self, session: Session, message: m.Command | m.Despawn) -> Character:
        character = self._character(session, message)
        if not character.steered:
            problem = f"character {message.character} is the opponent of {character.opponent}, and decides for itself"
            raise PeerError(OPPONENT, problem, message.sequence)
        return character

    def _character(self, session: Session, message: m.Command | m.Correct | m.Teleport | m.Despawn) -> Character:
        character = session.characters.get(message.character)
        if character is None:
            numbers = ", ".join(map(str, sorted(session.characters))) or "none"
            problem = f"no character {message.character}, the session has {numbers}"
            raise PeerError(CHARACTER_UNKNOWN, problem, message.sequence)
        return character


def _unused(numbers: Collection[int]) -> int:
    """The lowest number that is not among some."""
    return next(number for number in range(len(numbers) + 1) if number not in numbers)
