"""What a metric makes of some motions: the ranked costs of the best places for transitions, and their knee."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from footwork.motion.clip import Clip
from footwork.motion.metrics import metric_of
from footwork.study.drawing import pyplot
from footwork.study.plot_style import FIGURE, MARKER, add_legend, dress, save_svg
from footwork.training.knee import Knee, threshold_at_knee
from footwork.training.transitions import local_minima

SHARES = (0.01, 0.1, 0.5)


def metric_report(clips: Sequence[Clip], name: str) -> tuple[dict[str, Any], Knee]:
    """JSON-able figures of a metric over clips, and the knee of its ranked costs (conventions.md 7).

    Raises:
        InputError: for an unknown metric, or costs without a knee.
    """
    lengths = [clip.frame_count for clip in clips]
    costs = metric_of(name, clips).all_pairs()
    minima = local_minima(costs, lengths)
    knee = threshold_at_knee(minima, lengths, float(np.median(costs)))
    report = {
        "metric": name,
        "frames": len(costs),
        "local_minima": len(minima.cost),
        "threshold_at_knee": knee.threshold,
        "rank": knee.rank,
        "kneedle": knee.kneedle,
        "broken_stick": knee.broken_stick,
        "warning": knee.warning,
        "median_cost": knee.median,
        "cost_of_share_of_pairs": {f"{share:g}": float(np.quantile(costs, share)) for share in SHARES},
    }
    return report, knee


def knee_plot(knee: Knee, name: str, path: str | os.PathLike) -> Path:
    """The ranked costs with what both methods take for their knee, as an SVG."""
    figure, axes = pyplot().subplots(figsize=FIGURE)
    ranks = np.arange(1, len(knee.curve) + 1)
    axes.plot(ranks, knee.curve, color=MARKER["ink"], lw=1.4)
    for method, rank, style in (("Kneedle", knee.kneedle, "--"), ("broken stick", knee.broken_stick, ":")):
        if rank is not None:
            axes.axvline(rank, color=MARKER["well"], lw=1.2, ls=style, label=f"{method}: rank {rank}")
    height = knee.threshold / knee.median
    axes.axhline(height, color=MARKER["standard"], lw=1.0, label=f"threshold {knee.threshold:.3g}")
    dress(axes, f"Costs of the best places for transitions, {name} metric", caption="near repeats are left out")
    axes.set(xlabel="rank", ylabel="cost, multiples of the median", xlim=(0, None), ylim=(0, None))
    add_legend(axes)
    figure.tight_layout()
    return save_svg(figure, path)
