"""Pictures of the measures of a motion graph: ways between frames, their times, times between kinds of motion."""

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.tick import TICK
from footwork.study import drawing
from footwork.study.behaviour_times import BehaviourTimes, behaviour_times
from footwork.study.breadth_first import UNREACHED, ticks_between
from footwork.study.graph_report import frame_times
from footwork.study.maneuverability import maneuverability
from footwork.study.responsiveness import evenly

_CELLS = 500  # frames along each side of the picture of ways
_TIMES = "YlGnBu"


def ways_plot(graph: MotionGraph, path: str | os.PathLike, frames: int | None = None) -> Path:
    """The transitive closure with times: seconds from each captured frame to each other one, red where never.

    Args:
        graph: the graph.
        path: the PNG to write.
        frames: how many frames were captured, to say how many of them the graph lacks.
    """
    captured = np.flatnonzero(graph.original)
    shown = evenly(captured, _CELLS)
    ticks = ticks_between(graph.edge_start, graph.target, shown, shown)
    figure, axes = drawing.pyplot().subplots(figsize=(8.4, 8), facecolor=drawing.PAPER)
    seconds = np.ma.masked_equal(ticks, UNREACHED) * TICK
    never = drawing.pyplot().get_cmap(_TIMES).with_extremes(bad=drawing.LABEL_COLOURS["run"])
    image = axes.imshow(seconds, cmap=never, extent=(0, len(captured), len(captured), 0))
    for start in np.flatnonzero(np.diff(graph.clip[captured])) + 1:
        axes.axvline(start, color=drawing.FAINT, lw=0.4)
        axes.axhline(start, color=drawing.FAINT, lw=0.4)
    lost = f", {frames - len(captured)} more were captured and are not in it" if frames else ""
    _title(axes, "How soon one frame leads to another", f"{len(captured)} captured frames are in the graph{lost}")
    axes.set(xlabel="to frame (lines divide the clips)", ylabel="from frame")
    figure.colorbar(image, ax=axes, label="seconds of the shortest way", fraction=0.04)
    figure.tight_layout()
    return drawing.save(figure, path)


def transition_time_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """How many pairs of captured frames take how long, with the mean."""
    times = frame_times(graph)
    figure, axes = drawing.pyplot().subplots(figsize=(8, 4.5), facecolor=drawing.PAPER)
    if times.mean is not None:
        share = times.histogram / times.histogram.sum()
        axes.bar(np.arange(len(share)) * TICK, 100.0 * share, width=TICK, color=drawing.LABEL_COLOURS["walk"], lw=0)
        axes.axvline(times.mean, color=drawing.INK, lw=1.2)
        axes.annotate(f" mean {times.mean:.2f} s", (times.mean, 0.93), xycoords=("data", "axes fraction"))
    way = "from all frames" if times.exact else f"from {len(times.sources)} of {times.frames} frames, drawn at random"
    _title(axes, "Transition times between captured frames", f"shortest ways {way} to all others")
    axes.set(xlabel="seconds", ylabel="pairs of frames, %", xlim=(0, None))
    axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    return drawing.save(figure, path)


def label_times_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Seconds from each label to each other one: between the nearest frames, and from the average frame."""
    times = behaviour_times(graph.edge_start, graph.target, graph.label, graph.labels, np.flatnonzero(graph.original))
    side = max(3.2, 0.62 * len(times.kinds) + 1.2)
    figure, axes = drawing.pyplot().subplots(1, 2, figsize=(2 * side, side + 0.6), facecolor=drawing.PAPER)
    _times_table(axes[0], times, times.least, "from the nearest frame")
    _times_table(axes[1], times, times.mean, "from the average frame")
    figure.suptitle("Seconds from one label (row) to the nearest frame of another (column)", fontsize=11)
    figure.tight_layout()
    return drawing.save(figure, path)


def maneuverability_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Local maneuverability by label: how soon each can be begun from the middle of any motion."""
    plain, again = (
        maneuverability(graph.edge_start, graph.target, graph.label, graph.labels, reentry=reentry)
        for reentry in (False, True)
    )
    figure, axes = drawing.pyplot().subplots(figsize=(8, 4.5), facecolor=drawing.PAPER)
    colours = drawing.label_colours(list(plain.kinds))
    rows = np.arange(len(plain.kinds))
    fills = [colours[kind] for kind in plain.kinds]
    axes.bar(rows - 0.2, np.nan_to_num(plain.seconds), 0.38, color=fills, label="0 where a segment ends in it")
    axes.bar(
        rows + 0.2,
        np.nan_to_num(again.seconds),
        0.38,
        color=[drawing.mix(fill, drawing.PAPER, 0.55) for fill in fills],
        edgecolor=fills,
        label="left and entered anew (pale)",
    )
    for shift, seconds in ((-0.2, plain.seconds), (0.2, again.seconds)):
        for row, value in zip(rows, seconds, strict=True):
            text = f"{value:.2f}" if np.isfinite(value) else "never"
            axes.annotate(text, (row + shift, np.nan_to_num(value)), ha="center", va="bottom", fontsize=8)
    if plain.mean is not None:
        axes.axhline(plain.mean, color=drawing.INK, lw=1.0, ls="--", label=f"mean of the dark bars, {plain.mean:.2f} s")
    axes.set(ylabel="seconds", xticks=rows, xticklabels=[kind or "none" for kind in plain.kinds])
    _title(axes, "Local maneuverability", "from the middle of an average segment until a label can begin")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    return drawing.save(figure, path)


def _title(axes: Any, title: str, caption: str) -> None:
    axes.set_title(f"{title}\n", color=drawing.INK)
    axes.text(0.5, 1.02, caption, transform=axes.transAxes, ha="center", fontsize=8.5, color=drawing.FAINT)


def _times_table(axes: Any, times: BehaviourTimes, table: NDArray, title: str) -> None:
    names = [kind or "none" for kind in times.kinds]
    top = max(float(np.nanmax(times.mean, initial=0.0)), TICK)
    axes.imshow(table, cmap=_TIMES, vmin=0.0, vmax=1.25 * top)
    for (row, column), value in np.ndenumerate(table):
        text = f"{value:.2f}" if np.isfinite(value) else "never"
        dark = np.isfinite(value) and value > 0.65 * top
        axes.text(column, row, text, ha="center", va="center", fontsize=8, color="white" if dark else drawing.INK)
    axes.set(xticks=range(len(names)), yticks=range(len(names)), title=title)
    axes.set_xticklabels(names, rotation=45, ha="right")
    axes.set_yticklabels(names)
    axes.title.set_fontsize(9)
    axes.spines[:].set_visible(False)
