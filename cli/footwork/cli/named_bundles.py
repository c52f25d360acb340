"""Bundles as they are given on the command line: files, or NAME=FILE."""

import re
from collections.abc import Iterable
from pathlib import Path

from footwork.errors import InputError
from footwork.runtime.scenes import is_name

_NAME_LENGTH = 64


def named_bundles(given: Iterable[str]) -> dict[str, Path]:
    """The files by the names that clients call them by, in order.

    Raises:
        InputError: for none at all, and for two of one name.
    """
    named: dict[str, Path] = {}
    for text in given:
        name, path = _named(text)
        if name in named:
            raise InputError(f"{named[name]} and {path} are both called {name}, expected NAME=FILE", "bundles")
        named[name] = path
    if not named:
        raise InputError("none, expected the file of at least one", "bundles")
    return named


def _named(text: str) -> tuple[str, Path]:
    name, equals, file = text.partition("=")
    if equals and is_name(name) and file:
        return name, Path(file)
    return _name_of(Path(text)), Path(text)


def _name_of(path: Path) -> str:
    """The file's name without its ending, with '_' for what no name may have."""
    return re.sub(r"[^A-Za-z0-9._-]", "_", path.stem)[:_NAME_LENGTH] or "_"
