"""What goes to and fro between the sessions of a host and the transport."""

import logging

from footwork.motion.tick import TICK_RATE
from footwork.protocol.codec import encode
from footwork.protocol.errors import MALFORMED, PeerError
from footwork.protocol.messages import Bye
from footwork.runtime.clock import SECOND, now_ns
from footwork.runtime.delivery import Delivery
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.router import Router, Sent
from footwork.runtime.scene import Scene

log = logging.getLogger(__name__)

_RETRY_MS = 2
"""How often what the transport did not take is offered again."""
_STALL = SECOND
"""For how long nobody may listen before it counts as a stall, such as that of a process that was stopped."""
_STRANGERS_WAIT = 10 * SECOND
"""For how long a last message is offered to a peer whose session is over."""


class Exchange:
    """Takes messages to a host and brings what it has to say to its peers.

    Args:
        host: whose sessions they are.
        router: the transport.
        limits: how much may wait for a session that does not read.

    Attributes:
        pulse: when messages were last listened for, monotonic nanoseconds.
    """

    def __init__(self, host: Host, router: Router, limits: Limits) -> None:
        self.pulse = now_ns()
        self._host = host
        self._router = router
        self._delivery = Delivery(router.send, host.sessions.__contains__, limits.waiting_messages)

    @property
    def dropped(self) -> int:
        """Poses that were dropped for clients which read too slowly."""
        return self._delivery.dropped

    @property
    def patience(self) -> int:
        """How long to listen without looking elsewhere, milliseconds."""
        return _RETRY_MS if self._delivery.waiting else 1000 // TICK_RATE

    def take(self, end: int) -> None:
        """Take messages until there are none for now; no longer than to ``end``, so that no flood holds a tick up."""
        self.beat()
        self._take_waiting(end)

    def wait(self, most: int) -> None:
        """Wait for a message for as long as ``patience``, then take what there is, for at most ``most`` nanoseconds."""
        parts = self._router.next(self.patience)
        self.beat()  # a process is nearly always stopped while it waits: what came meanwhile is taken after that
        if parts is not None:
            self._take(parts)
            self._take_waiting(now_ns() + most)

    def _take_waiting(self, end: int) -> None:
        while now_ns() < end and (parts := self._router.receive()) is not None:
            self._take(parts)

    def _take(self, parts: list[bytes]) -> None:
        if len(parts) == 2:
            self._host.receive(parts[0], parts[1], now_ns())
        else:
            self._host.refuse(parts[0], PeerError(MALFORMED, "more or fewer parts than the one expected"))

    def beat(self) -> None:
        """Note that somebody listens; after a stall no client is held to what it did, or did not do, meanwhile."""
        missed, self.pulse = now_ns() - self.pulse, now_ns()
        if missed > _STALL:
            log.warning("nobody listened for %.1f s: was the process stopped?", missed / SECOND)
            self._host.forgive(missed)
            self._router.connections.forgive(missed)

    def say(self) -> None:
        """Hand over what the host has to say."""
        for peer, data in self._host.outgoing():
            sent = self._delivery.tell(peer, data)
            if sent is Sent.GONE:
                self._lose(peer)
            elif sent is Sent.DROPPED and peer in self._host.sessions:
                self._end_slow(peer)

    def show(self, frame: int) -> None:
        """Hand over the poses of a shown frame."""
        lost = self._delivery.begin_frame()
        for peer, number, pose in self._host.poses(frame, lost):
            if self._delivery.show(peer, number, pose) is Sent.GONE:
                self._lose(peer)

    def retry(self) -> None:
        """Offer again what the transport did not take."""
        if self._delivery.waiting:
            for peer in self._delivery.retry():
                self._lose(peer)
            self._delivery.forget_strangers(now_ns(), _STRANGERS_WAIT)

    def look_around(self) -> None:
        """Cut connections that misbehave, lose sessions whose connection is gone."""
        self._router.look()
        for peer in self._router.gone():
            self._lose(peer)

    def outdate(self, scene: Scene) -> None:
        """Send no more of the poses that wait for the clients of a scene: they are of a bundle that goes."""
        for session in self._host.playing(scene):
            self._delivery.outdate(session.peer)

    def _end_slow(self, peer: bytes) -> None:
        """End a session that reads nothing; its bye takes the place of what waits for it."""
        self._host.forget(peer, "slow")
        self._delivery.say_last(peer, encode(Bye(reason="slow")))

    def _lose(self, peer: bytes) -> None:
        self._delivery.forget(peer)
        self._host.lose(peer, now_ns())
