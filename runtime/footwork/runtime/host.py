"""Sessions and one simulation: messages come in, messages go out; no socket, no clock.

The server drives it by the clock and a ROUTER socket; tests drive it by hand.
"""

import logging
from collections.abc import Iterator

import msgspec

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_client, encode
from footwork.protocol.errors import NO_SESSION, SESSIONS, VERSION, PeerError
from footwork.protocol.pose_arrays import packed
from footwork.runtime.effects import Effects
from footwork.runtime.greeting import welcome_of
from footwork.runtime.limits import Limits
from footwork.runtime.session import Session
from footwork.runtime.simulation import Simulation

log = logging.getLogger(__name__)

Outgoing = tuple[bytes, bytes]  # peer, message


class Host:
    """All sessions of a server.

    Args:
        simulation: the world that their characters live in.
        frame_rate: shown frames a second, a whole number of times the tick rate.
        limits: how much clients may ask for.

    Raises:
        LocalError: for a bundle that the wire cannot hold.
    """

    def __init__(self, simulation: Simulation, frame_rate: int, limits: Limits) -> None:
        self.simulation = simulation
        self.limits = limits
        self.sessions: dict[bytes, Session] = {}
        self.sessions_begun = 0
        self.refused = 0
        self._frames = frame_rate // m.TICK_RATE
        self._effects = Effects(simulation, limits)
        self._welcome = welcome_of(simulation.bundle, simulation.behaviours, 0, frame_rate, limits)
        self._outbox: list[Outgoing] = []
        self._told: dict[bytes, int] = {}

    def receive(self, peer: bytes, data: bytes, now: int) -> None:
        """Take what a peer sent at ``now``, monotonic nanoseconds; answers wait in the outbox."""
        session = self.sessions.get(peer)
        try:
            if session is None:
                self._greet(peer, decode_from_client(data), now)
            else:
                self._answer(session, session.receive(data, self.simulation.tick, now))
        except PeerError as error:
            self.refuse(peer, error)

    def _greet(self, peer: bytes, message: m.FromClient, now: int) -> None:
        if not isinstance(message, m.Hello):
            problem = f"{type(message).__name__.lower()} without a session, expected hello"
            raise PeerError(NO_SESSION, problem, getattr(message, "sequence", 0))
        if message.version != m.PROTOCOL_VERSION:
            self._turn_away(peer, PeerError(VERSION, f"version {message.version}, expected {m.PROTOCOL_VERSION}"))
        elif len(self.sessions) >= self.limits.sessions:
            self._turn_away(peer, PeerError(SESSIONS, f"the server has its {self.limits.sessions} sessions already"))
        else:
            self._begin(peer, message, now)

    def _begin(self, peer: bytes, hello: m.Hello, now: int) -> None:
        session = self.sessions[peer] = Session(peer, self.limits, now)
        session.connection.receive(encode(hello))
        self._send(session, msgspec.structs.replace(self._welcome, tick=self.simulation.tick))
        self.sessions_begun += 1
        log.info("session %s of %r begins", peer.hex(), hello.client)

    def _answer(self, session: Session, message: m.FromClient | None) -> None:
        if isinstance(message, m.Ping):
            self._send(session, m.Pong(nonce=message.nonce, tick=self.simulation.tick))
        elif isinstance(message, m.Bye):
            self.forget(session.peer, "its own bye")

    def refuse(self, peer: bytes, error: PeerError) -> bool:
        """Tell a peer what was wrong, unless it (or too many others) were told often enough within this tick."""
        self.refused += 1
        told = self._told.get(peer, 0)
        crowded = told == 0 and len(self._told) >= 4 * self.limits.sessions
        if crowded or told >= self.limits.errors_per_tick:
            return False
        self._told[peer] = told + 1
        reply = m.Error(code=error.code, message=error.problem, sequence=error.sequence, valid=error.valid)
        self._outbox.append((peer, encode(reply)))
        return True

    def _turn_away(self, peer: bytes, error: PeerError) -> None:
        if self.refuse(peer, error):
            self._outbox.append((peer, encode(m.Bye(reason=error.code))))

    def end(self, peer: bytes, reason: str) -> None:
        """Say bye to a session and forget it."""
        self._send(self.sessions[peer], m.Bye(reason=reason))
        self.forget(peer, reason)

    def end_all(self, reason: str) -> None:
        """Say bye to all."""
        for peer in list(self.sessions):
            self.end(peer, reason)

    def end_idle(self, now: int) -> None:
        """Say bye to those that were silent for too long."""
        for peer in [session.peer for session in self.sessions.values() if session.idle(now)]:
            self.end(peer, "idle")

    def forget(self, peer: bytes, reason: str) -> None:
        """Drop a session, where there is one, and take its characters out of the world."""
        session = self.sessions.pop(peer, None)
        if session is None:
            return
        for character in session.characters.values():
            self.simulation.remove(character.slot)
        log.info("session %s ends: %s", peer.hex(), reason)

    def tick(self) -> None:
        """Let what is due take effect, then make one tick."""
        self._told.clear()
        for session in self.sessions.values():
            for message in session.due(self.simulation.tick + 1):
                try:
                    event = self._effects.apply(session, message)
                except PeerError as error:
                    self.refuse(session.peer, error)
                else:
                    if event is not None:
                        self._send(session, event)
        self.simulation.step()

    def outgoing(self) -> list[Outgoing]:
        """Answers that waited, oldest first; they wait no more."""
        outbox, self._outbox = self._outbox, []
        return outbox

    def poses(self, frame: int) -> Iterator[Outgoing]:
        """Poses of all characters at shown frame ``frame`` = 1, 2 ... frame_rate / 30 of the tick."""
        shown = self.simulation.show(frame / self._frames)
        tick = self.simulation.tick
        for session in list(self.sessions.values()):  # whoever sends these may find a session gone
            for number, character in session.characters.items():
                slot = character.slot
                pose = m.Pose(
                    tick=tick,
                    frame=frame,
                    character=number,
                    acknowledged=character.acknowledged,
                    facing=shown.facing[slot].item(),
                    behaviour=shown.behaviour[slot].item(),
                    clip=shown.clip[slot].item(),
                    source_frame=shown.source_frame[slot].item(),
                    transition=shown.transition[slot].item(),
                    root=packed(shown.root[slot]),
                    rotations=packed(shown.rotations[slot]),
                )
                yield session.peer, encode(pose)

    def _send(self, session: Session, message: m.FromServer) -> None:
        self._outbox.append((session.peer, session.connection.send(message)))
