"""How sure scores are: traces are drawn again, each whole, since ticks of one player are alike (bootstrap)."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.study.bootstrap import Estimate, draws, estimate, ratio
from footwork.study.foot_slide import Slide
from footwork.study.measures import Followed


def intervals(parts: Sequence[Followed], slides: Sequence[Slide]) -> dict[str, list[float | None]] | None:
    """The 95 % intervals of the main figures over traces, by their names in a score; None for fewer than two traces.

    Args:
        parts: what came of each trace.
        slides: what feet slid in each.
    """
    if len(parts) < 2:
        return None
    jumped = [part.transition[~part.natural] for part in parts]
    errors = [np.degrees(part.error[part.headed]) for part in parts]
    ticks = [len(part.heading) for part in parts]
    found = {
        "control": ratio([part.control.sum() for part in parts], ticks),
        "transition": ratio([part.transition.sum() for part in parts], ticks),
        "transition_jumps": ratio([some.sum() for some in jumped], [len(some) for some in jumped]),
        "total": total(parts),
        "heading_error_deg": ratio([some.sum() for some in errors], [len(some) for some in errors]),
        "foot_slide_cm_s": ratio([100.0 * slide.metres for slide in slides], [slide.seconds for slide in slides]),
    }
    return {name: [one.low, one.high] for name, one in found.items()}


def total(parts: Sequence[Followed], seed: int = 0) -> Estimate:
    """Control x Transition of several traces."""
    return estimate(float(_totals(parts, np.ones((1, len(parts))))[0]), _totals(parts, draws(len(parts), seed)))


def total_gain(parts: Sequence[Followed], others: Sequence[Followed], seed: int = 0) -> Estimate:
    """By how much one controller's Total is above another's on the same traces, in the same order."""
    once, drawn = np.ones((1, len(parts))), draws(len(parts), seed)
    gain = float((_totals(parts, once) - _totals(others, once))[0])
    return estimate(gain, _totals(parts, drawn) - _totals(others, drawn))


def scored_gain(one: Mapping[str, Any], other: Mapping[str, Any], seed: int = 0) -> Estimate:
    """``total_gain`` of two reports of ``scoring.score`` on the same traces."""
    sums = [
        np.array(
            [[part["ticks"], part["ticks"] * part["control"], part["ticks"] * part["transition"]] for part in parts]
        )
        for parts in (one["traces"], other["traces"])
    ]
    once, drawn = np.ones((1, len(sums[0]))), draws(len(sums[0]), seed)
    gain = float((_products(sums[0], once) - _products(sums[1], once))[0])
    return estimate(gain, _products(sums[0], drawn) - _products(sums[1], drawn))


def _totals(parts: Sequence[Followed], drawn: NDArray) -> NDArray[np.float64]:
    """Total of each draw of traces.  # (n, traces) -> (n,)"""
    sums = np.array([[len(part.heading), part.control.sum(), part.transition.sum()] for part in parts])
    return _products(sums, drawn)


def _products(sums: NDArray, drawn: NDArray) -> NDArray[np.float64]:
    """Total of each draw, from ticks and sums of qc and qt of each trace.  # (traces, 3), (n, traces) -> (n,)"""
    ticks, control, transition = (drawn @ sums).T
    return control * transition / ticks**2
