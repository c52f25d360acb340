"""The order in which the reduction takes original frames, and how it deals them to its streams of searches."""

import numpy as np
from numpy.typing import NDArray

from footwork.training.path_cost import UNIT


def runs_of_originals(
    originals: int, start: NDArray, target: NDArray, base: NDArray, order: str, seed: int
) -> list[NDArray[np.intp]]:
    """The originals clip by clip, each clip from its last frame to its first.

    Args:
        originals: the nodes 0 .. originals - 1 are the original frames.
        start: where the edges of each node start.  # (N + 1,)
        target: the node each edge leads to.  # (E,)
        base: its path cost; natural edges have UNIT.  # (E,)
        order: of the clips, one of ``graph_options.ORDERS``.
        seed: for the random order.
    """
    leaving = slice(0, start[originals])
    source = np.repeat(np.arange(originals), np.diff(start[: originals + 1]))
    natural = (target[leaving] == source + 1) & (source + 1 < originals) & (base[leaving] == UNIT)
    last = np.ones(originals, dtype=bool)
    last[source[natural]] = False
    runs = [run[::-1] for run in np.split(np.arange(originals), np.flatnonzero(last)[:-1] + 1)]
    if order == "reverse":
        return runs[::-1]
    if order == "random":
        return [runs[k] for k in np.random.default_rng(seed).permutation(len(runs))]
    return runs


def dealt(runs: list[NDArray[np.intp]], streams: int) -> list[list[NDArray[np.intp]]]:
    """The runs of each stream, in their order: the longest first, each to the stream with the fewest frames so far."""
    frames, dealt_to = [0] * streams, [0] * len(runs)
    for k in sorted(range(len(runs)), key=lambda k: -len(runs[k])):
        dealt_to[k] = frames.index(min(frames))
        frames[dealt_to[k]] += len(runs[k])
    return [[run for run, mine in zip(runs, dealt_to, strict=True) if mine == stream] for stream in range(streams)]
