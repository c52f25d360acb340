"""A connection to a Dask scheduler that is made, and left, in bounded time."""

import asyncio
import logging
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Thread
from typing import Any
from urllib.parse import urlsplit

from footwork.errors import InputError

try:
    from distributed import Client
except ImportError:
    raise InputError("Dask is not installed, expected it: pip install 'footwork[scale]'", "--backend") from None

ANSWER = 10.0  # seconds in which a scheduler has to answer
_LOGGERS = ("distributed.client", "distributed.core", "distributed.comm", "tornado.application", "asyncio")


@contextmanager
def connected(address: str) -> Iterator[tuple[Client, asyncio.AbstractEventLoop]]:
    """Dask's client of the scheduler at ``address``, and the event loop that it lives on.

    The loop runs on a thread of ours, as the client's own blocking calls may wait for ever.

    Raises:
        InputError: for an address that is none, or where no scheduler answers.
    """
    _require_address(address)
    with _quiet(), _event_loop() as loop:
        client = _connect(address, loop)
        try:
            yield client, loop
        finally:
            with suppress(Exception):  # the scheduler may be gone, and there is nothing left to wait for
                _run(client.close(), loop)


async def _started(address: str) -> Client:
    client = Client(address, asynchronous=True, timeout=ANSWER, set_as_default=False, name="footwork")
    try:
        return await client
    except BaseException:
        client.status = "closed"  # or it tries to leave a scheduler that it never met
        raise


def _connect(address: str, loop: asyncio.AbstractEventLoop) -> Client:
    try:
        return _run(_started(address), loop)
    except Exception as error:  # there may be anything at that address
        problem = f"no Dask scheduler answers within {ANSWER:g} s, expected one: dask scheduler"
        raise InputError(problem, address) from error


def _run(question: Any, loop: asyncio.AbstractEventLoop) -> Any:
    future = asyncio.run_coroutine_threadsafe(question, loop)
    try:
        return future.result(ANSWER)
    finally:
        future.cancel()


@contextmanager
def _event_loop() -> Iterator[asyncio.AbstractEventLoop]:
    """An event loop that runs on a thread of its own."""
    loop = asyncio.new_event_loop()
    thread = Thread(target=loop.run_forever, name="dask", daemon=True)
    thread.start()
    try:
        yield loop
    finally:
        asyncio.run_coroutine_threadsafe(_cancel_all(), loop)
        thread.join(ANSWER)


async def _cancel_all() -> None:
    """End whatever still runs on this loop, and the loop."""
    loop, this = asyncio.get_running_loop(), asyncio.current_task()
    tasks = [task for task in asyncio.all_tasks() if task is not this]
    for task in tasks:
        task.cancel()
    await asyncio.wait(tasks, timeout=1.0) if tasks else None
    loop.call_soon(loop.stop)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask from telling of broken connections with tracebacks: errors say it in one line."""
    loggers = [logging.getLogger(name) for name in _LOGGERS]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def _require_address(address: str) -> None:
    try:
        parts = urlsplit(address)
        valid = parts.scheme in ("tcp", "tls") and parts.hostname and parts.port and not parts.path.strip("/")
    except ValueError:
        valid = False
    if not valid:
        raise InputError(f"{address!r} is no address, expected tcp://HOST:PORT or tls://HOST:PORT", "--scheduler")
