"""Tables and charts of how characters follow recorded players."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from footwork.motion.angle import wrapped
from footwork.motion.tick import TICK
from footwork.study.measures import Followed
from footwork.study.reproduction.charts import Axis, Series, line_charts
from footwork.study.reproduction.row import OURS, Cell, Column, Figure, Table

Scores = Mapping[str, Mapping[str, Any] | None]
_FIGURES: Sequence[tuple[str, str, int, tuple[str, ...]]] = (
    ("Control", "", 2, ("control",)),
    ("Transition", "", 2, ("transition",)),
    ("of jumps", "", 2, ("transition_jumps",)),
    ("Total", "", 3, ("total",)),
    ("switches", "share", 2, ("switch_share",)),
    ("heading off", "°", 0, ("heading_error_deg", "mean")),
    ("settled in", "s", 2, ("settle_s", "mean")),
    ("latency", "s", 2, ("behaviour_latency_s", "mean")),
    ("slide", "cm/s", 1, ("foot_slide_cm_s",)),
    ("of clips", "cm/s", 1, ("source_foot_slide_cm_s",)),
    ("skating", "share", 2, ("skating_ratio",)),
    ("velocity jump", "m/s", 2, ("velocity_jump_m_s", "at_switches_p95")),
    ("decision", "µs", 2, ("batch", "decision_us", "mean")),
    ("p99", "µs", 2, ("batch", "decision_us", "p99")),
    ("table", "MB", 1, ("table_mb",)),
    ("clips", "MB", 1, ("clip_mb",)),
    ("made in", "s", 0, ("made_s",)),
)


def characters_table(caption: str, scores: Scores) -> Table:
    """A line for each character, a dash where its graph could not be walked without end."""
    columns = [Column("character")] + [Column(name, unit, OURS, digits) for name, unit, digits, _ in _FIGURES]
    columns.append(Column("interval of Total", "", OURS))
    return Table(caption, columns, [[name, *_cells(one)] for name, one in scores.items()])


def _cells(one: Mapping[str, Any] | None) -> list[Cell]:
    if one is None:
        return [None] * (len(_FIGURES) + 1)
    return [*(_at(one, path) for *_, path in _FIGURES), interval_words(one)]


def _at(one: Any, path: Sequence[str]) -> Cell:
    for name in path:
        one = None if one is None else one.get(name)
    return one


def interval_words(one: Mapping[str, Any]) -> str:
    """The interval of Total, a dash for a single trace."""
    return "{:.3f} to {:.3f}".format(*one["intervals"]["total"]) if one["intervals"] else "–"


def shares_table(caption: str, totals: Mapping[str, float]) -> Table:
    """What each reaches of the last one's Total."""
    best = list(totals.values())[-1]
    columns = [Column("character"), Column("Total", "", OURS, 3), Column("share", "%", OURS, 0)]
    return Table(caption, columns, [[name, total, 100.0 * total / max(best, 1e-9)] for name, total in totals.items()])


def control_chart(series: Mapping[str, tuple[str, Sequence[Mapping[str, Any]]]]) -> Figure:
    """Control against Transition: each series by name, with its colour and its scores, joined by a line.

    Those of plain graphs are dashed.
    """
    lines = [
        Series(name, [one["transition"] for one in scores], [one["control"] for one in scores], colour, "plain" in name)
        for name, (colour, scores) in series.items()
        if scores
    ]
    axes = Axis("Transition", limits=(None, 1.0)), Axis("Control", limits=(0.0, 1.0))
    return Figure(
        caption="Control against smoothness, each character a point; lines join the thresholds of a kind of graph.",
        alt="Control against Transition of every character",
        svg=line_charts([("", lines, *axes)], height=4.2),
    )


def heading_chart(followed: Mapping[str, tuple[str, Followed]], seconds: float) -> Figure:
    """Which way a player wanted to go and which way each character faced, over the first seconds of a trace."""
    ticks = round(seconds / TICK)
    first = next(iter(followed.values()))[1]
    time = TICK * np.arange(len(first.heading))[:ticks]
    wanted = np.unwrap(first.heading)[:ticks]
    lines = [Series("wanted", time, np.degrees(wanted), "ink", marks=False)]
    for name, (colour, one) in followed.items():
        off = wrapped(one.facing - one.heading)[:ticks]
        lines.append(Series(name, time, np.degrees(wanted + off), colour, marks=False))
    return Figure(
        caption="The way a player wants to go and the way characters face, one trace.",
        alt="Wanted heading and facings over time",
        svg=line_charts([("", lines, Axis("seconds"), Axis("yaw, degrees"))], height=3.4),
    )
