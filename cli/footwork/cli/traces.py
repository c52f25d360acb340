"""Recorded players named on the command line: a trace, or a folder of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.motion.trace import Trace


def read_traces(place: Path) -> list[Trace]:
    """The trace, or all CSV files of the folder by name.

    Raises:
        InputError: for a folder without CSV files, and for what ``read_trace`` refuses.
    """
    from footwork.motion.trace import read_trace

    paths = sorted(place.glob("*.csv")) if place.is_dir() else [place]
    if not paths:
        raise InputError("no CSV files in it, expected at least one trace", place)
    return [read_trace(path) for path in paths]
