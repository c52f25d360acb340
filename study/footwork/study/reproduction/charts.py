"""Charts as inline SVG in the page's own colours, so that they follow its light and dark appearance.

matplotlib draws them in marker colours that stand for nothing but the page's variables, which then take their place.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.study import drawing

# marker colour -> variable of the page's style sheet
_VARIABLES = {
    "#010101": "ink",
    "#020202": "faint",
    "#030303": "grid",
    "#040404": "standard",
    "#050505": "well",
    "#060606": "rival",
}
_COLOUR = {name: marker for marker, name in _VARIABLES.items()}
STANDARD, WELL = "standard", "well"
# the head of a file, a size of its own, a style that would hold for all of the page, names that figures share
_LEFT_OUT = (
    r"^.*?(?=<svg)",
    r"<metadata>.*?</metadata>\s*",
    r"<style.*?</style>",
    r'(?<=<svg) height="[^"]*"| (?:width|height)="[^"]*pt"',
    r'(?<=<g) id="[^"]*"',
)
_WIDTH = 7.2  # inches: text of 9 points is then as large as the page's small print


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
    plt = drawing.pyplot()
    figure, grid = plt.subplots(1, len(panels), figsize=(_WIDTH, height), squeeze=False)
    for axes, (title, series, x, y) in zip(grid[0], panels, strict=True):
        for one in series:
            _draw_series(axes, one)
        _dress(axes, title, x, y)
    handles = {line.get_label(): line for axes in grid[0] for line in axes.get_lines()}
    columns = min(len(handles), 4)
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.22 * (1 + (len(handles) - 1) // columns) / height))
    legend = figure.legend(list(handles.values()), list(handles), loc="upper center", ncols=columns, frameon=False)
    for text in legend.get_texts():
        text.set_color(_COLOUR["ink"])
        text.set_fontsize(8.5)
    return _svg(figure)


def matrix_panels(panels: Sequence[tuple[str, NDArray]], columns: int, x: str, y: str) -> str:
    """Matrices of values 0..1 as pictures, white at 1, in rows of ``columns``."""
    plt = drawing.pyplot()
    rows = -(-len(panels) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(_WIDTH, rows * _WIDTH / columns * 1.08), squeeze=False)
    for axes in grid.flat:
        axes.axis("off")
    for axes, (title, values) in zip(grid.flat, panels, strict=False):
        axes.axis("on")
        axes.imshow(values, cmap="gray", vmin=0.0, vmax=1.0, interpolation="none", extent=(0, 1, 1, 0))
        _dress(axes, title, Axis(x, ticks=()), Axis(y, ticks=()))
        axes.grid(visible=False)
    figure.tight_layout()
    return _svg(figure)


def _draw_series(axes: Any, series: Series) -> None:
    colour = _COLOUR[series.graph]
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
    axes.set_title(title, fontsize=9.5, color=_COLOUR["ink"])
    axes.set_facecolor("none")
    axes.grid(color=_COLOUR["grid"], lw=0.6)
    axes.tick_params(which="both", colors=_COLOUR["faint"], labelsize=8)
    for spine in axes.spines.values():
        spine.set_color(_COLOUR["faint"])
    axes.spines[["top", "right"]].set_visible(False)
    for axis, place in ((x, axes.xaxis), (y, axes.yaxis)):
        _dress_axis(axes, place, axis)


def _dress_axis(axes: Any, place: Any, axis: Axis) -> None:
    from matplotlib.ticker import NullFormatter, ScalarFormatter

    across = place is axes.xaxis
    place.set_label_text(axis.label, fontsize=8.5, color=_COLOUR["ink"])
    if axis.log:
        (axes.set_xscale if across else axes.set_yscale)("log")
    if axis.limits:
        (axes.set_xlim if across else axes.set_ylim)(*axis.limits)
    if axis.ticks is not None:
        place.set_ticks(axis.ticks)
        if axis.log:
            place.set_minor_formatter(NullFormatter())
            place.set_major_formatter(ScalarFormatter())


def _svg(figure: Any) -> str:
    """The figure as an SVG element that is as wide as its place, with the page's fonts and colours."""
    plt = drawing.pyplot()
    out = StringIO()
    salt = str(len(figure.axes)) + "".join(axes.get_title() + axes.get_ylabel() for axes in figure.axes)
    with plt.rc_context({"svg.fonttype": "none", "svg.hashsalt": salt}):
        figure.savefig(out, format="svg", transparent=True, metadata={"Date": None})
    plt.close(figure)
    svg = out.getvalue()
    for left_out in _LEFT_OUT:
        svg = re.sub(left_out, "", svg, flags=re.DOTALL)
    return re.sub("|".join(_VARIABLES), lambda found: f"var(--{_VARIABLES[found.group()]})", svg)
