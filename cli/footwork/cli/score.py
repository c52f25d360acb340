"""``footwork score``: replay recorded players and measure how well and how smoothly the character follows."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from footwork.cli.output import emit, progress
from footwork.errors import InputError


def score(
    bundle: Path,
    /,
    *,
    traces: Path,
    inertialise: bool = True,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Replay recorded user traces through a bundle's character and score it.

    Example: footwork score walker.footwork --traces traces --json

    Args:
        bundle: The bundle to score.
        traces: A trace (CSV), or a folder of them.
        inertialise: Smooth transitions; --no-inertialise shows the bare jumps.
        json: Print the score as one JSON object.
    """
    from footwork.motion.bundle import read_bundle
    from footwork.motion.trace import read_trace
    from footwork.study.scoring import score as score_traces
    from footwork.study.showing import Showing

    paths = _trace_files(traces)
    loaded = read_bundle(bundle)
    with progress() as report_progress:
        report_progress("reading traces", 0.0)
        players = [read_trace(path) for path in paths]
        report = score_traces(loaded, players, showing=Showing(inertialise), progress=report_progress)
    emit(report, json, f"{bundle} on {traces}")


def _trace_files(traces: Path) -> list[Path]:
    paths = sorted(traces.glob("*.csv")) if traces.is_dir() else [traces]
    if not paths:
        raise InputError("no CSV files in it, expected at least one trace", traces)
    return paths
