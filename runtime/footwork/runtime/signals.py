"""A server that does as its process is told: end with a bye, or read its bundle again."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from footwork.runtime.server import Server

ENDINGS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def answering_signals(server: Server, reload: Callable[[], None] | None = None) -> Iterator[None]:
    """Stop the server at SIGINT or SIGTERM, call ``reload`` at SIGHUP; on the main thread, around ``server.run()``."""
    handlers = {number: lambda *_: server.stop() for number in ENDINGS}
    if reload is not None and hasattr(signal, "SIGHUP"):
        handlers[signal.SIGHUP] = lambda *_: reload()
    before = {number: signal.signal(number, handler) for number, handler in handlers.items()}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
