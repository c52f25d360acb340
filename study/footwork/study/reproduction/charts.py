"""Charts as inline SVG in the page's own colours, so that they follow its light and dark appearance."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.study import plot_style
from footwork.study.drawing import pyplot
from footwork.study.plot_style import FIGURE, MARKER

STANDARD, WELL = "standard", "well"
_LEGEND_MARK, _LEGEND_LETTER = 0.6, 0.065  # inches that a line of the legend and a letter beside it take, about


@dataclass(frozen=True)
class Series:
    """One line of a chart.

    Args:
        name: for the legend.
        x: places across.
        y: places up; entries that are not finite leave a gap.
        graph: STANDARD or WELL, which gives the colour, or another of the style sheet's variables.
        published: drawn dashed and hollow; ours are solid and full.
        marks: whether each point has a mark.
    """

    name: str
    x: ArrayLike
    y: ArrayLike | Sequence[float | None]
    graph: str
    published: bool = False
    marks: bool = True


@dataclass(frozen=True)
class Axis:
    """An axis: its label with the unit, whether it is logarithmic, its limits and ticks where they are not free."""

    label: str
    log: bool = False
    limits: tuple[float | None, float | None] | None = None
    ticks: Sequence[float] | None = None


def line_charts(panels: Sequence[tuple[str, Sequence[Series], Axis, Axis]], height: float = 3.2) -> str:
    """Panels side by side, each a title, its series, its x axis and its y axis, under one legend."""
    figure, grid = pyplot().subplots(1, len(panels), figsize=(FIGURE[0], height), squeeze=False)
    for axes, (title, series, x, y) in zip(grid[0], panels, strict=True):
        for one in series:
            _draw_series(axes, one)
        _dress(axes, title, x, y)
    handles = {line.get_label(): line for axes in grid[0] for line in axes.get_lines()}
    widest = _LEGEND_MARK + _LEGEND_LETTER * max(len(str(name)) for name in handles)
    columns = min(len(handles), 4, max(1, int(FIGURE[0] / widest)))
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.22 * (1 + (len(handles) - 1) // columns) / height))
    plot_style.add_legend(figure, list(handles.values()), list(handles), loc="upper center", ncols=columns)
    return plot_style.inline_svg(figure)


def matrix_panels(panels: Sequence[tuple[str, NDArray]], columns: int, x: str, y: str) -> str:
    """Matrices of values 0..1 as pictures, white at 1, in rows of ``columns``."""
    rows = -(-len(panels) // columns)
    size = FIGURE[0], rows * FIGURE[0] / columns * 1.08
    figure, grid = pyplot().subplots(rows, columns, figsize=size, squeeze=False)
    for axes in grid.flat:
        axes.axis("off")
    for axes, (title, values) in zip(grid.flat, panels, strict=False):
        axes.axis("on")
        axes.imshow(values, cmap="gray", vmin=0.0, vmax=1.0, interpolation="none", extent=(0, 1, 1, 0))
        _dress(axes, title, Axis(x, ticks=()), Axis(y, ticks=()))
        axes.grid(visible=False)
    figure.tight_layout()
    return plot_style.inline_svg(figure)


def _draw_series(axes: Any, series: Series) -> None:
    colour = MARKER[series.graph]
    axes.plot(
        np.asarray(series.x, dtype=float),
        np.asarray(series.y, dtype=float),
        color=colour,
        label=series.name,
        lw=1.4,
        ls=(0, (4, 2)) if series.published else "-",
        marker=("o" if series.graph == WELL else "s") if series.marks else None,
        ms=4.5,
        mfc="none" if series.published else colour,
    )


def _dress(axes: Any, title: str, x: Axis, y: Axis) -> None:
    plot_style.dress(axes, title)
    for axis, place in ((x, axes.xaxis), (y, axes.yaxis)):
        _dress_axis(axes, place, axis)


def _dress_axis(axes: Any, place: Any, axis: Axis) -> None:
    from matplotlib.ticker import NullFormatter, ScalarFormatter

    across = place is axes.xaxis
    place.set_label_text(axis.label)
    if axis.log:
        (axes.set_xscale if across else axes.set_yscale)("log")
    if axis.limits:
        (axes.set_xlim if across else axes.set_ylim)(*axis.limits)
    if axis.ticks is not None:
        place.set_ticks(axis.ticks)
        if axis.log:
            place.set_minor_formatter(NullFormatter())
            place.set_major_formatter(ScalarFormatter())
