"""One run of the reproduction: row after row, the page and the numbers written again after each."""

import os
import time
from collections.abc import Sequence
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

from footwork.errors import FootworkError
from footwork.study.reproduction import outputs
from footwork.study.reproduction.motion_sets import MotionSets
from footwork.study.reproduction.outcome import Outcome, Status, report_of
from footwork.study.reproduction.page import page_of
from footwork.study.reproduction.registry import chosen_rows
from footwork.study.reproduction.row import Row
from footwork.study.reproduction.workbench import Progress, Workbench
from footwork.training.memory import peak_rss_mb


def reproduce(
    motions: Path,
    out: Path,
    *,
    traces: Path | None = None,
    only: Sequence[str] = (),
    quick: bool = False,
    progress: Progress | None = None,
) -> dict[str, Any]:
    """Make the rows again and write ``index.html`` and ``reproduction.json`` into a folder.

    A row that fails is reported as such, and the others go on. What is written is whole after every row, so a run
    that is interrupted leaves the rows it had finished.

    Args:
        motions: folder of the three sets (``motion_sets.MotionSets``).
        out: folder to write into, made if need be.
        traces: folder of recorded players' traces, for rows that replay them.
        only: names of rows, or letters of papers; all rows for none.
        quick: leave out what takes minutes.
        progress: told what is being done and the share of all rows that is done.

    Returns:
        What ``reproduction.json`` holds.

    Raises:
        InputError: for motions that lack a set or a table, a name that is no row, a folder that cannot be written.
    """
    rows = chosen_rows(only)
    run = _Run(rows, MotionSets(motions), outputs.prepared(out), traces, quick, progress)
    try:
        run.all_rows()
    finally:
        run.write()
    return run.report


class _Run:
    """A run under way: what became of its rows so far."""

    def __init__(
        self,
        rows: Sequence[Row],
        motions: MotionSets,
        out: Path,
        traces: Path | None,
        quick: bool,
        progress: Progress | None,
    ) -> None:
        self.outcomes = [Outcome(row) for row in rows]
        self.started, self.out, self.done = time.perf_counter(), out, 0
        self.progress: Progress = progress or (lambda what, share: None)
        self.bench = Workbench(motions, traces=traces, quick=quick, progress=self.tell)

    def tell(self, what: str, share: float) -> None:
        """Pass on what a row does as a share of all rows."""
        self.progress(what, (self.done + share) / len(self.outcomes))

    def all_rows(self) -> None:
        """Make one row after the other, writing what there is after each."""
        for number, outcome in enumerate(self.outcomes):
            self.done = number
            self.tell(outcome.row.name, 0.0)
            self.outcomes[number] = self._made(outcome)
            self.write()

    def _made(self, outcome: Outcome) -> Outcome:
        started = time.perf_counter()
        try:
            result = outcome.row.run(self.bench)
        except FootworkError as error:
            made = replace(outcome, status=Status.FAILED, error=str(error))
        except Exception as error:  # a fault in one row must not cost the others
            made = replace(outcome, status=Status.FAILED, error=f"{type(error).__name__}: {error}")
        else:
            made = replace(outcome, status=Status.DONE, result=result)
        return replace(made, seconds=time.perf_counter() - started)

    def write(self) -> None:
        """Write the page and the numbers as far as they have come."""
        about = self.about()
        self.report = report_of(self.outcomes, about)
        outputs.write(self.out, page_of(self.outcomes, about), self.report)

    def about(self) -> dict[str, Any]:
        """What there is to say of the run as a whole."""
        states = [outcome.status for outcome in self.outcomes]
        options = " --quick" if self.bench.quick else ""
        return {
            "version": version("footwork"),
            "command": f"footwork reproduce --motions {self.bench.motions.folder} --out {self.out}{options}",
            "quick": self.bench.quick,
            "complete": Status.WAITING not in states,
            "failed": [outcome.row.name for outcome in self.outcomes if outcome.status is Status.FAILED],
            "verdicts": {outcome.row.name: outcome.verdict for outcome in self.outcomes},
            "cores": os.cpu_count(),
            "seconds": round(time.perf_counter() - self.started, 3),
            "peak_rss_mb": round(peak_rss_mb(), 1),
            "attribution": self.bench.attribution(),
        }
