"""``footwork score``: replay recorded players and measure how well and how smoothly the character follows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from footwork.cli.contenders import TABLE, Choice
from footwork.cli.motions import AS_USUAL, Reading
from footwork.cli.output import Report, emit, progress
from footwork.cli.traces import read_traces

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from collections.abc import Mapping, Sequence

    from footwork.motion.bundle import Bundle
    from footwork.motion.trace import Trace
    from footwork.study.contender import Contender

_TABLE = Choice()


def score(
    bundle: Path,
    /,
    *,
    traces: Path,
    choice: Annotated[Choice, Parameter(name="*")] = _TABLE,
    reading: Reading = AS_USUAL,
    inertialise: bool = True,
    foot_lock: bool = True,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Replay recorded user traces through a bundle's character and score it.

    A policy is not scored on traces that its player model learned from, unless each is left out in turn.

    Example: footwork score walker.footwork --traces traces --controller oracle --foresight 0.5

    Args:
        bundle: The bundle to score.
        traces: A trace (CSV), or a folder of them.
        choice: What steers the character.
        reading: How a folder of capture is read.
        inertialise: Smooth transitions; --no-inertialise shows the bare jumps.
        foot_lock: Keep standing feet where they stand; --no-foot-lock shows how far they slide.
        json: Print the score as one JSON object.
    """
    from footwork.motion.bundle import read_bundle
    from footwork.study.left_out import require_unseen
    from footwork.study.scoring import score as score_traces
    from footwork.study.showing import Showing

    loaded = read_bundle(bundle)
    with progress() as report_progress:
        report_progress("reading traces", 0.0)
        players = read_traces(traces)
        if choice.controller == TABLE and not choice.leave_one_out:
            require_unseen(loaded.table("steering"), players)
        report = score_traces(
            loaded,
            players,
            choice.of(loaded, reading),
            instead=_left_out(loaded, players, choice, report_progress),
            showing=Showing(inertialise=inertialise, foot_lock=foot_lock),
            progress=report_progress,
        )
    emit(report, json, f"{choice.title} of {bundle} on {traces}")


def _left_out(bundle: Bundle, traces: Sequence[Trace], choice: Choice, tell: Report) -> Mapping[str, Contender]:
    """For each trace, by its digest, the policy that has not seen it; none where that is not asked for."""
    from footwork.study.left_out import tables_without

    if not choice.leave_one_out:
        return {}
    tables = tables_without(bundle.graph, bundle.table("steering"), traces, tell)
    return {digest: choice.steering(bundle, table) for digest, table in tables.items()}
