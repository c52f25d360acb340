"""Pictures of the measures of a motion graph: ways between frames, their times, times between kinds of motion."""

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.tick import TICK
from footwork.study.behaviour_times import BehaviourTimes, behaviour_times
from footwork.study.breadth_first import UNREACHED, ticks_between
from footwork.study.drawing import LABEL_COLOURS, label_colours, pyplot
from footwork.study.graph_report import frame_times
from footwork.study.maneuverability import maneuverability
from footwork.study.plot_style import FIGURE, MARKER, add_legend, add_scale, dress, ramp, save_svg
from footwork.study.responsiveness import evenly

_CELLS = 500  # frames along each side of the picture of ways
_PALE = 0.45  # opacity of fields that numbers stand on


def ways_plot(graph: MotionGraph, path: str | os.PathLike, frames: int | None = None) -> Path:
    """The transitive closure with times: seconds from each captured frame to each other one, blank where never.

    Args:
        graph: the graph.
        path: the SVG to write.
        frames: how many frames were captured, to say how many of them the graph lacks.
    """
    captured = np.flatnonzero(graph.original)
    shown = evenly(captured, _CELLS)
    ticks = ticks_between(graph.edge_start, graph.target, shown, shown)
    figure, axes = pyplot().subplots(figsize=(7.6, 7.0))
    seconds = np.ma.masked_equal(ticks, UNREACHED) * TICK
    image = axes.imshow(seconds, cmap=ramp(), interpolation="none", extent=(0, len(captured), len(captured), 0))
    for start in np.flatnonzero(np.diff(graph.clip[captured])) + 1:
        axes.axvline(start, color=MARKER["card"], lw=0.5)
        axes.axhline(start, color=MARKER["card"], lw=0.5)
    lost = f", {frames - len(captured)} more were captured and are not in it" if frames else ""
    caption = f"{len(captured):,} captured frames are in the graph{lost}; blank: never"
    dress(axes, "How soon one frame leads to another", caption=caption, grid=None)
    axes.set(xlabel="to frame (lines divide the clips)", ylabel="from frame")
    add_scale(figure, image, axes, "seconds of the shortest way")
    figure.tight_layout()
    return save_svg(figure, path)


def transition_time_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """How many pairs of captured frames take how long, with the mean."""
    times = frame_times(graph)
    figure, axes = pyplot().subplots(figsize=FIGURE)
    if times.mean is not None:
        share = times.histogram / times.histogram.sum()
        axes.bar(np.arange(len(share)) * TICK, 100.0 * share, width=TICK, color=LABEL_COLOURS["walk"], lw=0)
        axes.axvline(times.mean, color=MARKER["ink"], lw=1.2)
        place = {"xycoords": ("data", "axes fraction"), "fontsize": 8.5, "color": MARKER["ink"]}
        axes.annotate(f" mean {times.mean:.2f} s", (times.mean, 0.93), **place)
    way = "from all frames" if times.exact else f"from {len(times.sources)} of {times.frames} frames, drawn at random"
    caption = f"shortest ways {way} to all others"
    dress(axes, "Transition times between captured frames", caption=caption, grid="y")
    axes.set(xlabel="seconds", ylabel="pairs of frames, %", xlim=(0, None))
    figure.tight_layout()
    return save_svg(figure, path)


def label_times_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Seconds from each label to each other one: between the nearest frames, and from the average frame."""
    times = behaviour_times(graph.edge_start, graph.target, graph.label, graph.labels, np.flatnonzero(graph.original))
    side = max(3.2, 0.62 * len(times.kinds) + 1.2)
    figure, axes = pyplot().subplots(1, 2, figsize=(2 * side, side + 0.6))
    _times_table(axes[0], times, times.least, "from the nearest frame")
    _times_table(axes[1], times, times.mean, "from the average frame")
    title = "Seconds from one label (row) to the nearest frame of another (column)"
    figure.suptitle(title, fontsize=9.5, color=MARKER["ink"])
    figure.tight_layout()
    return save_svg(figure, path)


def maneuverability_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Local maneuverability by label: how soon each can be begun from the middle of any motion."""
    plain, again = (
        maneuverability(graph.edge_start, graph.target, graph.label, graph.labels, reentry=reentry)
        for reentry in (False, True)
    )
    figure, axes = pyplot().subplots(figsize=FIGURE)
    colours = label_colours(list(plain.kinds))
    rows = np.arange(len(plain.kinds))
    fills = [colours[kind] for kind in plain.kinds]
    axes.bar(rows - 0.2, np.nan_to_num(plain.seconds), 0.38, color=fills, label="0 where a segment ends in it")
    axes.bar(
        rows + 0.2,
        np.nan_to_num(again.seconds),
        0.38,
        color=[(fill, _PALE) for fill in fills],
        edgecolor=fills,
        label="left and entered anew (pale)",
    )
    small = {"fontsize": 8, "color": MARKER["ink"]}
    for shift, seconds in ((-0.2, plain.seconds), (0.2, again.seconds)):
        for row, value in zip(rows, seconds, strict=True):
            text = f"{value:.2f}" if np.isfinite(value) else "never"
            axes.annotate(text, (row + shift, np.nan_to_num(value)), ha="center", va="bottom", **small)
    if plain.mean is not None:
        words = f"mean of the dark bars, {plain.mean:.2f} s"
        axes.axhline(plain.mean, color=MARKER["ink"], lw=1.0, ls="--", label=words)
    axes.set(ylabel="seconds", xticks=rows, xticklabels=[kind or "none" for kind in plain.kinds])
    caption = "from the middle of an average segment until a label can begin"
    dress(axes, "Local maneuverability", caption=caption, grid="y")
    axes.tick_params(axis="x", colors=MARKER["ink"])
    add_legend(axes)
    figure.tight_layout()
    return save_svg(figure, path)


def _times_table(axes: Any, times: BehaviourTimes, table: NDArray, title: str) -> None:
    names = [kind or "none" for kind in times.kinds]
    top = max(float(np.nanmax(times.mean, initial=0.0)), TICK)
    axes.imshow(table, cmap=ramp(), alpha=_PALE, vmin=0.0, vmax=top)
    for (row, column), value in np.ndenumerate(table):
        text = f"{value:.2f}" if np.isfinite(value) else "never"
        axes.text(column, row, text, ha="center", va="center", fontsize=8, color=MARKER["ink"])
    dress(axes, title, grid=None)
    axes.set(xticks=range(len(names)), yticks=range(len(names)))
    axes.set_xticklabels(names, rotation=45, ha="right", color=MARKER["ink"])
    axes.set_yticklabels(names, color=MARKER["ink"])
    axes.spines[:].set_visible(False)
