"""Log lines on stderr, as text or as one JSON object each, written by a thread of their own.

A reader of stderr that stalls holds no tick up: what does not fit in the queue is dropped, and counted.
"""

import logging
import queue
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from logging.handlers import QueueHandler

import msgspec

FORMATS = ("text", "json")
_ROOT = "footwork"
_WAITING = 10_000
_FAREWELL = 1.0
"""What waits has so many seconds to be written at the end, should the reader of stderr be slow."""
_TEXT = "%(asctime)s %(levelname)s %(message)s"


class JsonLines(logging.Formatter):
    """Time (UTC), level, where it comes from, and the message; ``exception`` where there was one."""

    def format(self, record: logging.LogRecord) -> str:
        """One JSON object, on one line."""
        line = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        if record.exc_info:
            line["exception"] = self.formatException(record.exc_info)
        return msgspec.json.encode(line).decode()


class _Dropping(QueueHandler):
    """Hands records over without waiting."""

    dropped = 0

    def prepare(self, record: logging.LogRecord) -> logging.LogRecord:
        """The record itself: its arguments are numbers and texts."""
        return record

    def enqueue(self, record: logging.LogRecord) -> None:
        """Keep a record for the thread that writes, or drop it where too many wait."""
        try:
            self.queue.put_nowait(record)
        except queue.Full:
            self.dropped += 1


def _write(waiting: queue.Queue, writer: logging.Handler) -> None:
    while (record := waiting.get()) is not None:
        writer.handle(record)


@contextmanager
def logging_to_stderr(form: str) -> Iterator[None]:
    """Write what footwork logs, from INFO on, to stderr in one of ``FORMATS``."""
    writer = logging.StreamHandler(sys.stderr)
    writer.setFormatter(JsonLines() if form == "json" else logging.Formatter(_TEXT))
    waiting: queue.Queue[logging.LogRecord | None] = queue.Queue(_WAITING)
    handler = _Dropping(waiting)
    thread = threading.Thread(target=_write, args=(waiting, writer), name="log", daemon=True)
    logger = logging.getLogger(_ROOT)
    before = logger.level, logger.propagate
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    logger.propagate = False
    thread.start()
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.setLevel(before[0])
        logger.propagate = before[1]
        with suppress(queue.Full):
            waiting.put(None, timeout=_FAREWELL)
            thread.join(_FAREWELL)
        if handler.dropped:
            print(f"footwork: {handler.dropped} log lines were dropped", file=sys.stderr)
