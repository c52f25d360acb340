"""The sets of real capture that can be fetched: which files, from where, with which digest, under which terms.

The list lies in captures/: sources.csv, sets.toml, and tables of what the frames show and which of them to use. No
capture is part of the package.
"""

import csv
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from urllib.parse import quote

from footwork.errors import InputError

FOLDER = Path(__file__).parent / "captures"
TABLES = ("labels.csv", "core_ranges.csv")
"""What frames show, and which parts of the files the published experiments are about."""
ORIGIN = "https://raw.githubusercontent.com"


@dataclass(frozen=True)
class CaptureFile:
    """One file.

    Args:
        name: its name within its set.
        place: its address under the origin.
        size: bytes.
        sha256: hexadecimal.
    """

    name: str
    place: str
    size: int
    sha256: str


@dataclass(frozen=True)
class CaptureSet:
    """Files that belong together, a folder once fetched.

    Args:
        name: of the set.
        about: what it shows.
        files: of capture, skeletons included.
        licences: their names.
        terms: what each of them allows.
        attribution: what their licences ask to have shown, a line each.
    """

    name: str
    about: str
    files: tuple[CaptureFile, ...]
    licences: tuple[str, ...]
    terms: tuple[str, ...]
    attribution: tuple[str, ...]

    @property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(file.size for file in self.files)


@cache
def capture_sets() -> dict[str, CaptureSet]:
    """All sets by name."""
    known = tomllib.loads((FOLDER / "sets.toml").read_text())
    with (FOLDER / "sources.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: _set(name, about, rows, known["licences"]) for name, about in known["sets"].items()}


def capture_set(name: str) -> CaptureSet:
    """The set called ``name``.

    Raises:
        InputError: for a name that is not there, listing those that are.
    """
    if name not in capture_sets():
        raise InputError(f"no set {name!r}, expected one of {', '.join(capture_sets())}, or list", "footwork data")
    return capture_sets()[name]


def _set(name: str, about: str, rows: list[dict[str, str]], licences: dict[str, dict[str, str]]) -> CaptureSet:
    own = [row for row in rows if row["set"] == name]
    names = tuple(dict.fromkeys(row["licence"] for row in own))
    asked = [licences[name] for name in names]
    return CaptureSet(
        name,
        about,
        tuple(_file(row) for row in own),
        names,
        tuple(licence["terms"] for licence in asked),
        tuple(licence["attribution"] for licence in asked),
    )


def _file(row: dict[str, str]) -> CaptureFile:
    place = quote(f"{row['repository']}/{row['commit']}/{row['path']}")
    return CaptureFile(row["file"], place, int(row["bytes"]), row["sha256"])
