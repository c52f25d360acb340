"""One client: its state, its inbox by tick, its characters and what was acknowledged. No socket here."""

from collections.abc import Iterator
from dataclasses import dataclass

from footwork.protocol import messages as m
from footwork.protocol.connection import Connection, Role
from footwork.protocol.errors import RATE, STALE, TICK, PeerError
from footwork.runtime.limits import Limits

Sequenced = m.Spawn | m.Command | m.Correct | m.Despawn


@dataclass
class Character:
    """A client's character in the world.

    Args:
        slot: its place in the world's arrays.
        acknowledged: highest sequence of its messages that took effect.
    """

    slot: int
    acknowledged: int = 0

    def acknowledge(self, sequence: int) -> None:
        """Note that a message took effect; one that waited for a later tick does not lower the number."""
        self.acknowledged = max(self.acknowledged, sequence)


class Session:
    """What a server knows of one client.

    Args:
        peer: the transport's name for the client.
        limits: how much it may ask for.
        now: monotonic nanoseconds.
    """

    def __init__(self, peer: bytes, limits: Limits, now: int) -> None:
        self.peer = peer
        self.connection = Connection(Role.SERVER)
        self.characters: dict[int, Character] = {}
        self.heard = now
        self._limits = limits
        self._inbox: dict[int, list[Sequenced]] = {}
        self._sequence = 0
        self._taken = 0

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
        if self._taken > self._limits.messages_per_tick:
            raise PeerError(RATE, f"more than {self._limits.messages_per_tick} messages within a tick")
        message = self.connection.receive(data)
        self.heard = now
        if not isinstance(message, Sequenced):
            return message  # type: ignore[return-value]  # the table lets only a client's messages through
        self._keep(message, tick)
        return None

    def _keep(self, message: Sequenced, tick: int) -> None:
        if message.sequence <= self._sequence:
            problem = f"sequence {message.sequence}, expected above {self._sequence}"
            raise PeerError(STALE, problem, message.sequence)
        due = max(tick + 1, getattr(message, "tick", 0))
        last = tick + 1 + self._limits.ahead_ticks
        if due > last:
            raise PeerError(TICK, f"tick {due}, expected at most {last}", message.sequence)
        self._sequence = message.sequence
        self._inbox.setdefault(due, []).append(message)

    def due(self, tick: int) -> Iterator[Sequenced]:
        """Take out what is for ``tick`` or earlier, in order, and begin to count the next tick's messages."""
        self._taken = 0
        for waiting in sorted(key for key in self._inbox if key <= tick):
            yield from self._inbox.pop(waiting)

    def idle(self, now: int) -> bool:
        """Whether the client has been silent for too long."""
        return now - self.heard > self._limits.idle_seconds * 1e9
