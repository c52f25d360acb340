"""One client: its state, its inbox by tick, its characters and what was acknowledged. No socket here."""

import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.connection import Connection, Role
from footwork.protocol.errors import RATE, STALE, TICK, PeerError
from footwork.runtime.limits import Limits

if TYPE_CHECKING:  # a scene's effects know sessions
    from footwork.runtime.scene import Scene

Sequenced = m.Spawn | m.Command | m.Correct | m.Teleport | m.Despawn
TOKEN_BYTES = 16
MOST_AFTER_A_STALL = 1024
"""Messages that may come in at once beyond a tick's, once the server listens again."""


@dataclass
class Character:
    """A client's character in the world.

    Args:
        slot: its place in the world's arrays.
        acknowledged: highest sequence of its messages that took effect.
        behaviour: the behaviour that the client was told of, none yet before its first tick.
        opponent: the number of the one that it fights, None where it fights nobody.
        steered: whether the client steers it, which it does not where it is somebody's opponent.
    """

    slot: int
    acknowledged: int = 0
    behaviour: int | None = None
    opponent: int | None = None
    steered: bool = True

    def acknowledge(self, sequence: int) -> None:
        """Note that a message took effect; one that waited for a later tick does not lower the number."""
        self.acknowledged = max(self.acknowledged, sequence)


class Session:
    """What a server knows of one client.

    Args:
        peer: the transport's name for the client.
        scene: the bundle that it plays.
        limits: how much it may ask for.
        now: monotonic nanoseconds.

    Attributes:
        token: resumes it after its connection broke.
        events: kinds of events that the client asked for.
        sequence: the highest that was taken from it.
        asked: in lock-step, how many ticks it waits for.
    """

    def __init__(self, peer: bytes, scene: "Scene", limits: Limits, now: int) -> None:
        self.peer = peer
        self.scene = scene
        self.token = secrets.token_bytes(TOKEN_BYTES)
        self.characters: dict[int, Character] = {}
        self.sequence = 0
        self._limits = limits
        self._begin(now)

    def _begin(self, now: int) -> None:
        self.connection = Connection(Role.SERVER)
        self.events: frozenset[str] = frozenset()
        self.heard = now
        self.asked = 0
        self._inbox: dict[int, list[Sequenced]] = {}
        self._taken = self._more = 0

    @property
    def steered(self) -> list[Character]:
        """The characters that the client steers: not those that are somebody's opponent."""
        return [character for character in self.characters.values() if character.steered]

    def greet(self, hello: m.Hello) -> None:
        """Take the hello of a new connection."""
        self.connection.receive(encode(hello))
        self.events = frozenset(hello.events).intersection(m.EVENTS)

    def resume(self, peer: bytes, now: int) -> None:
        """Go on with another connection; what had come in and not taken effect is dropped."""
        self.peer = peer
        self._begin(now)

    def receive(self, data: bytes, tick: int, now: int) -> m.FromClient | None:
        """The message in ``data`` if it is to be answered at once, None where it now waits in the inbox.

        Args:
            data: what came.
            tick: the tick last made.
            now: monotonic nanoseconds.

        Raises:
            PeerError: for a message that is dropped. ``rate`` is judged before the bytes are read.
        """
        self._taken += 1
        if self._taken > self._limits.messages_per_tick and not self._one_more():
            raise PeerError(RATE, f"more than {self._limits.messages_per_tick} messages within a tick")
        message = self.connection.receive(data)
        self.heard = now
        if not isinstance(message, Sequenced):
            return message  # type: ignore[return-value]  # the table lets only a client's messages through
        self._keep(message, tick)
        return None

    def _keep(self, message: Sequenced, tick: int) -> None:
        if message.sequence <= self.sequence:
            problem = f"sequence {message.sequence}, expected above {self.sequence}"
            raise PeerError(STALE, problem, message.sequence)
        due = max(tick + 1, getattr(message, "tick", 0))
        last = tick + 1 + self._limits.ahead_ticks
        if due > last:
            raise PeerError(TICK, f"tick {due}, expected at most {last}", message.sequence)
        self.sequence = message.sequence
        self._inbox.setdefault(due, []).append(message)

    def due(self, tick: int) -> Sequence[Sequenced]:
        """Take out what is for ``tick`` or earlier, in order, and begin to count the next tick's messages."""
        self.count_anew()
        if not self._inbox:
            return ()
        due = sorted([key for key in self._inbox if key <= tick])
        return [message for key in due for message in self._inbox.pop(key)]

    def count_anew(self) -> None:
        """Begin to count the messages of another tick."""
        self._taken = 0

    def _one_more(self) -> bool:
        """Use up one of the messages that came while nobody listened."""
        left = self._more > 0
        self._more -= left
        return left

    def forgive(self, nanoseconds: int, ticks: int) -> None:
        """Count neither as silence nor within a tick what passed while the server listened to nobody."""
        self.heard += nanoseconds
        self._more = min(ticks * self._limits.messages_per_tick, MOST_AFTER_A_STALL)

    def idle(self, now: int) -> bool:
        """Whether the client has been silent for too long."""
        return now - self.heard > self._limits.idle_seconds * 1e9
