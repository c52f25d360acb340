"""``footwork data``: real motion capture, fetched by digest."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from footwork.cli.default_bundle import cache_folder
from footwork.cli.output import Report, emit, log, progress
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.training.capture_sets import CaptureSet
    from footwork.training.fetching import Fetcher

LIST = "list"
_MEGABYTE = 1e6
ATTRIBUTION = "ATTRIBUTION.txt"


def data(
    *names: str,
    to: Path | None = None,
    origin: str | None = None,
    insecure: Annotated[bool, Parameter(negative=())] = False,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Fetch real motion capture, each file checked by its digest; what is there already is kept.

    A set becomes a folder of its own. Beside it come labels.csv and core_ranges.csv for `footwork build --labels
    --ranges`, and a file that says what whoever uses the capture must tell.

    Example: footwork data dataset3 --to captures

    Args:
        names: Sets to fetch; list, or none at all, tells which there are.
        to: The folder to put them into; in the user's cache where not given.
        origin: Address of a mirror, in place of where the list says the files are.
        insecure: Also follow addresses that are not https; digests are checked all the same.
        json: Print the report as one JSON object.
    """
    from footwork.training.capture_sets import ORIGIN, capture_set, capture_sets
    from footwork.training.fetching import Fetcher

    if not names or names == (LIST,):
        emit({"sets": [_told(each) for each in capture_sets().values()]}, json, "sets")
        return
    sets = [capture_set(name) for name in dict.fromkeys(names)]
    folder = to or cache_folder() / "captures"
    fetcher, address = Fetcher(insecure=insecure), (origin or ORIGIN).rstrip("/")
    with progress() as report:
        fetched = [_fetch(each, _made(folder / each.name), address, fetcher, report) for each in sets]
    _put_tables(folder)
    _put_attribution(folder, sets)
    for line in dict.fromkeys(line for each in sets for line in each.attribution):
        log(f"whoever gets this must be told: {line}")
    told = [_told(each) | {"fetched": count} for each, count in zip(sets, fetched, strict=True)]
    emit({"folder": str(folder), "sets": told}, json, str(folder))


def _told(each: CaptureSet) -> dict[str, object]:
    return {
        "name": each.name,
        "about": each.about,
        "files": len(each.files),
        "megabytes": round(each.size / _MEGABYTE, 1),
        "licence": ", ".join(each.licences),
    }


def _made(folder: Path) -> Path:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{error.strerror}, expected a folder that can be written to", folder) from None
    return folder


def _fetch(each: CaptureSet, folder: Path, address: str, fetcher: Fetcher, report: Report) -> int:
    """How many files of a set were not there yet."""
    done = fetched = 0
    for file in each.files:
        before = done

        def seen(have: int, name: str = file.name, before: int = before) -> None:
            report(name, (before + have) / each.size)

        fetched += fetcher.fetch(f"{address}/{file.place}", folder / file.name, file.size, file.sha256, seen)
        done += file.size
    return fetched


def _put_tables(folder: Path) -> None:
    """Tables come along where there are none: whoever has changed theirs keeps them."""
    from footwork.motion.textfile import write_whole
    from footwork.training.capture_sets import FOLDER, TABLES

    for name in TABLES:
        if not (folder / name).exists():
            write_whole(folder / name, (FOLDER / name).read_bytes())


def _put_attribution(folder: Path, sets: list[CaptureSet]) -> None:
    from footwork.motion.textfile import write_whole

    for each in sets:
        lines = [*each.attribution, "", *map(": ".join, zip(each.licences, each.terms, strict=True))]
        write_whole(folder / each.name / ATTRIBUTION, ("\n".join(lines) + "\n").encode())
