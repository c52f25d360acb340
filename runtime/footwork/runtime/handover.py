"""A bundle that waits to take another's place, until the loop that makes the ticks comes round to it."""

import logging
import threading

from footwork.protocol.messages import Welcome
from footwork.runtime.exchange import Exchange
from footwork.runtime.host import Host
from footwork.runtime.recordings import Recordings
from footwork.runtime.succession import Succession

log = logging.getLogger(__name__)

_LOOK_EVERY = 0.01


class Handover:
    """Hands one simulation's characters over to another, between two ticks.

    Args:
        host: whose simulations they are.
        exchange: to and from its clients.
        recordings: of those simulations, each of which has its own.

    Attributes:
        count: how many bundles took another's place.
    """

    def __init__(self, host: Host, exchange: Exchange, recordings: Recordings) -> None:
        self.count = 0
        self._host = host
        self._exchange = exchange
        self._recordings = recordings
        self._waiting: tuple[Succession, Welcome] | None = None

    def ask(self, succession: Succession, ended: threading.Event) -> None:
        """Wait until it was made, or the server has ended; for another thread than the one that makes ticks.

        Raises:
            LocalError: for a bundle that the wire cannot hold; the old one goes on.
        """
        name = self._host.scenes.playing(succession.former).name
        self._waiting = (succession, self._host.scenes.welcome_for(name, succession.latter))
        while self._waiting is not None and not ended.wait(_LOOK_EVERY):
            pass

    def make(self) -> None:
        """Let the bundle that waits, if there is one, take over."""
        if self._waiting is None:
            return
        succession, welcome = self._waiting
        former, latter = succession.former, succession.latter
        latter.tick = former.tick
        self._recordings.go_on(welcome.bundle, latter)
        self._exchange.outdate(self._host.scenes[welcome.bundle])
        self._host.succeed(succession, welcome)
        former.end_recording()
        self._waiting = None
        self.count += 1
        log.info("bundle %s is served as %s from now on", latter.bundle.digest[:12], welcome.bundle)
