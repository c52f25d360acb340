"""Pictures of matrices of costs, and of where two metrics differ."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.study.drawing import pyplot
from footwork.study.plot_style import add_scale, dress, inline_svg
from footwork.training.transitions import Minima

_BRIGHTEST = 2.0  # medians: a cost so high is white
_UNLIKE = 1.0  # medians: a difference so large has full colour
_POINTS = {"uniform": "#e0703a", "dynamics": "#1f6fa8", "both": "#23272e"}


def cost_picture(costs: Sequence[tuple[str, NDArray]], difference: NDArray, picks: Sequence[tuple[str, Minima]]) -> str:
    """Matrices in medians of their own side by side, then a difference of two with chosen points, as an inline SVG.

    Args:
        costs: titles and matrices.  # (N, N) each
        difference: in the same measure.  # (N, N)
        picks: kinds ("uniform", "dynamics" or "both") and the points chosen by them.
    """
    figure, grid = pyplot().subplots(1, len(costs) + 1, figsize=(9.6, 3.0))
    for axes, (title, values) in zip(grid, costs, strict=False):
        image = axes.imshow(values, cmap="gray", vmin=0.0, vmax=_BRIGHTEST)
        _dress(axes, title, figure, image, "medians")
    axes = grid[-1]
    image = axes.imshow(difference, cmap="RdBu_r", vmin=-_UNLIKE, vmax=_UNLIKE)
    _dress(axes, "dynamics less uniform, and picks", figure, image, "medians")
    for kind, points in picks:
        axes.plot(points.j, points.i, "o", ms=3.6, mec="white", mew=0.4, color=_POINTS[kind], label=_words(kind))
    axes.legend(loc="lower left", fontsize=7, framealpha=0.85)
    figure.tight_layout()
    return inline_svg(figure)


def _words(kind: str) -> str:
    return "picked by both" if kind == "both" else f"by {kind} alone"


def _dress(axes: Any, title: str, figure: Any, image: Any, unit: str) -> None:
    dress(axes, title, grid=None)
    axes.set_xlabel("frame")
    add_scale(figure, image, axes, unit)


def contrast(costs: NDArray[np.float64], apart: int) -> float:
    """Standard deviation over median of the costs of frames at least so many apart."""
    values = costs[np.triu_indices(len(costs), apart)]
    return float(values.std() / np.median(values))


def middle_half(costs: NDArray[np.float64], apart: int) -> float:
    """Width of the middle half of them over their median, which a few very unlike frames do not widen."""
    low, median, high = np.percentile(costs[np.triu_indices(len(costs), apart)], [25.0, 50.0, 75.0])
    return float((high - low) / median)
