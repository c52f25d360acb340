"""Bundles replaced under a running server: read and checked on a thread of its own, put in place between two ticks.

A replacement that cannot be read, is damaged or has another body is told of in the log, and the old one goes on. The
new bundle is read into memory, or mapped from a copy of the servers' own, so that whatever becomes of the file changes
nothing.
"""

import logging
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Self

from footwork.errors import FootworkError
from footwork.motion.bundle import Bundle, read_bundle
from footwork.runtime.server import Server
from footwork.runtime.simulation import Simulation
from footwork.runtime.succession import Succession, require_same_body

log = logging.getLogger(__name__)

_LOOK_EVERY = 0.2


class Reloader:
    """Reads a server's bundles again, for as long as it is entered.

    Args:
        server: whose it is.
        paths: the bundles' files, by name.
        read: how to read it.
        watch: read one whenever its file has changed, beside all when asked.
    """

    def __init__(
        self,
        server: Server,
        paths: Mapping[str, Path],
        *,
        read: Callable[[Path], Bundle] = read_bundle,
        watch: bool = False,
    ) -> None:
        self._server = server
        self._paths = dict(paths)
        self._read = read
        self._watch = watch
        self._asked = False
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="reload", daemon=True)
        self._seen = {name: _look(path) for name, path in self._paths.items()}

    def ask(self) -> None:
        """Read all again soon; safe from any thread and from a signal handler."""
        self._asked = True

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *exception: object) -> None:
        self._ending.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._ending.wait(_LOOK_EVERY):
            asked, self._asked = self._asked, False
            for name in self._paths:
                if asked or (self._watch and self._changed(name)):
                    self._reload(name)

    def _changed(self, name: str) -> bool:
        """Whether the file is another than when last looked at; not while there is none."""
        now = _look(self._paths[name])
        changed = now is not None and now != self._seen[name]
        self._seen[name] = now or self._seen[name]
        return changed

    def _succession_to(self, bundle: Bundle, former: Simulation) -> Succession:
        """All of what takes long; a bundle of another body is refused before anything is made of it."""
        require_same_body(former.world.graph.skeleton, bundle.graph.skeleton)
        return Succession(former, self._server.simulate(bundle))

    def _reload(self, name: str) -> None:
        former, path = self._server.scenes[name].simulation, self._paths[name]
        try:
            bundle = self._read(path)
            if bundle.digest == former.bundle.digest:
                log.info("the bundle is the one that is served: %s", path)
            else:
                self._server.succeed(self._succession_to(bundle, former))
        except FootworkError as error:
            log.error("the old bundle goes on, the new one cannot take its place: %s", error)
        except Exception:
            log.exception("the old bundle goes on, the new one cannot take its place")


def _look(path: Path) -> object:
    """What tells a file from the one that was there before; None where there is none."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns, status.st_size
