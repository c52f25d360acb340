"""The recordings of a server: one for each simulation that it runs, in one folder."""

import logging
from pathlib import Path

from footwork.errors import InputError
from footwork.runtime.recorder import Recorder, new_recording
from footwork.runtime.replay import start_recording
from footwork.runtime.simulation import Simulation

log = logging.getLogger(__name__)


class Recordings:
    """Recordings under names of their own, made at the time they begin.

    Args:
        folder: where they are kept, made where it is missing; None for nowhere: nothing is recorded then.
        rate: shown frames a second.

    Raises:
        InputError: for a folder that cannot be made.
    """

    def __init__(self, folder: Path | None, rate: int) -> None:
        if folder is not None:
            _make(folder)
        self._folder, self._rate = folder, rate
        self._begun: list[Recorder] = []
        self._not_begun = 0

    def begin(self, simulation: Simulation) -> None:
        """Record a simulation, with nobody in it yet, until its ``end_recording``.

        Raises:
            InputError: for a folder that cannot be written to.
        """
        if self._folder is not None:
            self._begun.append(start_recording(simulation, new_recording(self._folder), rate=self._rate))

    def go_on(self, simulation: Simulation) -> None:
        """``begin`` while the server runs: where that cannot be, it is logged and counted, and nothing is recorded."""
        try:
            self.begin(simulation)
        except InputError as error:
            log.error("nothing is recorded from now on: %s", error)
            self._not_begun += 1

    def wait(self) -> None:
        """Wait until all, which were ended, are on the disk."""
        for recorder in self._begun:
            recorder.wait()

    @property
    def errors(self) -> int:
        """How many could not be begun, or written to their end."""
        return self._not_begun + sum(recorder.errors for recorder in self._begun)

    @property
    def names(self) -> list[str]:
        """The files."""
        return [str(recorder.path) for recorder in self._begun]


def _make(folder: Path) -> None:
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        problem = f"{error.strerror}, expected a folder that recordings can be written to"
        raise InputError(problem, folder) from None
