"""Log lines: one JSON object each, and never a reason to wait."""

import json
import logging
import os
import time

import pytest

from footwork.runtime import logs
from footwork.runtime.logs import logging_to_stderr

LOG = logging.getLogger("footwork.tried")


def test_each_line_is_one_json_object(capsys):
    with logging_to_stderr("json"):
        LOG.info("session %s\nbegins", "ab\x1b[0m")
        try:
            raise ValueError("odd")
        except ValueError:
            LOG.exception("it failed")
    first, second = [json.loads(line) for line in capsys.readouterr().err.splitlines()]
    assert (first["level"], first["message"]) == ("info", "session ab\x1b[0m\nbegins")
    assert first["logger"] == "footwork.tried"
    assert first["time"].endswith("+00:00")
    assert "ValueError: odd" in second["exception"]


def test_text_is_for_people(capsys):
    with logging_to_stderr("text"):
        LOG.warning("mind the gap")
    assert capsys.readouterr().err.endswith("WARNING mind the gap\n")


def test_all_is_as_before_afterwards(capsys):
    parent = logging.getLogger("footwork")
    before = parent.level, parent.propagate, list(parent.handlers)
    with logging_to_stderr("text"):
        pass
    assert before == (parent.level, parent.propagate, parent.handlers)
    LOG.info("nobody hears")
    assert capsys.readouterr().err == ""


@pytest.mark.skipif(os.name != "posix", reason="needs a pipe that fills")
def test_a_reader_that_stalls_holds_nobody_up_not_even_at_the_end(monkeypatch, capsys):
    monkeypatch.setattr(logs, "_WAITING", 10)
    read, write = os.pipe()
    with os.fdopen(read) as reading, os.fdopen(write, "w") as stalled:
        monkeypatch.setattr("sys.stderr", stalled)
        with logging_to_stderr("text"):
            for _ in range(1000):  # far more than the pipe holds
                LOG.info("x" * 1000)
            monkeypatch.undo()
            monkeypatch.setattr(logs, "_FAREWELL", 0.1)
        os.set_blocking(read, False)
        while drained(reading):
            time.sleep(0.05)
    assert "log lines were dropped" in capsys.readouterr().err


def drained(reading) -> bool:
    try:
        return bool(os.read(reading.fileno(), 1 << 20))
    except BlockingIOError:
        return False
