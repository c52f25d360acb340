"""Pictures of what is in a bundle: contact sheets, transitions between frames, values over headings."""

import os
from pathlib import Path
from typing import Any

import numpy as np

from footwork.motion.bundle import Bundle
from footwork.motion.graph import MotionGraph
from footwork.motion.mirror import MIRRORED
from footwork.motion.table import PolicyTable
from footwork.study.contact_sheet import contact_sheet, contact_sheets
from footwork.study.drawing import label_colours, pyplot
from footwork.study.graph_clips import clips_of_graph
from footwork.study.graph_paths import path_clip
from footwork.study.measure_plots import label_times_plot, maneuverability_plot, transition_time_plot, ways_plot
from footwork.study.plot_style import (
    BEHAVIOUR_COLOURS,
    FIGURE,
    MARKER,
    add_legend,
    add_scale,
    dress,
    ramp,
    save_svg,
)
from footwork.study.tour import tour, tour_labels

_SIDE = 7.6  # inches of a picture of all pairs of frames


def inspection_plots(bundle: Bundle, directory: str | os.PathLike) -> list[Path]:
    """Draw all pictures of a bundle into a folder and return their paths; mirrored clips are not drawn once more.

    Raises:
        InputError: for a folder that cannot be made or written to, or a missing matplotlib.
    """
    directory, graph = Path(directory), bundle.graph
    clips = [clip for clip in clips_of_graph(graph) if not clip.name.endswith(MIRRORED)]
    paths = contact_sheets(directory, clips)
    frames = bundle.provenance.get("counts", {}).get("frames")
    paths += [
        transitions_plot(graph, directory / "transitions.svg"),
        ways_plot(graph, directory / "ways.svg", frames),
        transition_time_plot(graph, directory / "transition_times.svg"),
    ]
    if len(tour_labels(graph)) > 1:
        paths += _label_plots(graph, directory)
    paths += [values_plot(table, directory / f"values_{name}.svg") for name, table in bundle.tables.items()]
    return paths


def _label_plots(graph: MotionGraph, directory: Path) -> list[Path]:
    """Pictures of what a graph of several labels can do."""
    paths = [
        label_times_plot(graph, directory / "label_times.svg"),
        maneuverability_plot(graph, directory / "maneuverability.svg"),
    ]
    edges = tour(graph)
    if edges is None:
        return paths
    name = f"tour: {', '.join(tour_labels(graph))}, without smoothing"
    return [*paths, contact_sheet(directory / "tour.png", path_clip(graph, edges, name))]


def transitions_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Every transition as a point: from which frame, to which frame, at which cost; lines divide the clips."""
    figure, axes = pyplot().subplots(figsize=(_SIDE, 0.92 * _SIDE))
    jumps = ~graph.natural
    order = np.argsort(-graph.cost[jumps], kind="stable")  # the best above the others
    from_to = graph.target[jumps][order], graph.source[jumps][order]
    points = axes.scatter(*from_to, c=graph.cost[jumps][order], s=3, cmap=ramp(), lw=0, rasterized=True)
    between = "" if graph.original.all() else "; captured frames first, then frames between two"
    dress(axes, f"{int(jumps.sum()):,} transitions of {graph.node_count:,} nodes{between}", grid=None)
    axes.title.set_position((0.5, 1.0))
    axes.set_title(axes.get_title(), fontsize=axes.title.get_fontsize(), color=MARKER["ink"], pad=24)
    axes.set(xlabel="to node (lines divide the clips)", ylabel="from node")
    for start in _bounds(graph):
        axes.axvline(start, color=MARKER["grid"], lw=0.5, zorder=0)
        axes.axhline(start, color=MARKER["grid"], lw=0.5, zorder=0)
    _label_strip(axes, graph)
    add_scale(figure, points, axes, "cost s (1 is 5.6 cm, root mean square)")
    figure.tight_layout()
    return save_svg(figure, path)


def values_plot(table: PolicyTable, path: str | os.PathLike) -> Path:
    """The worth of each command by relative heading: the mean over all nodes and the middle half of them."""
    figure, axes = pyplot().subplots(figsize=FIGURE)
    headings = np.degrees(table.task.headings)
    ceiling = 1.0 / (1.0 - table.task.discount)
    for index, name in enumerate(table.task.behaviours):
        worth = table.values[:, index].astype(np.float64) / ceiling
        low, high = np.percentile(worth, [25, 75], axis=0)
        colour = BEHAVIOUR_COLOURS.get(name, MARKER["well"])
        axes.fill_between(headings, low, high, color=colour, alpha=0.2, lw=0)
        axes.plot(headings, worth.mean(axis=0), color=colour, lw=1.6, label=name)
    dress(axes, "What commands are worth", caption="mean over all nodes (line) and their middle half (band)")
    axes.set(xlim=(-180, 170), ylim=(0, 1), xticks=range(-180, 181, 45), xlabel="wanted heading less facing, degrees")
    axes.set(ylabel="value, share of the greatest possible")
    add_legend(axes, ncols=4)
    figure.tight_layout()
    return save_svg(figure, path)


def _bounds(graph: MotionGraph) -> np.ndarray:
    """Where one clip's captured frames end and another's, or frames between two, begin."""
    clip = np.where(graph.original, graph.clip, -1)
    return np.flatnonzero(np.diff(clip)) + 0.5


def _label_strip(axes: Any, graph: MotionGraph) -> None:
    """A strip above the picture that shows the labels of the nodes."""
    from matplotlib.colors import to_rgb

    colours = label_colours(list(graph.labels))
    strip = np.array([to_rgb(colours[label]) for label in graph.labels])[graph.label][None]
    height = graph.node_count
    axes.imshow(strip, extent=(0, height, -0.004 * height, -0.022 * height), aspect="auto", interpolation="nearest")
    axes.set(xlim=(0, height), ylim=(height, -0.025 * height))
    axes.spines[:].set_visible(False)
    for label in sorted({graph.labels[number] for number in graph.label}):
        axes.plot([], [], color=colours[label], lw=5, label=label or "none")
    add_legend(axes, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=8)
