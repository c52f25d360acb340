"""What there is to say of a graph's states: how many segments and how long, and how soon others are reached."""

from typing import Any

import numpy as np

from footwork.motion.annotation import NO_WAY, Annotation
from footwork.motion.tick import TICK


def state_report(annotation: Annotation) -> dict[str, Any]:
    """JSON-able: ``states``, each with its segments, nodes and mean seconds of a segment, and ``at_once``.

    ``at_once`` has the pairs of states of which the second is to be reached from everywhere in the first: how many
    pairs of segments there are and how many of them have no way, how many segments of the first lack a way to some of
    the second, and seconds on the segments in between: the mean over all pairs, the mean to each one's nearest, the
    longest of all; None without any way. ``from_frames_s`` is the mean over the frames of the first state until the
    nearest segment of the second begins: the rest of the frame's own segment and the delay.
    """
    return {
        "segments": annotation.segment_count,
        "states": [_state(annotation, number) for number in range(len(annotation.machine.states))],
        "at_once": [_pair(annotation, pair) for pair in annotation.machine.at_once],
    }


def _state(annotation: Annotation, number: int) -> dict[str, Any]:
    length = annotation.length[annotation.of_state(number)]
    return {
        "state": annotation.machine.names[number],
        "segments": len(length),
        "nodes": int(length.sum()),
        "mean_segment_s": float(length.mean() * TICK),
    }


def _pair(annotation: Annotation, pair: tuple[int, int]) -> dict[str, Any]:
    hops = annotation.ways[annotation.machine.at_once.index(pair)]
    own = annotation.state[annotation.between(pair)] == pair[0]
    delay = hops.delay[own]
    known = delay != NO_WAY
    nearest = np.where(known, delay, np.iinfo(np.int32).max).min(axis=1, initial=np.iinfo(np.int32).max)
    some = known.any(axis=1)
    # a frame waits for the rest of its segment, its own tick included: from 1 to as many as the segment has
    wait = nearest[some] + 0.5 * (annotation.length[annotation.of_state(pair[0])][some] + 1)
    frames = annotation.length[annotation.of_state(pair[0])][some]
    return {
        "from": annotation.machine.names[pair[0]],
        "to": annotation.machine.names[pair[1]],
        "pairs": int(delay.size),
        "pairs_without_way": int((~known).sum()),
        "segments_lacking_ways": int((~known.all(axis=1)).sum()),
        "mean_s": float(delay[known].mean() * TICK) if known.any() else None,
        "nearest_s": float(nearest[some].mean() * TICK) if known.any() else None,
        "longest_s": float(delay[known].max() * TICK) if known.any() else None,
        "from_frames_s": float(np.average(wait, weights=frames) * TICK) if known.any() else None,
    }
