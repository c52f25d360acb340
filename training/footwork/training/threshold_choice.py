"""The threshold of a build, where it is left to the data: at the knee of the captured frames' costs."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.metrics import metric_of
from footwork.training.graph_options import USUAL_THRESHOLD, GraphOptions
from footwork.training.knee import threshold_at_knee
from footwork.training.stages import Stages
from footwork.training.transitions import local_minima


def chosen(clips: Sequence[Clip], options: GraphOptions, stages: Stages) -> tuple[GraphOptions, dict[str, Any]]:
    """The options with a threshold that is a number, and how it came about where it was to be found (conventions.md 7).

    It is the knee of "auto"; of an annotated graph without a threshold it is the knee, if above the usual one.

    Raises:
        InputError: where the costs have no knee, and one is asked for.
    """
    if options.threshold not in ("auto", None):
        return options, {}
    with stages("threshold"):
        lengths = [clip.frame_count for clip in clips]
        minima = local_minima(metric_of(options.metric, clips).all_pairs(), lengths)
        try:
            knee = threshold_at_knee(minima, lengths)
        except InputError:
            if options.threshold == "auto":
                raise
            return replace(options, threshold=USUAL_THRESHOLD), {}
    found = {"rank": knee.rank, "kneedle": knee.kneedle, "broken_stick": knee.broken_stick, "warning": knee.warning}
    if options.threshold is None and knee.threshold < USUAL_THRESHOLD:
        return replace(options, threshold=USUAL_THRESHOLD), {}
    return replace(options, threshold=knee.threshold), {"knee": found}
