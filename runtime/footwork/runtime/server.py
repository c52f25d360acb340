"""The server: a socket, a clock and a host of sessions.

Between two deadlines it only listens. At a deadline it takes what has come in so far, lets it take effect, makes the
tick and sends the poses; a command that came in before a deadline is acknowledged by that tick's first pose. In
lock-step there are no deadlines: it only listens, and makes a tick as soon as its clients have asked for it.
"""

import logging
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import zmq

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.tick import TICK_RATE
from footwork.protocol.messages import Welcome
from footwork.runtime.clock import SECOND, FrameClock, now_ns
from footwork.runtime.collector import collect_young, held_collector
from footwork.runtime.exchange import Exchange
from footwork.runtime.gallery import Gallery
from footwork.runtime.histogram import Histogram
from footwork.runtime.host import Host
from footwork.runtime.key_folder import KeyFolder
from footwork.runtime.limits import Limits
from footwork.runtime.recordings import Recordings
from footwork.runtime.ring import Ring
from footwork.runtime.router import DEFAULT_BIND, Router
from footwork.runtime.simulation import Simulation
from footwork.runtime.succession import Succession

log = logging.getLogger(__name__)

RATES = (30, 60, 120)
_MILLISECOND = 1_000_000
_GRACE = 8
"""At a deadline, what has come in is taken for up to this part of a frame period, should there be so much of it."""
_FAREWELL = 0.5
_LOCK_STEP_TIDY = 1000
"""Ticks in lock-step from one collection of garbage to the next, should there be no pause before."""


class Server:
    """Serves a bundle on a ROUTER socket.

    A tick is late if its first poses leave more than one frame period after its deadline.

    Args:
        bundle: what characters are made of.
        bind: where to listen; port 0 or ``*`` takes any free one, told by ``address``.
        rate: shown frames a second, 30, 60 or 120; at 30n the new tick is shown at 1/n, 2/n ... 1.
        limits: how much clients may ask for.
        inertialise: whether transitions are smoothed.
        lockstep: make no tick by a clock, but each once all clients with characters have asked for it.
        spectate: where spectators may watch all characters, nowhere unless given; told by ``gallery_address``.
        keys: let in only clients whose CURVE keys are in this folder; without it whoever reaches the address.
        record: a folder that what takes effect is recorded in, nowhere unless given.

    Raises:
        InputError: for another rate, an address that cannot be bound, a folder that cannot be written to or a bundle
            without a steering table.
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
        lockstep: bool = False,
        spectate: str | None = None,
        keys: KeyFolder | None = None,
        record: Path | None = None,
    ) -> None:
        if rate not in RATES:
            raise InputError(f"{rate} frames a second, expected one of {RATES}", "rate")
        limits = limits or Limits()
        self.rate = rate
        self.ticks = self.late_ticks = self.reloads = 0
        self.tick_us = Ring()
        self.lateness_us = Ring()
        self.tick_seconds = Histogram()
        self.pulse = now_ns()
        self.simulate = partial(Simulation, capacity=limits.characters, inertialise=inertialise)
        self._host = Host(self.simulate(bundle), rate, limits, lockstep=lockstep)
        self._recordings = Recordings(record, rate)
        # Half a second of one character's poses, but no fewer than two frames of all that a session may have.
        queue = max(rate // 2, 2 * limits.session_characters)
        self._router = Router(bind, keys=keys, most=limits.connections, send_queue=queue)
        self._gallery = None if spectate is None else self._open_gallery(spectate, limits)
        self._exchange = Exchange(self._host, self._router, limits)
        self._clock = FrameClock(rate, now_ns())
        self._stopping = False
        self._succession: tuple[Succession, Welcome] | None = None
        self._ended = threading.Event()
        try:
            self._recordings.begin(self.simulation)
        except InputError:
            self.close()
            raise

    @property
    def address(self) -> str:
        """Where it listens, with the port that was taken."""
        return self._router.address

    @property
    def simulation(self) -> Simulation:
        """What is being served."""
        return self._host.simulation

    def succeed(self, succession: Succession) -> None:
        """Let another bundle take over between two ticks, and wait until it has; for another thread than ``run``'s.

        Raises:
            LocalError: for a bundle that the wire cannot hold; the old one goes on.
        """
        self._succession = (succession, self._host.welcome_for(succession.latter))
        while self._succession is not None and not self._ended.wait(0.01):
            pass

    @property
    def gallery_address(self) -> str | None:
        """Where spectators may watch, if anywhere."""
        return None if self._gallery is None else self._gallery.address

    def _open_gallery(self, bind: str, limits: Limits) -> Gallery:
        socket = self._router.socket(zmq.XPUB)
        try:
            return Gallery(socket, bind, queue=2 * limits.characters, most=limits.connections)
        except InputError:
            socket.close(linger=0)
            self._router.close()
            raise

    def run(self, until: Callable[[], bool] | None = None) -> None:
        """Serve until ``stop`` is called or ``until()``, asked before every frame, is true; then say bye and close.

        It can be run once.
        """
        try:
            with held_collector():
                self._step_in_lock(until) if self._host.lockstep else self._loop(until)
        finally:
            self.close()

    def close(self) -> None:
        """Say bye to all and let go of the socket; ``run`` does so when it ends."""
        self._host.end_all("shutdown")
        self._exchange.say()
        if self._gallery is not None:
            self._gallery.close()
        self._router.close(linger=_FAREWELL)
        self.simulation.end_recording()
        self._recordings.wait()
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
            "resumed": self._host.resumed,
            "refused": self._host.refused,
            "dropped": self._exchange.dropped,
            "cut": self._router.connections.cut,
            "denied": self._router.denied,
            "skipped_frames": self._clock.skipped,
            "reloads": self.reloads,
            "recordings": self._recordings.names,
            "recording_errors": self._recordings.errors,
            "bytes_in": self._router.bytes_in,
            "bytes_out": self._router.bytes_out,
        }

    def population(self) -> dict[str, int]:
        """How many there are of each just now."""
        return {
            "open_sessions": len(self._host.sessions),
            "connections": len(self._router.connections),
            "characters": len(self.simulation.world.slots),
        }

    def _loop(self, until: Callable[[], bool] | None) -> None:
        self._clock = FrameClock(self.rate, now_ns() + SECOND // self.rate)
        frames = self.rate // TICK_RATE
        work = 0
        frame = 1
        while not (self._stopping or (until is not None and until())):
            self._listen(self._clock.deadline)
            self.pulse = now_ns()
            work += self._show(frame)
            if frame == frames:
                self._note(work)
                work = 0
                self._tidy()
            frame = frame % frames + 1
            self._clock.advance(now_ns())

    def _listen(self, deadline: int) -> None:
        """Take messages as they come until the deadline, then what is left of those that came before it."""
        while (left := deadline - now_ns()) > 0:
            if left < _MILLISECOND:
                time.sleep(left / SECOND)
            elif self._router.poll(min(left // _MILLISECOND, self._exchange.patience)):
                self._exchange.take(deadline)
                self._exchange.say()
            self._exchange.retry()
        self._exchange.take(now_ns() + self._clock.period // _GRACE)

    def _show(self, frame: int) -> int:
        """Make the tick if its first frame is due, send the frame's poses; nanoseconds that took."""
        start = now_ns()
        self.lateness_us.add((start - self._clock.deadline) / 1000.0)
        if frame == 1:
            self._host.end_overdue(start)
            self._host.tick()
        self._exchange.say()
        self._exchange.show(frame)
        self._exchange.retry()
        self._let_watch(frame)
        done = now_ns()
        if frame == 1:
            self.ticks += 1
            self.late_ticks += done > self._clock.deadline + self._clock.period
        return done - start

    def _step_in_lock(self, until: Callable[[], bool] | None) -> None:
        """Listen, and make each tick as soon as all have asked for it."""
        renewed = now_ns()
        while not (self._stopping or (until is not None and until())):
            if self._router.poll(self._exchange.patience):
                self._exchange.take(now_ns() + SECOND // TICK_RATE)
            self._make_steps()
            self._exchange.retry()
            if now_ns() - renewed > SECOND // TICK_RATE:
                renewed = self.pulse = now_ns()
                self._host.count_anew()
                self._host.end_overdue(renewed)
                self._exchange.look_around()
                if self._gallery is not None:
                    self._gallery.look()
                self._hand_over()

    def _note(self, nanoseconds: int) -> None:
        """Note how long a tick and its poses took."""
        self.tick_us.add(nanoseconds / 1000.0)
        self.tick_seconds.add(nanoseconds / SECOND)

    def _make_steps(self) -> None:
        self._exchange.say()
        start = now_ns()
        while not self._stopping and self._host.step():
            self._exchange.say()
            self._let_watch(self.rate // TICK_RATE)
            done = now_ns()
            self._note(done - start)
            self.ticks += 1
            if self.ticks % _LOCK_STEP_TIDY == 0:
                collect_young()
            start = now_ns()

    def _let_watch(self, frame: int) -> None:
        if self._gallery is not None:
            self._gallery.show(self._host.simulation, self._host.welcome, frame)

    def _hand_over(self) -> None:
        """Let the bundle that waits to be served take over."""
        if self._succession is not None:
            former, latter = self.simulation, self._succession[0].latter
            latter.tick = former.tick
            self._recordings.go_on(latter)
            self._host.succeed(*self._succession)
            former.end_recording()
            self._succession = None
            self.reloads += 1
            log.info("bundle %s is served from now on", self.simulation.bundle.digest[:12])

    def _tidy(self) -> None:
        self._exchange.look_around()
        self._hand_over()
        if self.ticks % TICK_RATE == 0:
            collect_young()
