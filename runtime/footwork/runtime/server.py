"""The server: a socket, a clock and a host of sessions.

Between two deadlines it only listens. At a deadline it takes what has come in so far, lets it take effect, makes the
tick and sends the poses; a command that came in before a deadline is acknowledged by that tick's first pose.
"""

import threading
import time
from collections.abc import Callable
from typing import Any

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.tick import TICK_RATE
from footwork.protocol.errors import MALFORMED, PeerError
from footwork.runtime.clock import SECOND, FrameClock, now_ns
from footwork.runtime.collector import collect_young, held_collector
from footwork.runtime.host import Host
from footwork.runtime.limits import Limits
from footwork.runtime.ring import Ring
from footwork.runtime.router import DEFAULT_BIND, Router, Sent
from footwork.runtime.simulation import Simulation

RATES = (30, 60, 120)
_MILLISECOND = 1_000_000
_GRACE = 8
"""At a deadline, what has come in is taken for up to this part of a frame period, should there be so much of it."""
_FAREWELL = 0.5


class Server:
    """Serves a bundle on a ROUTER socket.

    A tick is late if its first poses leave more than one frame period after its deadline.

    Args:
        bundle: what characters are made of.
        bind: where to listen; port 0 or ``*`` takes any free one, told by ``address``.
        rate: shown frames a second, 30, 60 or 120; at 30n the new tick is shown at 1/n, 2/n ... 1.
        limits: how much clients may ask for.
        inertialise: whether transitions are smoothed.

    Raises:
        InputError: for another rate, an address that cannot be bound or a bundle without a steering table.
        LocalError: for a bundle that the wire cannot hold.
    """

    def __init__(
        self,
        bundle: Bundle,
        *,
        bind: str = DEFAULT_BIND,
        rate: int = 60,
        limits: Limits | None = None,
        inertialise: bool = True,
    ) -> None:
        if rate not in RATES:
            raise InputError(f"{rate} frames a second, expected one of {RATES}", "rate")
        limits = limits or Limits()
        self.rate = rate
        self.ticks = 0
        self.late_ticks = 0
        self.dropped = 0
        self.tick_us = Ring()
        self.lateness_us = Ring()
        self._host = Host(Simulation(bundle, limits.characters, inertialise=inertialise), rate, limits)
        self._router = Router(bind)
        self._clock = FrameClock(rate, now_ns())
        self._stopping = False
        self._ended = threading.Event()

    @property
    def address(self) -> str:
        """Where it listens, with the port that was taken."""
        return self._router.address

    def run(self, until: Callable[[], bool] | None = None) -> None:
        """Serve until ``stop`` is called or ``until()``, asked before every frame, is true; then say bye and close.

        It can be run once.
        """
        try:
            with held_collector():
                self._loop(until)
        finally:
            self.close()

    def close(self) -> None:
        """Say bye to all and let go of the socket; ``run`` does so when it ends."""
        self._host.end_all("shutdown")
        self._flush()
        self._router.close(linger=_FAREWELL)
        self._ended.set()

    def stop(self) -> None:
        """End ``run`` within a frame; safe from any thread and from a signal handler."""
        self._stopping = True

    def wait(self, seconds: float) -> bool:
        """Whether ``run`` has ended, waiting for it for at most so long."""
        return self._ended.wait(seconds)

    def summary(self) -> dict[str, Any]:
        """What happened so far: ticks, lateness, times in microseconds, sessions, and what was refused or dropped."""
        return {
            "ticks": self.ticks,
            "late_ticks": self.late_ticks,
            "tick_us": {"p50": self.tick_us.percentile(50), "p99": self.tick_us.percentile(99)},
            "sessions": self._host.sessions_begun,
            "refused": self._host.refused,
            "dropped": self.dropped,
            "skipped_frames": self._clock.skipped,
        }

    def _loop(self, until: Callable[[], bool] | None) -> None:
        self._clock = FrameClock(self.rate, now_ns() + SECOND // self.rate)
        frames = self.rate // TICK_RATE
        work = 0
        frame = 1
        while not (self._stopping or (until is not None and until())):
            self._listen(self._clock.deadline)
            work += self._show(frame)
            if frame == frames:
                self.tick_us.add(work / 1000.0)
                work = 0
                self._tidy()
            frame = frame % frames + 1
            self._clock.advance(now_ns())

    def _listen(self, deadline: int) -> None:
        """Take messages as they come until the deadline, then what is left of those that came before it."""
        while (left := deadline - now_ns()) > 0:
            if left < _MILLISECOND:
                time.sleep(left / SECOND)
            elif self._router.poll(left // _MILLISECOND):
                self._drain(deadline)
                self._flush()
        self._drain(now_ns() + self._clock.period // _GRACE)

    def _drain(self, end: int) -> None:
        """Take messages until there are none for now; no longer than to ``end``, so that no flood holds a tick up."""
        while now_ns() < end and (parts := self._router.receive()) is not None:
            if len(parts) == 2:
                self._host.receive(parts[0], parts[1], now_ns())
            else:
                self._host.refuse(parts[0], PeerError(MALFORMED, "more or fewer parts than the one expected"))

    def _show(self, frame: int) -> int:
        """Make the tick if its first frame is due, send the frame's poses; nanoseconds that took."""
        start = now_ns()
        self.lateness_us.add((start - self._clock.deadline) / 1000.0)
        if frame == 1:
            self._host.end_idle(start)
            self._host.tick()
        self._flush()
        for peer, data in self._host.poses(frame):
            self._send(peer, data)
        done = now_ns()
        if frame == 1:
            self.ticks += 1
            self.late_ticks += done > self._clock.deadline + self._clock.period
        return done - start

    def _flush(self) -> None:
        for peer, data in self._host.outgoing():
            self._send(peer, data)

    def _send(self, peer: bytes, data: bytes) -> None:
        sent = self._router.send(peer, data)
        if sent is Sent.DROPPED:
            self.dropped += 1
        elif sent is Sent.GONE:
            self._host.forget(peer, "the connection is gone")

    def _tidy(self) -> None:
        if self.ticks % TICK_RATE == 0:
            collect_young()
