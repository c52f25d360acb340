"""Sessions and their simulations, one a bundle: messages come in, messages go out; no socket, no clock.

The server drives it by the clock, or by its clients' steps, and a ROUTER socket; tests drive it by hand.
"""

import logging
from collections.abc import Collection, Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_client, encode
from footwork.protocol.errors import LOCK_STEP, NO_SESSION, SESSIONS, VERSION, PeerError
from footwork.runtime.clock import SECOND
from footwork.runtime.greeting import welcome_to
from footwork.runtime.happenings import happenings
from footwork.runtime.limits import Limits
from footwork.runtime.roster import Roster
from footwork.runtime.scene import Scene
from footwork.runtime.scenes import Scenes
from footwork.runtime.session import Sequenced, Session
from footwork.runtime.simulation import Simulation
from footwork.runtime.succession import Succession

log = logging.getLogger(__name__)

Outgoing = tuple[bytes, bytes]  # peer, message
ShownTo = tuple[bytes, int, bytes]  # peer, its number for the character, message
Lost = Mapping[tuple[bytes, int], int]
"""By peer and its number for a character, how many poses were dropped."""


class Host:
    """All sessions of a server.

    Args:
        simulations: the world that their characters live in, of each bundle by its name; or the only one. A hello
            that names none plays the first.
        frame_rate: shown frames a second, a whole number of times the tick rate.
        limits: how much clients may ask for.
        lockstep: whether ticks are made when clients ask for them.

    Attributes:
        scenes: what is played.
        sessions: those with a connection, by peer.

    Raises:
        LocalError: for a bundle that the wire cannot hold.
    """

    def __init__(
        self,
        simulations: Simulation | Mapping[str, Simulation],
        frame_rate: int,
        limits: Limits,
        *,
        lockstep: bool = False,
    ) -> None:
        self.limits = limits
        self.lockstep = lockstep
        self.resumed = 0
        self.refused = 0
        self._frames = frame_rate // m.TICK_RATE
        self.scenes = Scenes(simulations, frame_rate, limits, lockstep=lockstep, make_room=self._make_room)
        self._roster = Roster(limits)
        self.sessions = self._roster.here
        self._outbox: list[Outgoing] = []
        self._told: dict[bytes, int] = {}

    @property
    def simulation(self) -> Simulation:
        """That of the first bundle."""
        return self.scenes.first.simulation

    def succeed(self, succession: Succession, welcome: m.Welcome) -> None:
        """Go on in another simulation, between two ticks: its characters move over, its clients are welcomed anew."""
        latter, scene = succession.latter, self.scenes.playing(succession.former)
        for session in self._roster.all:
            if session.scene is scene:
                for character in session.characters.values():
                    character.slot, character.behaviour = succession.move(character.slot), None
        self.scenes.put(scene, latter, welcome)
        for session in self.playing(scene):
            self._send(session, welcome_to(session, welcome, latter.tick, resumed=True))

    def figures(self, scene: Scene) -> dict[str, Any]:
        """What is played in a scene, and by how many."""
        return {
            "digest": scene.simulation.bundle.digest,
            "sessions": scene.sessions_begun,
            "open_sessions": len(self.playing(scene)),
            "characters": len(scene.simulation.world.slots),
            "reloads": scene.reloads,
        }

    def playing(self, scene: Scene) -> list[Session]:
        """Those here that play a bundle."""
        return [session for session in list(self.sessions.values()) if session.scene is scene]

    def receive(self, peer: bytes, data: bytes, now: int) -> None:
        """Take what a peer sent at ``now``, monotonic nanoseconds; answers wait in the outbox."""
        session = self.sessions.get(peer)
        try:
            if session is None:
                self._greet(peer, decode_from_client(data), now)
            else:
                self._answer(session, session.receive(data, session.scene.simulation.tick, now))
        except PeerError as error:
            self.refuse(peer, error)

    def _greet(self, peer: bytes, message: m.FromClient, now: int) -> None:
        if not isinstance(message, m.Hello):
            problem = f"{type(message).__name__.lower()} without a session, expected hello"
            raise PeerError(NO_SESSION, problem, getattr(message, "sequence", 0))
        try:
            if message.version != m.PROTOCOL_VERSION:
                raise PeerError(VERSION, f"version {message.version}, expected {m.PROTOCOL_VERSION}")
            self._resume(peer, message, now) if message.resume else self._begin(peer, message, now)
        except PeerError as error:
            self._turn_away(peer, error)

    def _begin(self, peer: bytes, hello: m.Hello, now: int) -> None:
        scene = self.scenes.chosen(hello.bundle)
        if self._roster.full and not self._make_room():
            raise PeerError(SESSIONS, f"the server has its {self.limits.sessions} sessions already")
        session = self._roster.begin(peer, scene, now)
        self._welcome(session, hello, resumed=False)
        scene.sessions_begun += 1
        log.info("session %s of %r begins", peer.hex(), hello.client)

    def _resume(self, peer: bytes, hello: m.Hello, now: int) -> None:
        session, former = self._roster.resume(peer, hello.resume, now)
        if former is not None:
            self._outbox.append((former, encode(m.Bye(reason="resumed"))))
        self._welcome(session, hello, resumed=True)
        self.resumed += 1
        log.info("session %s of %r is resumed", peer.hex(), hello.client)

    def _welcome(self, session: Session, hello: m.Hello, *, resumed: bool) -> None:
        session.greet(hello)
        scene = session.scene
        self._send(session, welcome_to(session, scene.welcome, scene.simulation.tick, resumed=resumed))

    def _answer(self, session: Session, message: m.FromClient | None) -> None:
        if isinstance(message, m.Ping):
            self._send(session, m.Pong(nonce=message.nonce, tick=session.scene.simulation.tick))
        elif isinstance(message, m.Step):
            self._ask(session, message.ticks)
        elif isinstance(message, m.Bye):
            self.forget(session.peer, "its own bye")

    def _ask(self, session: Session, ticks: int) -> None:
        if not self.lockstep:
            raise PeerError(LOCK_STEP, "the server makes its ticks by a clock")
        if session.asked:
            raise PeerError(LOCK_STEP, f"{session.asked} ticks of the last step are still to be made")
        session.asked = ticks

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

    def end_overdue(self, now: int) -> None:
        """Say bye to those that were silent for too long; wait no more for those that did not come back in time."""
        for peer in [session.peer for session in self.sessions.values() if session.idle(now)]:
            self.end(peer, "idle")
        for session in self._roster.give_up_overdue(now):
            self._remove_characters(session, "its client did not come back")

    def forget(self, peer: bytes, reason: str) -> None:
        """Drop a session, where there is one, and take its characters out of the world."""
        session = self._roster.remove(peer)
        if session is not None:
            self._remove_characters(session, reason)

    def lose(self, peer: bytes, now: int) -> None:
        """Let the session of a peer whose connection is gone, where there is one, wait to be resumed."""
        session = self._roster.part(peer, now)
        if session is None:
            return
        for character in session.steered:
            session.scene.simulation.stand(character.slot)
        log.info("session %s has lost its connection", peer.hex())

    def forgive(self, nanoseconds: int) -> None:
        """Count no time as anybody's silence in which nobody could be heard."""
        self._roster.forgive(nanoseconds)
        for session in self.sessions.values():
            session.forgive(nanoseconds, nanoseconds * m.TICK_RATE // SECOND)

    def _make_room(self) -> bool:
        """Wait no more for whom was waited for longest; whether there was one."""
        session = self._roster.give_up_oldest()
        if session is not None:
            self._remove_characters(session, "its room is needed")
        return session is not None

    def _remove_characters(self, session: Session, reason: str) -> None:
        for character in session.steered:
            session.scene.simulation.remove(character.slot)
        log.info("session %s ends: %s", session.peer.hex(), reason)

    def count_anew(self) -> None:
        """Begin to count what clients may do within a tick; ``tick`` does so too."""
        self._told.clear()
        for session in self.sessions.values():
            session.count_anew()

    def tick(self) -> None:
        """Let what is due take effect, then make one tick in every simulation."""
        self._tick(self.scenes, self.sessions.values())

    def _tick(self, scenes: Iterable[Scene], sessions: Collection[Session]) -> None:
        self._told.clear()
        for session in sessions:
            for message in session.due(session.scene.simulation.tick + 1):
                self._apply(session, message)
        for scene in scenes:
            scene.simulation.step()
        for session in sessions:
            for event in happenings(session, session.scene.simulation):
                self._send(session, event)

    def _apply(self, session: Session, message: Sequenced) -> None:
        try:
            for event in session.scene.effects.apply(session, message):
                self._send(session, event)
        except PeerError as error:
            self.refuse(session.peer, error)

    def step(self) -> list[Scene]:
        """In lock-step: make a tick of each bundle for which all that have characters in it have asked; those bundles.

        Whose last one it was gets its poses at the tick's own moment, and is told.
        """
        return [scene for scene in self.scenes if self._step(scene)]

    def _step(self, scene: Scene) -> bool:
        sessions = self.playing(scene)
        asking = [session for session in sessions if session.asked]
        if not asking or any(session.characters and not session.asked for session in sessions):
            return False
        self._tick([scene], sessions)
        for session in asking:
            session.asked -= 1
        done = [session for session in asking if not session.asked]
        if done:
            self._answer_steps(scene, done)
        return True

    def _answer_steps(self, scene: Scene, sessions: list[Session]) -> None:
        scene.simulation.show(1.0)
        for peer, _, pose in self._poses(scene, sessions, self._frames, {}):
            self._outbox.append((peer, pose))
        for session in sessions:
            self._send(session, m.Stepped(tick=scene.simulation.tick))

    def outgoing(self) -> list[Outgoing]:
        """Answers that waited, oldest first; they wait no more."""
        outbox, self._outbox = self._outbox, []
        return outbox

    def poses(self, frame: int, lost: Lost = MappingProxyType({})) -> Iterator[ShownTo]:
        """The poses of all characters at shown frame ``frame`` = 1, 2 ... frame_rate / 30, which tell what was lost."""
        for scene in self.scenes:
            scene.simulation.show(frame / self._frames)
            yield from self._poses(scene, self.playing(scene), frame, lost)

    def _poses(self, scene: Scene, sessions: Iterable[Session], frame: int, lost: Lost) -> Iterator[ShownTo]:
        whose = [(session.peer, number, who) for session in sessions for number, who in session.characters.items()]
        rows = [(who.slot, number, who.acknowledged, lost.get((peer, number), 0)) for peer, number, who in whose]
        poses = scene.messages.of(rows, tick=scene.simulation.tick, frame=frame)
        return zip([peer for peer, _, _ in whose], [number for _, number, _ in whose], poses, strict=True)

    def _send(self, session: Session, message: m.FromServer) -> None:
        self._outbox.append((session.peer, session.connection.send(message)))
