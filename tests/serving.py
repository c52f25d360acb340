"""A live server of the toy bundle on loopback, on a thread of its own."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from footwork.runtime.server import Server
from toy_bundle import toy_bundle


@contextmanager
def serving(until: Callable[[], bool] | None = None, **options) -> Iterator[Server]:
    server = Server(toy_bundle(), bind="tcp://127.0.0.1:0", **options)
    thread = threading.Thread(target=server.run, args=(until,))
    thread.start()
    try:
        yield server
    finally:
        server.stop()
        thread.join(5)
        assert not thread.is_alive()
