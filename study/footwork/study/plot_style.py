"""The one style of plots and pages: colours for light and dark surroundings, sizes of text, and SVG that takes them.

matplotlib draws in marker colours that stand for nothing but the variables of ``PALETTE``, which then take their place,
so that the same picture follows the reader's light or dark appearance. What stands for data (behaviours, costs) keeps
its colours, which are of middle lightness and show on both.
"""

import os
import re
from io import StringIO
from pathlib import Path
from typing import Any

from footwork.errors import InputError
from footwork.study.drawing import LABEL_COLOURS, pyplot

# variable -> (light, dark)
PALETTE = {
    "paper": ("#fbfaf7", "#16181c"),
    "card": ("#ffffff", "#1d2026"),
    "ink": ("#23272e", "#e4e6ea"),
    "faint": ("#6b717a", "#9aa1ab"),
    "grid": ("#e3e1db", "#31353d"),
    "rule": ("#d9d6ce", "#3a3f48"),
    "standard": ("#c2571a", "#f0904f"),
    "well": ("#1f6fa8", "#64b5ee"),
    "rival": ("#6b8e23", "#b5d56a"),
    "published": ("#f3f0e8", "#252932"),
    "holds": ("#2c7a4b", "#5fc488"),
    "fails": ("#b3362c", "#f0776b"),
    "open": ("#8a6d1a", "#dcb84c"),
    "failed": ("#7a3e9d", "#c490e4"),
}
_DRAWN = ("ink", "faint", "grid", "card", "standard", "well", "rival")
MARKER = {name: f"#{number:02d}{number:02d}{number:02d}" for number, name in enumerate(_DRAWN, 1)}
"""The colour to draw in for each variable that plots use."""
BEHAVIOUR_COLOURS = {"stop": LABEL_COLOURS["idle"], **{name: LABEL_COLOURS[name] for name in ("walk", "run", "jump")}}
RAMP = ("#3f8fd0", "#9b6fc0", "#e0653a")
"""From low to high: of one middle lightness, so that no end of it is lost on any ground."""
FIGURE = (7.2, 4.2)  # inches: text of 9 points is then as large as a page's small print
_TITLE, _TEXT, _SMALL = 9.5, 8.5, 8.0  # points
# the head of a file, a style that would hold for all of a page, names that figures share
_LEFT_OUT = (
    r"^.*?(?=<svg)",
    r"<metadata>.*?</metadata>\s*",
    r"<style.*?</style>",
    r'(?<=<g) id="[^"]*"',
)
_SIZE = r'(?<=<svg) height="[^"]*"| (?:width|height)="[^"]*pt"'
_FONT = 'text { font-family: system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif !important; }'


def stylesheet() -> str:
    """The palette's variables as CSS, for light and dark."""
    light, dark = (
        " ".join(f"--{name}: {colours[number]};" for name, colours in PALETTE.items()) for number in range(2)
    )
    return (
        f":root {{ color-scheme: light dark; {light} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n"
    )


def ramp() -> Any:
    """RAMP as a colour map of matplotlib's; what is masked is left blank."""
    pyplot()
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("ramp", RAMP).with_extremes(bad=(0.0, 0.0, 0.0, 0.0))


def dress(axes: Any, title: str, *, caption: str = "", grid: str | None = "both") -> None:
    """Give axes their title, a line under it, the colours of the text and a grid along ``grid``, None for no grid."""
    axes.set_facecolor("none")
    axes.set_axisbelow(True)
    axes.set_title(f"{title}\n" if caption else title, fontsize=_TITLE, color=MARKER["ink"])
    if caption:
        words = {"ha": "center", "va": "bottom", "fontsize": _SMALL, "color": MARKER["faint"]}
        axes.annotate(caption, (0.5, 1.0), xytext=(0, 4), xycoords="axes fraction", textcoords="offset points", **words)
    if grid is not None:
        axes.grid(color=MARKER["grid"], lw=0.6, axis=grid)
    axes.tick_params(which="both", colors=MARKER["faint"], labelsize=_SMALL)
    for spine in axes.spines.values():
        spine.set_color(MARKER["faint"])
    axes.spines[["top", "right"]].set_visible(False)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set(fontsize=_TEXT, color=MARKER["ink"])


def add_legend(of: Any, *handles: Any, **options: Any) -> None:
    """Put a legend without a frame into axes or a figure."""
    legend = of.legend(*handles, frameon=False, **options)
    for text in legend.get_texts():
        text.set(color=MARKER["ink"], fontsize=_TEXT)


def add_scale(figure: Any, image: Any, axes: Any, label: str) -> None:
    """Put the scale of a picture's colours beside it."""
    bar = figure.colorbar(image, ax=axes, fraction=0.04, pad=0.03)
    bar.ax.tick_params(labelsize=_SMALL, colors=MARKER["faint"])
    bar.outline.set_edgecolor(MARKER["faint"])
    bar.set_label(label, fontsize=_TEXT, color=MARKER["ink"])


def inline_svg(figure: Any) -> str:
    """A figure as an SVG element that is as wide as its place in a page with ``stylesheet``; closes the figure."""
    return re.sub(_SIZE, "", _svg(figure))


def save_svg(figure: Any, path: str | os.PathLike) -> Path:
    """Write a figure as an SVG file that brings its own style, whole or not at all, and close it.

    Raises:
        InputError: for a place that cannot be written.
    """
    path = Path(path)
    part = path.with_name(path.name + ".part")
    style = f"<style>\n{stylesheet()}svg {{ background: var(--card); }}\n{_FONT}\n</style>"
    try:
        part.write_text(re.sub(r"(<svg[^>]*>)", rf"\1{style}", _svg(figure), count=1), encoding="utf-8")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise InputError(f"cannot be written ({error.strerror})", path) from None
    return path


def _svg(figure: Any) -> str:
    plt, out = pyplot(), StringIO()
    salt = str(len(figure.axes)) + "".join(axes.get_title() + axes.get_ylabel() for axes in figure.axes)
    with plt.rc_context({"svg.fonttype": "none", "svg.hashsalt": salt}):
        figure.savefig(out, format="svg", transparent=True, dpi=110, metadata={"Date": None})
    plt.close(figure)
    svg = out.getvalue()
    for left_out in _LEFT_OUT:
        svg = re.sub(left_out, "", svg, flags=re.DOTALL)
    names = {colour: name for name, colour in MARKER.items()}
    return re.sub("|".join(names), lambda found: f"var(--{names[found.group()]})", svg)
