"""Pictures of what is in a bundle: contact sheets, transitions between frames, values over headings, turning."""

import os
from pathlib import Path
from typing import Any

import numpy as np

from footwork.motion.bundle import Bundle
from footwork.motion.graph import MotionGraph
from footwork.motion.table import PolicyTable
from footwork.study import drawing
from footwork.study.contact_sheet import contact_sheet, contact_sheets
from footwork.study.graph_clips import clips_of_graph
from footwork.study.graph_paths import path_clip
from footwork.study.measure_plots import label_times_plot, maneuverability_plot, transition_time_plot, ways_plot
from footwork.study.tour import tour, tour_labels

_BEHAVIOUR_COLOURS = {"stop": "#9aa5b1", "walk": "#4c9f70", "run": "#d1495b", "jump": "#8e6bbf"}


def inspection_plots(bundle: Bundle, directory: str | os.PathLike) -> list[Path]:
    """Draw all pictures of a bundle into a folder and return their paths.

    Raises:
        InputError: for a folder that cannot be made or written to, or a missing matplotlib.
    """
    directory, graph = Path(directory), bundle.graph
    paths = contact_sheets(directory, clips_of_graph(graph))
    frames = bundle.provenance.get("counts", {}).get("frames")
    paths += [
        transitions_plot(graph, directory / "transitions.png"),
        ways_plot(graph, directory / "ways.png", frames),
        transition_time_plot(graph, directory / "transition_times.png"),
    ]
    if len(tour_labels(graph)) > 1:
        paths += _label_plots(graph, directory)
    paths += [values_plot(table, directory / f"values_{name}.png") for name, table in bundle.tables.items()]
    return paths


def _label_plots(graph: MotionGraph, directory: Path) -> list[Path]:
    """Pictures of what a graph of several labels can do."""
    paths = [
        label_times_plot(graph, directory / "label_times.png"),
        maneuverability_plot(graph, directory / "maneuverability.png"),
    ]
    edges = tour(graph)
    if edges is None:
        return paths
    name = f"tour: {', '.join(tour_labels(graph))}, without smoothing"
    return [*paths, contact_sheet(directory / "tour.png", path_clip(graph, edges, name))]


def transitions_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Every transition as a point: from which frame, to which frame, at which cost; lines divide the clips."""
    plt = drawing.pyplot()
    figure, axes = plt.subplots(figsize=(9, 8), facecolor=drawing.PAPER)
    jumps = ~graph.natural
    points = axes.scatter(graph.target[jumps], graph.source[jumps], c=graph.cost[jumps], s=3, cmap="viridis_r", lw=0)
    axes.set(xlim=(0, graph.node_count), ylim=(graph.node_count, -0.025 * graph.node_count))
    between = "" if graph.original.all() else ", captured frames first, then frames between two"
    axes.set(xlabel="to node", ylabel="from node")
    axes.set_title(f"{int(jumps.sum())} transitions of {graph.node_count} nodes{between}", pad=26)
    for start in _bounds(graph):
        axes.axvline(start, color=drawing.FAINT, lw=0.3)
        axes.axhline(start, color=drawing.FAINT, lw=0.3)
    _label_strip(axes, graph)
    figure.colorbar(points, ax=axes, label="cost s", fraction=0.04)
    figure.tight_layout()
    return drawing.save(figure, path)


def values_plot(table: PolicyTable, path: str | os.PathLike) -> Path:
    """The worth of each command by relative heading: the mean over all nodes and the middle half of them."""
    plt = drawing.pyplot()
    figure, axes = plt.subplots(figsize=(8, 4.5), facecolor=drawing.PAPER)
    headings = np.degrees(table.task.headings)
    ceiling = 1.0 / (1.0 - table.task.discount)
    for index, name in enumerate(table.task.behaviours):
        worth = table.values[:, index].astype(np.float64) / ceiling
        low, high = np.percentile(worth, [25, 75], axis=0)
        colour = _BEHAVIOUR_COLOURS.get(name, drawing.INK)
        axes.fill_between(headings, low, high, color=colour, alpha=0.18, lw=0)
        axes.plot(headings, worth.mean(axis=0), color=colour, label=name)
    axes.set(xlim=(-180, 170), ylim=(0, 1), xticks=range(-180, 181, 45), xlabel="wanted heading less facing, degrees")
    axes.set(ylabel="value, share of the greatest possible", title="What commands are worth (mean and middle half)")
    axes.legend(frameon=False, ncols=4)
    axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    return drawing.save(figure, path)


def _bounds(graph: MotionGraph) -> np.ndarray:
    """Where one clip's captured frames end and another's, or frames between two, begin."""
    clip = np.where(graph.original, graph.clip, -1)
    return np.flatnonzero(np.diff(clip)) + 0.5


def _label_strip(axes: Any, graph: MotionGraph) -> None:
    """A strip above the picture that shows the labels of the nodes."""
    from matplotlib.colors import to_rgb

    colours = drawing.label_colours(list(graph.labels))
    strip = np.array([to_rgb(colours[label]) for label in graph.labels])[graph.label][None]
    height = graph.node_count
    axes.imshow(strip, extent=(0, height, -0.004 * height, -0.022 * height), aspect="auto", interpolation="nearest")
    axes.set(xlim=(0, height), ylim=(height, -0.025 * height))
    for label in sorted({graph.labels[number] for number in graph.label}):
        axes.plot([], [], color=colours[label], lw=5, label=label or "none")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=8, frameon=False, fontsize=8)
