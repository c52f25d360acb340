"""``footwork serve`` in a process of its own, as any user would start it."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from footwork.cli.output import compiling
from footwork.errors import FootworkError

_STOP_SECONDS = 20.0
_LISTENING = "listening on "


class Served:
    """A server that runs from now on.

    Args:
        bundle: what it serves.
        rate: frames a second.
        options: further ones of the command.

    Attributes:
        address: where it listens.
        summary: what it said when it was stopped.

    Raises:
        FootworkError: where it does not start.
    """

    def __init__(self, bundle: Path, rate: int, options: Sequence[str] = ()) -> None:
        serve = [sys.executable, "-m", "footwork.cli.main", "serve", str(bundle), "--rate", str(rate), "--json"]
        command = [*serve, *options]
        self._process = subprocess.Popen(  # noqa: S603 our own command
            [*command, "--bind", "tcp://127.0.0.1:0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,  # an interrupt at the terminal is ours; we stop it then
        )
        self._complaints: deque[str] = deque(maxlen=50)
        try:
            with compiling():
                self.address = self._listening()
        except BaseException:  # an interrupt too
            self._process.kill()
            raise
        self._reader = threading.Thread(target=self._complaints.extend, args=(self._process.stderr,), daemon=True)
        self._reader.start()
        self.summary: dict[str, Any] = {}

    def _listening(self) -> str:
        for line in self._process.stderr:  # type: ignore[union-attr]
            if line.startswith(_LISTENING):
                return line.removeprefix(_LISTENING).strip()
            self._complaints.append(line)
        self._process.wait()
        raise FootworkError(f"the server did not start: {self._said or 'it said nothing'}")

    @property
    def _said(self) -> str:
        return "".join(self._complaints).strip()

    def require_running(self) -> None:
        """Nothing where it runs.

        Raises:
            FootworkError: with what it said, where it has ended.
        """
        if self._process.poll() is not None:
            raise FootworkError(f"the server ended: {self._said or 'it said nothing'}")

    def stop(self) -> None:
        """End it and take its summary.

        Raises:
            FootworkError: where it does not end or had failed.
        """
        self._process.terminate()
        try:
            self._process.wait(_STOP_SECONDS)
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise FootworkError(f"the server did not stop within {_STOP_SECONDS:g} s") from None
        self._reader.join(1.0)
        if self._process.returncode != 0:
            raise FootworkError(f"the server failed: {self._said}")
        self.summary = json.loads(self._process.stdout.read())  # type: ignore[union-attr]


@contextmanager
def serving(bundle: Path, rate: int, options: Sequence[str] = ()) -> Iterator[Served]:
    """A server for as long as the block lasts; being told to end, or losing the terminal, ends the block."""
    with _interrupted_by("SIGTERM", "SIGHUP"):
        server = Served(bundle, rate, options)
        try:
            yield server
        finally:
            server.stop()


@contextmanager
def _interrupted_by(*names: str) -> Iterator[None]:
    """Take signals as an interrupt, so that nothing that was started is left behind."""
    numbers = [getattr(signal, name) for name in names if hasattr(signal, name)]
    before = [signal.signal(number, signal.default_int_handler) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)
