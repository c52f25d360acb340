"""What the paper's claim that feet need no work comes to: slide of interpolation and of paths, against the captures."""

from collections.abc import Mapping
from typing import Any

from footwork.motion.graph import MotionGraph
from footwork.study.foot_slide import slide_of_interpolation
from footwork.study.reproduction.row import Cause, Judgement, judged, unjudged

NEAR_SOURCE = 1.25  # times the slide of the source clips counts as that of the source clips


def slide_judgements(found: Mapping[str, Mapping[str, Any]]) -> list[Judgement]:
    """Two claims, over several graphs and a path through each, cm/s or None.

    Args:
        found: by name, the slide of ``interpolated`` motion and of the captured frames ``made_of`` that it is, the
            ``slide`` of a path and that of its ``source`` clips.
    """
    made = "Interpolated motion's feet slide no more than those of the captured frames it is made of."
    return [
        slide_judgement(made, "interpolated", "made_of", found, None),
        slide_judgement(
            "Feet slide no more than in the captures, transitions included.", "slide", "source", found, Cause.CLAIM
        ),
    ]


def slides_of_interpolation(graph: MotionGraph) -> dict[str, float | None]:
    """What ``slide_judgements`` wants to know of a graph."""
    own, sources = slide_of_interpolation(graph)
    return {"slide_interpolated_cm_s": own.cm_per_second, "slide_made_of_cm_s": sources.cm_per_second}


def slide_judgement(
    claim: str, what: str, source: str, found: Mapping[str, Mapping[str, Any]], cause: Cause | None
) -> Judgement:
    """Whether one slide is no more than another, within NEAR_SOURCE, wherever both are known."""
    known = {name: one for name, one in found.items() if one[what] is not None and one[source] is not None}
    if not known:
        return unjudged(claim, "No foot stands on the paths or in their source clips.", Cause.DATA)
    holds = all(one[what] <= NEAR_SOURCE * one[source] for one in known.values())
    reason = ", ".join(f"{name} {one[what]:.1f} against {one[source]:.1f} cm/s" for name, one in known.items())
    why = " A pose that jumps takes a standing foot along." if what == "slide" and not holds else ""
    return judged(claim, holds, f"{reason}.{why}", cause)
