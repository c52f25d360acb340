"""``footwork reproduce``: the tables and figures of the papers, made again and put beside theirs."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from footwork.cli.output import emit, log, progress
from footwork.errors import InputError

SOME_FAILED = 1


def reproduce(
    *,
    motions: Path,
    out: Path,
    traces: Path | None = None,
    only: Annotated[tuple[str, ...], Parameter(consume_multiple=True, negative=())] = (),
    quick: Annotated[bool, Parameter(negative=())] = False,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Make the papers' tables and figures again, and say of each claim whether it holds.

    Writes index.html, one page with everything in it, and reproduction.json. Exit status 1 where a row failed.

    Example: footwork reproduce --motions motions --out reproduction --quick

    Args:
        motions: A folder that holds dataset1, dataset2, dataset3, labels.csv and core_ranges.csv.
        out: The folder to write into.
        traces: A folder of recorded players' traces (CSV), for rows that replay them.
        only: Rows to make, such as Z-T2, or the letter of a paper; all where not given.
        quick: Leave out what takes minutes.
        json: Print what reproduction.json holds.
    """
    from footwork.study.reproduction.run import reproduce as run

    if traces is not None and not traces.is_dir():
        raise InputError(f"no folder {traces}, expected one of traces", "--traces")
    with progress() as report_progress:
        report = run(motions, out, traces=traces, only=only, quick=quick, progress=report_progress)
    for row in report["rows"]:
        if row["error"]:
            log(f"{row['name']} failed: {row['error']}")
    summary = {row["name"]: row["verdict"] or row["status"] for row in report["rows"]}
    emit(report if json else summary | {"page": str(out / "index.html")}, json, f"{motions} against the papers")
    return SOME_FAILED if report["failed"] else 0
