"""The recordings of a server: one for each simulation that it runs, in one folder."""

import logging
from collections import deque
from pathlib import Path

from footwork.errors import InputError
from footwork.runtime.recorder import Recorder, new_recording
from footwork.runtime.replay import start_recording
from footwork.runtime.simulation import Simulation

log = logging.getLogger(__name__)

MOST_NAMES = 256


class Recordings:
    """Recordings under names of their own, made at the time they begin.

    Args:
        folder: where they are kept, made where it is missing; None for nowhere: nothing is recorded then.
        rate: shown frames a second.

    Attributes:
        names: the files, of many the latest.

    Raises:
        InputError: for a folder that cannot be made.
    """

    def __init__(self, folder: Path | None, rate: int) -> None:
        if folder is not None:
            _make(folder)
        self._folder, self._rate = folder, rate
        self._writing: list[Recorder] = []
        self._failed = 0
        self.names: deque[str] = deque(maxlen=MOST_NAMES)

    def begin(self, name: str, simulation: Simulation) -> None:
        """Record a simulation, with nobody in it yet, until its ``end_recording``.

        Args:
            name: of its bundle, for the file's name; empty to leave it out.
            simulation: what is recorded.

        Raises:
            InputError: for a folder that cannot be written to.
        """
        if self._folder is not None:
            self._forget_written()
            recorder = start_recording(simulation, new_recording(self._folder, name), rate=self._rate)
            self._writing.append(recorder)
            self.names.append(str(recorder.path))

    def _forget_written(self) -> None:
        self._failed += sum(recorder.errors for recorder in self._writing if recorder.written)
        self._writing = [recorder for recorder in self._writing if not recorder.written]

    def go_on(self, name: str, simulation: Simulation) -> None:
        """``begin`` while the server runs: where that cannot be, it is logged and counted, and nothing is recorded."""
        try:
            self.begin(name, simulation)
        except InputError as error:
            log.error("nothing is recorded from now on: %s", error)
            self._failed += 1

    def wait(self) -> None:
        """Wait until all, which were ended, are on the disk."""
        for recorder in self._writing:
            recorder.wait()

    @property
    def errors(self) -> int:
        """How many could not be begun, or written to their end."""
        return self._failed + sum(recorder.errors for recorder in self._writing)


def _make(folder: Path) -> None:
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        problem = f"{error.strerror}, expected a folder that recordings can be written to"
        raise InputError(problem, folder) from None
