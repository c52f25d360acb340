"""What every subcommand prints: one JSON object or a table on stdout, progress on stderr."""

import json
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

Report = Callable[[str, float], None]


def emit(report: Mapping[str, object], as_json: bool, title: str) -> None:
    """Print ``report`` on stdout, as one JSON object or as a table of its fields."""
    if as_json:
        print(json.dumps(report, allow_nan=False), flush=True)
        return
    table = Table(title=title, show_header=False, title_justify="left")
    for name, value in _flattened(report):
        table.add_row(name, value)
    Console().print(table)


def _flattened(report: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, str]]:
    for name, value in report.items():
        if isinstance(value, Mapping):
            yield from _flattened(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", f"{value:.4g}" if isinstance(value, float) else str(value)


def log(message: str) -> None:
    """Print a line for a person on stderr."""
    print(message, file=sys.stderr, flush=True)


@contextmanager
def progress() -> Iterator[Report]:
    """A bar on stderr where a person watches; yields ``report(what is being done, share of it done)``."""
    columns = (TextColumn("{task.description:<20}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda what, share: bar.update(task, description=what, completed=share)
