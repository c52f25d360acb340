"""Painting figures: from balls in the world to shaded polygons in depth order, with matplotlib and no window."""

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from footwork.errors import InputError
from footwork.study.camera import Camera
from footwork.study.figure import LEFT, RIGHT, SKIN, TRUNK, Part, ball_places

PAPER = "#fbfaf7"
GROUND = "#eceae4"
INK = "#3a3f47"
FAINT = "#8d929a"
PAINTS = {LEFT: "#2f7fb8", RIGHT: "#e0703a", TRUNK: "#68717f", SKIN: "#e8c4a0"}
LABEL_COLOURS = {
    "idle": "#9aa5b1",
    "walk": "#4c9f70",
    "turn": "#e3b23c",
    "run": "#d1495b",
    "jump": "#8e6bbf",
    "duck": "#3d8ea8",
}
_SPARE_COLOURS = ("#b5838d", "#6d9dc5", "#c08552", "#7a9e4f", "#d17ba0", "#5b6c9d", "#a3a847", "#bc6c4a")
_CIRCLE = np.stack([np.cos(np.linspace(0, 2 * np.pi, 20, False)), np.sin(np.linspace(0, 2 * np.pi, 20, False))], axis=1)
_GROUND_CIRCLE = np.stack([_CIRCLE[:, 0], np.zeros(len(_CIRCLE)), _CIRCLE[:, 1]], axis=1)
_LIGHT = np.array([-0.25, 0.35])


def pyplot() -> Any:
    """matplotlib's pyplot drawing to files only.

    Raises:
        InputError: where matplotlib is not installed.
    """
    try:
        import matplotlib
    except ImportError:
        raise InputError("matplotlib is missing, run: pip install footwork[plots]", "plots") from None
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    return plt


def save(figure: Any, path: str | os.PathLike, dpi: int = 100) -> Path:
    """Write a figure as PNG, whole or not at all, and close it.

    Raises:
        InputError: for a place that cannot be written.
    """
    path = Path(path)
    part = path.with_name(path.name + ".part")
    try:
        figure.savefig(part, dpi=dpi, format="png", facecolor=figure.get_facecolor(), metadata={"Software": None})
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise InputError(f"cannot be written ({error.strerror})", path) from None
    finally:
        pyplot().close(figure)
    return path


def mix(colour: str, other: str, share: float) -> str:
    """``colour`` with a share 0..1 of ``other``, both ``#rrggbb``."""
    a, b = (np.array([int(c[i : i + 2], 16) for i in (1, 3, 5)]) for c in (colour, other))
    red, green, blue = np.rint(a + np.clip(share, 0.0, 1.0) * (b - a)).astype(int)
    return f"#{red:02x}{green:02x}{blue:02x}"


def label_colours(labels: list[str]) -> dict[str, str]:
    """A colour for each label: the same for the usual ones, spare ones in turn for the rest."""
    others = sorted({label for label in labels if label and label not in LABEL_COLOURS})
    spare = {label: _SPARE_COLOURS[i % len(_SPARE_COLOURS)] for i, label in enumerate(others)}
    return LABEL_COLOURS | spare | {"": "#d8d6d0"}


@dataclass
class Canvas:
    """Polygons to paint, in order, with their fill and edge colours."""

    polygons: list[NDArray] = field(default_factory=list)
    fills: list[str] = field(default_factory=list)
    edges: list[str] = field(default_factory=list)

    def add(self, polygon: NDArray, fill: str, edge: str = "none") -> None:
        """Put one polygon (points, 2) above all those before."""
        self.polygons.append(polygon)
        self.fills.append(fill)
        self.edges.append(edge)

    def paint(self, axes: Any, line_width: float = 0.5, zorder: float = 3.0) -> None:
        """Draw all polygons on matplotlib axes, by default above all lines there."""
        from matplotlib.collections import PolyCollection

        axes.add_collection(
            PolyCollection(
                self.polygons, facecolors=self.fills, edgecolors=self.edges, linewidths=line_width, zorder=zorder
            )
        )


def hull(centres: NDArray, radii: NDArray) -> NDArray[np.float64]:
    """The outline of the convex hull of circles.  # (n, 2), (n,) -> (points, 2)"""
    points = (centres[:, None, :] + radii[:, None, None] * _CIRCLE).reshape(-1, 2)
    return points[ConvexHull(points).vertices]


def add_figure(
    canvas: Canvas,
    parts: list[Part],
    places: NDArray,
    turns: NDArray,
    camera: Camera,
    *,
    shift: tuple[float, float] = (0.0, 0.0),
    fade: float = 0.0,
) -> None:
    """Paint one pose, far parts first and a little paler.

    Args:
        canvas: what to paint on.
        parts: the shape, ``figure.body_parts``.
        places: of the joints in the world.  # (J, 3)
        turns: world rotations of the joints.  # (J, 4)
        camera: how to look at it.
        shift: added to the places on the picture, metres.
        fade: share of paper mixed into all colours.
    """
    centres, depth, scale = camera.project(ball_places(parts, places, turns))
    centres = centres + shift
    middle = camera.project(places[0])[1]
    counts = [len(part.balls) for part in parts]
    first = np.cumsum([0, *counts[:-1]])
    away = [depth[i : i + n].mean() - part.lift for i, n, part in zip(first, counts, parts, strict=True)]
    for index in np.argsort(away)[::-1]:
        span = slice(first[index], first[index] + counts[index])
        radii = np.array([ball.radius for ball in parts[index].balls]) * scale[span]
        paper = fade + (1.0 - fade) * float(np.clip(0.9 * (away[index] - middle), 0.0, 0.22))
        _add_part(canvas, centres[span], radii, mix(PAINTS[parts[index].paint], PAPER, paper))


def _add_part(canvas: Canvas, centres: NDArray, radii: NDArray, colour: str) -> None:
    canvas.add(hull(centres, radii), colour, mix(colour, INK, 0.45))
    canvas.add(hull(centres + radii[:, None] * _LIGHT, 0.5 * radii), mix(colour, "#ffffff", 0.22))


def add_shadow(
    canvas: Canvas,
    parts: list[Part],
    places: NDArray,
    turns: NDArray,
    camera: Camera,
    *,
    grow: float,
    colour: str,
    shift: tuple[float, float] = (0.0, 0.0),
) -> None:
    """Paint one layer of a soft shadow: the body pressed flat onto the ground, ``grow`` metres wider."""
    balls = ball_places(parts, places, turns)
    # the light falls from above and a little from the left and the front
    ground = (balls - 0.12 * balls[:, 1:2]) * [1.0, 0.0, 1.0]
    radii = np.array([ball.radius for part in parts for ball in part.balls]) + grow
    rings = camera.project(ground[:, None] + radii[:, None, None] * _GROUND_CIRCLE)[0] + shift
    start = 0
    for part in parts:
        picture = rings[start : start + len(part.balls)].reshape(-1, 2)
        start += len(part.balls)
        if np.ptp(picture[:, 1]) > 1e-6:  # seen from the level it has no area
            canvas.add(picture[ConvexHull(picture).vertices], colour)
