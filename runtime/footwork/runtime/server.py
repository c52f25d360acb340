"""The server: a socket, a clock and a host of sessions.

Between two deadlines it only listens. At a deadline it takes what has come in so far, lets it take effect, makes the
tick and sends the poses; a command that came in before a deadline is acknowledged by that tick's first pose. In
lock-step there are no deadlines: it only listens, and makes a tick as soon as its clients have asked for it.
"""

import threading
import time
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.tick import TICK_RATE
from footwork.runtime.arena import Arena
from footwork.runtime.clock import SECOND, FrameClock, now_ns
from footwork.runtime.collector import collect_young, held_collector
from footwork.runtime.exchange import Exchange
from footwork.runtime.gallery import open_gallery
from footwork.runtime.handover import Handover
from footwork.runtime.histogram import Histogram
from footwork.runtime.host import Host
from footwork.runtime.key_folder import KeyFolder
from footwork.runtime.limits import Limits
from footwork.runtime.opponent import Opponent
from footwork.runtime.recordings import Recordings
from footwork.runtime.ring import Ring
from footwork.runtime.router import DEFAULT_BIND, Router
from footwork.runtime.scene import Scene
from footwork.runtime.scenes import ONLY, Scenes, require_names
from footwork.runtime.simulation import Simulation
from footwork.runtime.succession import Succession

RATES = (30, 60, 120)
_MILLISECOND = 1_000_000
_GRACE = 8
"""At a deadline, what has come in is taken for up to this part of a frame period, should there be so much of it."""
_FAREWELL = 0.5
_LOCK_STEP_TIDY = 1000
"""Ticks in lock-step from one collection of garbage to the next, should there be no pause before."""


class Server:
    """Serves a bundle, or several, on a ROUTER socket.

    A tick is late if its first poses leave more than one frame period after its deadline.

    Args:
        bundle: what characters are made of; of several each under its name, the first for clients that name none.
        bind: where to listen; port 0 or ``*`` takes any free one, told by ``address``.
        rate: shown frames a second, 30, 60 or 120; at 30n the new tick is shown at 1/n, 2/n ... 1.
        limits: how much clients may ask for, of all bundles together.
        inertialise: whether transitions are smoothed.
        lockstep: make no tick by a clock, but each once all clients with characters have asked for it.
        spectate: where spectators may watch all characters, nowhere unless given; told by ``gallery_address``.
        keys: let in only clients whose CURVE keys are in this folder; without it whoever reaches the address.
        record: a folder that what takes effect is recorded in, nowhere unless given.
        opponent: who comes with each character, to fight it; nobody unless given.

    Raises:
        InputError: for another rate, a name that is none, an address that cannot be bound, a folder that cannot be
            written to, a bundle without a steering table or, with opponents, one that nobody can fight with.
        LocalError: for a bundle that the wire cannot hold.
    """

    def __init__(
        self,
        bundle: Bundle | Mapping[str, Bundle],
        *,
        bind: str = DEFAULT_BIND,
        rate: int = 60,
        limits: Limits | None = None,
        inertialise: bool = True,
        lockstep: bool = False,
        spectate: str | None = None,
        keys: KeyFolder | None = None,
        record: Path | None = None,
        opponent: Opponent | None = None,
    ) -> None:
        if rate not in RATES:
            raise InputError(f"{rate} frames a second, expected one of {RATES}", "rate")
        limits = limits or Limits()
        self.rate = rate
        bundles = bundle if isinstance(bundle, Mapping) else {ONLY: bundle}
        require_names(bundles)
        self.ticks = self.late_ticks = 0
        self.tick_us = Ring()
        self.lateness_us = Ring()
        self.tick_seconds = Histogram()
        kind = Simulation if opponent is None else partial(Arena, opponent=opponent)
        self.simulate = partial(kind, capacity=limits.characters, inertialise=inertialise)
        simulations = {name: self.simulate(each) for name, each in bundles.items()}
        self._host = Host(simulations, rate, limits, lockstep=lockstep)
        self._recordings = Recordings(record, rate)
        # Half a second of one character's poses, but no fewer than two frames of all that a session may have.
        queue = max(rate // 2, 2 * limits.session_characters)
        self._router = Router(bind, keys=keys, most=limits.connections, send_queue=queue)
        self._gallery = None if spectate is None else open_gallery(self._router, spectate, limits)
        self._exchange = Exchange(self._host, self._router, limits)
        self._clock = FrameClock(rate, now_ns())
        self._stopping = False
        self._handover = Handover(self._host, self._exchange, self._recordings)
        self._ended = threading.Event()
        try:
            for scene in self.scenes:
                self._recordings.begin(scene.name, scene.simulation)
        except InputError:
            self.close()
            raise

    @property
    def address(self) -> str:
        """Where it listens, with the port that was taken."""
        return self._router.address

    @property
    def scenes(self) -> Scenes:
        """What is being served."""
        return self._host.scenes

    @property
    def simulation(self) -> Simulation:
        """That of the first bundle."""
        return self._host.simulation

    @property
    def pulse(self) -> int:
        """When its loop last went round, monotonic nanoseconds."""
        return self._exchange.pulse

    @property
    def reloads(self) -> int:
        """How many bundles took another's place."""
        return self._handover.count

    def succeed(self, succession: Succession) -> None:
        """Let a bundle take another's place between two ticks; on another thread than ``run``'s, it waits.

        Raises:
            LocalError: for a bundle that the wire cannot hold; the old one goes on.
        """
        self._handover.ask(succession, self._ended)

    @property
    def gallery_address(self) -> str | None:
        """Where spectators may watch, if anywhere."""
        return None if self._gallery is None else self._gallery.address

    def run(self, until: Callable[[], bool] | None = None) -> None:
        """Serve until ``stop`` is called or ``until()``, asked before every frame, is true; then say bye and close.

        It can be run once.
        """
        try:
            self._exchange.pulse = now_ns()
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
        for scene in self.scenes:
            scene.simulation.end_recording()
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
            "sessions": sum(scene.sessions_begun for scene in self.scenes),
            "resumed": self._host.resumed,
            "refused": self._host.refused,
            "dropped": self._exchange.dropped,
            "cut": self._router.connections.cut,
            "denied": self._router.denied,
            "skipped_frames": self._clock.skipped,
            "reloads": self.reloads,
            "bundles": self.by_bundle(),
            "recordings": list(self._recordings.names),
            "recording_errors": self._recordings.errors,
            "bytes_in": self._router.bytes_in,
            "bytes_out": self._router.bytes_out,
        }

    def by_bundle(self) -> dict[str, dict[str, Any]]:
        """What is played under each name, and by how many."""
        return {scene.name: self._host.figures(scene) for scene in self.scenes}

    def population(self) -> dict[str, int]:
        """How many there are of each just now."""
        return {
            "open_sessions": len(self._host.sessions),
            "connections": len(self._router.connections),
            "characters": self.scenes.character_count,
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
        self._let_watch(self.scenes, frame)
        done = now_ns()
        if frame == 1:
            self.ticks += 1
            self.late_ticks += done > self._clock.deadline + self._clock.period
        return done - start

    def _step_in_lock(self, until: Callable[[], bool] | None) -> None:
        """Listen, and make each tick as soon as all have asked for it."""
        renewed = now_ns()
        while not (self._stopping or (until is not None and until())):
            self._exchange.wait(SECOND // TICK_RATE)
            self._make_steps()
            self._exchange.retry()
            if now_ns() - renewed > SECOND // TICK_RATE:
                renewed = now_ns()
                self._exchange.beat()
                self._host.count_anew()
                self._host.end_overdue(renewed)
                self._exchange.look_around()
                if self._gallery is not None:
                    self._gallery.look()
                self._handover.make()

    def _note(self, nanoseconds: int) -> None:
        """Note how long a tick and its poses took."""
        self.tick_us.add(nanoseconds / 1000.0)
        self.tick_seconds.add(nanoseconds / SECOND)

    def _make_steps(self) -> None:
        self._exchange.say()
        start = now_ns()
        while not self._stopping and (stepped := self._host.step()):
            self._exchange.say()
            self._let_watch(stepped, self.rate // TICK_RATE)
            done = now_ns()
            self._note(done - start)
            self.ticks += len(stepped)
            if self.ticks % _LOCK_STEP_TIDY == 0:
                collect_young()
            start = now_ns()

    def _let_watch(self, scenes: Iterable[Scene], frame: int) -> None:
        if self._gallery is not None:
            self._gallery.show(scenes, frame)

    def _tidy(self) -> None:
        self._exchange.look_around()
        self._handover.make()
        if self.ticks % TICK_RATE == 0:
            collect_young()
