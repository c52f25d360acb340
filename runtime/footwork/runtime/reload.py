"""A bundle replaced under a running server: read and checked on a thread of its own, put in place between two ticks.

A replacement that cannot be read, is damaged or has another body is told of in the log, and the old one goes on. The
new bundle is read into memory, or mapped from a copy of the servers' own, so that whatever becomes of the file changes
nothing.
"""

import logging
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Self

from footwork.errors import FootworkError
from footwork.motion.bundle import Bundle, read_bundle
from footwork.runtime.server import Server
from footwork.runtime.succession import Succession, require_same_body

log = logging.getLogger(__name__)

_LOOK_EVERY = 0.2


class Reloader:
    """Reads a server's bundle again, for as long as it is entered.

    Args:
        server: whose it is.
        path: the bundle's file.
        read: how to read it.
        watch: read it whenever the file has changed, beside when asked.
    """

    def __init__(
        self, server: Server, path: Path, *, read: Callable[[Path], Bundle] = read_bundle, watch: bool = False
    ) -> None:
        self._server = server
        self._path = path
        self._read = read
        self._watch = watch
        self._asked = False
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="reload", daemon=True)
        self._seen = self._look()

    def ask(self) -> None:
        """Read it again soon; safe from any thread and from a signal handler."""
        self._asked = True

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *exception: object) -> None:
        self._ending.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._ending.wait(_LOOK_EVERY):
            if self._asked or (self._watch and self._changed()):
                self._asked = False
                self._reload()

    def _look(self) -> object:
        try:
            status = self._path.stat()
        except OSError:
            return None
        return status.st_ino, status.st_mtime_ns, status.st_size

    def _changed(self) -> bool:
        """Whether the file is another than when last looked at; not while there is none."""
        now = self._look()
        changed = now is not None and now != self._seen
        self._seen = now or self._seen
        return changed

    def _succession_to(self, bundle: Bundle) -> Succession:
        """All of what takes long; a bundle of another body is refused before anything is made of it."""
        former = self._server.simulation
        require_same_body(former.world.graph.skeleton, bundle.graph.skeleton)
        return Succession(former, self._server.simulate(bundle))

    def _reload(self) -> None:
        try:
            bundle = self._read(self._path)
            if bundle.digest == self._server.simulation.bundle.digest:
                log.info("the bundle is the one that is served: %s", self._path)
            else:
                self._server.succeed(self._succession_to(bundle))
        except FootworkError as error:
            log.error("the old bundle goes on, the new one cannot take its place: %s", error)
        except Exception:
            log.exception("the old bundle goes on, the new one cannot take its place")
