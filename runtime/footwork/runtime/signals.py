"""A server that ends with a bye when its process is asked to end."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager

from footwork.runtime.server import Server

ENDINGS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def stopped_by_signals(server: Server) -> Iterator[None]:
    """Stop the server at SIGINT or SIGTERM; for the main thread, around ``server.run()``."""
    before = {number: signal.signal(number, lambda *_: server.stop()) for number in ENDINGS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
