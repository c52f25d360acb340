"""What the paper's claim that feet need no work comes to: slide with and without the jumps, against the captures."""

from collections.abc import Mapping
from typing import Any

from footwork.study.reproduction.row import Cause, Judgement, judged, unjudged

NEAR_SOURCE = 1.25  # times the slide of the source clips counts as that of the source clips


def slide_judgements(found: Mapping[str, Mapping[str, Any]]) -> list[Judgement]:
    """Two claims, over the ``slide``, ``between`` jumps and ``source`` of several paths, cm/s or None."""
    return [
        _judged("Between transitions feet slide no more than in the captures.", "between", found, None),
        _judged("Feet slide no more than in the captures, transitions included.", "slide", found, Cause.CLAIM),
    ]


def _judged(claim: str, what: str, found: Mapping[str, Mapping[str, Any]], cause: Cause | None) -> Judgement:
    known = {name: one for name, one in found.items() if one[what] is not None and one["source"] is not None}
    if not known:
        return unjudged(claim, "No foot stands on the paths or in their source clips.", Cause.DATA)
    holds = all(one[what] <= NEAR_SOURCE * one["source"] for one in known.values())
    reason = ", ".join(f"{name} {one[what]:.1f} against {one['source']:.1f} cm/s" for name, one in known.items())
    why = " A pose that jumps takes a standing foot along." if what == "slide" and not holds else ""
    return judged(claim, holds, f"{reason}.{why}", cause)
