"""Pictures of what is in a bundle: contact sheets, transitions between frames, values over headings, turning."""

import os
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from footwork.motion.bundle import Bundle
from footwork.motion.graph import MotionGraph
from footwork.motion.table import PolicyTable
from footwork.study import drawing
from footwork.study.contact_sheet import contact_sheets
from footwork.study.graph_clips import clips_of_graph

_BEHAVIOUR_COLOURS = {"stop": "#9aa5b1", "walk": "#4c9f70", "run": "#d1495b", "jump": "#8e6bbf"}


def inspection_plots(bundle: Bundle, directory: str | os.PathLike) -> list[Path]:
    """Draw all pictures of a bundle into a folder and return their paths.

    Raises:
        InputError: for a folder that cannot be made or written to, or a missing matplotlib.
    """
    directory = Path(directory)
    paths = contact_sheets(directory, clips_of_graph(bundle.graph))
    paths.append(transitions_plot(bundle.graph, directory / "transitions.png"))
    paths += [values_plot(table, directory / f"values_{name}.png") for name, table in bundle.tables.items()]
    return paths


def transitions_plot(graph: MotionGraph, path: str | os.PathLike) -> Path:
    """Every transition as a point: from which frame, to which frame, at which cost; lines divide the clips."""
    plt = drawing.pyplot()
    figure, axes = plt.subplots(figsize=(9, 8), facecolor=drawing.PAPER)
    jumps = ~graph.natural
    points = axes.scatter(graph.target[jumps], graph.source[jumps], c=graph.cost[jumps], s=3, cmap="viridis_r", lw=0)
    axes.set(xlim=(0, graph.node_count), ylim=(graph.node_count, -0.025 * graph.node_count))
    axes.set(
        xlabel="to node", ylabel="from node", title=f"{int(jumps.sum())} transitions of {graph.node_count} nodes\n"
    )
    for start in np.flatnonzero(np.diff(graph.clip)) + 0.5:
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


def _label_strip(axes: Any, graph: MotionGraph) -> None:
    """A strip above the picture that shows the labels of the nodes."""
    colours = drawing.label_colours(list(graph.labels))
    bounds = [0, *(np.flatnonzero(np.diff(graph.label)) + 1), graph.node_count]
    for start, end in pairwise(bounds):
        colour = colours[graph.labels[graph.label[start]]]
        axes.fill_between([start, end], -0.022 * graph.node_count, -0.004 * graph.node_count, color=colour, lw=0)
    for label in sorted({graph.labels[number] for number in graph.label}):
        axes.plot([], [], color=colours[label], lw=5, label=label or "none")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.04), ncols=8, frameon=False, fontsize=8)
