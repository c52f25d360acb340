"""What every subcommand prints: one JSON object or a table on stdout, progress on stderr."""

import json
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TypeGuard

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

Report = Callable[[str, float], None]
_SOON_SECONDS = 5.0


def emit(report: Mapping[str, object], as_json: bool, title: str) -> None:
    """Print ``report`` on stdout, as one JSON object or as a table of its fields."""
    if as_json:
        print(json.dumps(report, allow_nan=False), flush=True)
        return
    console = Console(markup=False)  # a path or a key may hold brackets
    console.print(_fields(report, title))
    for name, value in report.items():
        if _is_rows(value):
            across, down = _rows(value, name), _rows(value, name, lying=True)
            lies = _width(down, console) <= console.width < _width(across, console)
            console.print(down if lies else across)


def _is_rows(value: object) -> TypeGuard[Sequence[Mapping[str, object]]]:
    return isinstance(value, list) and bool(value) and all(isinstance(row, Mapping) for row in value)


def _fields(report: Mapping[str, object], title: str) -> Table:
    table = Table(title=title, show_header=False, title_justify="left")
    for name, value in _flattened(report):
        table.add_row(name, value)
    return table


def _rows(rows: Sequence[Mapping[str, object]], title: str, *, lying: bool = False) -> Table:
    """A table of a list of records, one a line, without what is nested inside them: --json has it all.

    A lying table has a column for each record instead, which is narrower where a record has many fields.
    """
    lines = [dict(_flattened({k: v for k, v in row.items() if not isinstance(v, Mapping)})) for row in rows]
    names = list(dict.fromkeys(name for line in lines for name in line))
    cells = [names, *([line.get(name, "") for name in names] for line in lines)]
    head, *body = [*zip(*cells, strict=True)] if lying else cells
    table = Table(*head, title=title, title_justify="left")
    for line in body:
        table.add_row(*line)
    return table


def _width(table: Table, console: Console) -> int:
    """Columns of the terminal that a table needs without breaking any cell."""
    return console.measure(table, options=console.options.update(max_width=10_000)).maximum


def _flattened(report: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Names and printed values of all but the lists of records, those of inner records joined by dots."""
    for name, value in report.items():
        if isinstance(value, Mapping):
            yield from _flattened(value, f"{prefix}{name}.")
        elif not _is_rows(value):
            yield f"{prefix}{name}", f"{value:.4g}" if isinstance(value, float) else str(value)


def log(message: str) -> None:
    """Print a line for a person on stderr."""
    print(message, file=sys.stderr, flush=True)


@contextmanager
def compiling(tell: Callable[[str], object] = log) -> Iterator[None]:
    """Say why it takes so long where the block, which compiles what was not compiled yet, is not over soon."""
    said = threading.Timer(_SOON_SECONDS, tell, ["compiling for this machine: the first start takes a minute or two"])
    said.daemon = True
    said.start()
    try:
        yield
    finally:
        said.cancel()


@contextmanager
def progress() -> Iterator[Report]:
    """A bar on stderr where a person watches; yields ``report(what is being done, share of it done)``."""
    columns = (TextColumn("{task.description:<20}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda what, share: bar.update(task, description=what, completed=share)
