"""The threshold of a build, where it is left to the data: at the knee of the captured frames' costs."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from footwork.motion.clip import Clip
from footwork.motion.metrics import metric_of
from footwork.training.graph_options import GraphOptions
from footwork.training.knee import threshold_at_knee
from footwork.training.stages import Stages
from footwork.training.transitions import local_minima


def chosen(clips: Sequence[Clip], options: GraphOptions, stages: Stages) -> tuple[GraphOptions, dict[str, Any]]:
    """The options with a threshold that is a number, and how it came about where it was "auto" (conventions.md 7).

    Raises:
        InputError: where the costs have no knee.
    """
    if options.threshold != "auto":
        return options, {}
    with stages("threshold"):
        lengths = [clip.frame_count for clip in clips]
        knee = threshold_at_knee(local_minima(metric_of(options.metric, clips).all_pairs(), lengths), lengths)
    found = {"rank": knee.rank, "kneedle": knee.kneedle, "broken_stick": knee.broken_stick, "warning": knee.warning}
    return replace(options, threshold=knee.threshold), {"knee": found}
