"""Pictures of matrices of costs, and of where two metrics differ."""

from collections.abc import Sequence
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.study import drawing
from footwork.training.transitions import Minima

_BRIGHTEST = 2.0  # medians: a cost so high is white
_UNLIKE = 1.0  # medians: a difference so large has full colour
_POINTS = {"uniform": "#e0703a", "dynamics": "#1f6fa8", "both": "#23272e"}


def cost_picture(
    costs: Sequence[tuple[str, NDArray]], difference: NDArray, picks: Sequence[tuple[str, Minima]]
) -> bytes:
    """Matrices in medians of their own side by side, then a difference of two with chosen points, as a PNG.

    Args:
        costs: titles and matrices.  # (N, N) each
        difference: in the same measure.  # (N, N)
        picks: kinds ("uniform", "dynamics" or "both") and the points chosen by them.
    """
    plt = drawing.pyplot()
    figure, grid = plt.subplots(1, len(costs) + 1, figsize=(11.4, 3.3), facecolor=drawing.PAPER)
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
    out = BytesIO()
    figure.savefig(out, dpi=130, format="png", facecolor=figure.get_facecolor(), metadata={"Software": None})
    plt.close(figure)
    return out.getvalue()


def _words(kind: str) -> str:
    return "picked by both" if kind == "both" else f"by {kind} alone"


def _dress(axes: Any, title: str, figure: Any, image: Any, unit: str) -> None:
    axes.set_title(title, fontsize=9.5, color=drawing.INK)
    axes.tick_params(labelsize=7, colors=drawing.FAINT)
    axes.set_xlabel("frame", fontsize=8, color=drawing.INK)
    bar = figure.colorbar(image, ax=axes, fraction=0.046, pad=0.03)
    bar.ax.tick_params(labelsize=7, colors=drawing.FAINT)
    bar.set_label(unit, fontsize=8, color=drawing.INK)


def contrast(costs: NDArray[np.float64], apart: int) -> float:
    """Standard deviation over median of the costs of frames at least so many apart."""
    values = costs[np.triu_indices(len(costs), apart)]
    return float(values.std() / np.median(values))


def middle_half(costs: NDArray[np.float64], apart: int) -> float:
    """Width of the middle half of them over their median, which a few very unlike frames do not widen."""
    low, median, high = np.percentile(costs[np.triu_indices(len(costs), apart)], [25.0, 50.0, 75.0])
    return float((high - low) / median)
