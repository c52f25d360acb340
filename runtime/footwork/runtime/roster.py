"""The sessions of a server: those of a client that is there, and those that wait for theirs to come back."""

from collections.abc import Iterable

from footwork.protocol.errors import RESUME, PeerError
from footwork.runtime.limits import Limits
from footwork.runtime.scene import Scene
from footwork.runtime.session import Session


class Roster:
    """Sessions by peer, and by token those whose connection is gone.

    Args:
        limits: how many sessions there may be, and for how long one waits.

    Attributes:
        here: those with a connection, by peer.
    """

    def __init__(self, limits: Limits) -> None:
        self.here: dict[bytes, Session] = {}
        self._limits = limits
        self._by_token: dict[bytes, Session] = {}
        self._away: dict[bytes, int] = {}  # token -> until when, in order

    @property
    def full(self) -> bool:
        """Whether there is no room for another."""
        return len(self._by_token) >= self._limits.sessions

    @property
    def all(self) -> Iterable[Session]:
        """Those that are here and those that wait."""
        return self._by_token.values()

    def begin(self, peer: bytes, scene: Scene, now: int) -> Session:
        """A new session of a peer, where there is room."""
        session = self.here[peer] = Session(peer, scene, self._limits, now)
        self._by_token[session.token] = session
        return session

    def resume(self, peer: bytes, token: bytes, now: int) -> tuple[Session, bytes | None]:
        """The session of a token, with another connection from now on, and the peer that had it so far, if any.

        Raises:
            PeerError: ``resume``, for a token that no session has.
        """
        session = self._by_token.get(token)
        if session is None:
            raise PeerError(RESUME, "no session waits for this token, say hello without it")
        waited = self._away.pop(token, None) is not None
        former = None if waited else session.peer
        if former is not None:
            del self.here[former]
        session.resume(peer, now)
        self.here[peer] = session
        return session, former

    def part(self, peer: bytes, now: int) -> Session | None:
        """Let the session of a peer that is gone wait to be resumed, if it has one."""
        session = self.here.pop(peer, None)
        if session is not None:
            self._away[session.token] = now + round(self._limits.resume_seconds * 1e9)
        return session

    def remove(self, peer: bytes) -> Session | None:
        """Take out the session of a peer, if it has one."""
        session = self.here.pop(peer, None)
        if session is not None:
            del self._by_token[session.token]
        return session

    def give_up_overdue(self, now: int) -> list[Session]:
        """Take out those that have waited for long enough."""
        return [self._give_up(token) for token in [token for token, until in self._away.items() if now > until]]

    def give_up_oldest(self) -> Session | None:
        """Take out the one that has waited for longest, if any waits."""
        return self._give_up(next(iter(self._away))) if self._away else None

    def forgive(self, nanoseconds: int) -> None:
        """Wait longer for those that are away."""
        for token in self._away:
            self._away[token] += nanoseconds

    def _give_up(self, token: bytes) -> Session:
        del self._away[token]
        return self._by_token.pop(token)
