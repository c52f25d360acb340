"""How many motions are made between two segments, and at which weights."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.alignment import turn
from footwork.motion.metric import UNIT
from footwork.training.segments import Segments
from footwork.training.source_tracks import Tracks

_PHASES = (0.0, 0.25, 0.5, 0.75, 1.0)


def weights_of_pairs(counts: NDArray[np.intp]) -> NDArray[np.float64]:
    """The weights 1 / (n + 1), ..., n / (n + 1) of every pair, one after the other.  # (P,) -> (sum(counts),)"""
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return (place + 1.0) / np.repeat(counts + 1.0, counts)


def needed_weights(distances: NDArray[np.float64], threshold: float, most: int) -> NDArray[np.intp]:
    """How many motions between two segments let a character hop from one to the other under a threshold.  # (P,)

    A hop from one motion to the next advances by at most the root mean square distance r that the threshold allows,
    so d / r - 1 are needed between segments d apart; none where the two are near enough by themselves (convention).

    Args:
        distances: of the pairs, metres.  # (P,)
        threshold: of s (conventions.md 2).
        most: the largest number.
    """
    hops = distances / (UNIT * np.sqrt(threshold))
    return np.clip(np.ceil(hops) - 1.0, 0, most).astype(np.intp)


def pair_distances(
    segments: Segments, tracks: Tracks, pairs: NDArray[np.intp], move: NDArray[np.float64]
) -> NDArray[np.float64]:
    """How far the joints of two segments are apart, root mean square at equal phase, averaged over phases.  # (P,)

    Args:
        segments: of all clips.
        tracks: of the clips.
        pairs: segments p and q.  # (P, 2)
        move: yaw, x and z that align q to p.  # (P, 3)
    """
    frames = segments.frames[pairs] - 1
    first = tracks.start[segments.clip[pairs]] + segments.start[pairs]
    apart = []
    for phase in _PHASES:
        here, there = np.moveaxis(tracks.places[first + np.rint(phase * frames).astype(np.intp)], 1, 0)
        x, z = turn(there[..., 0], there[..., 2], move[:, :1])
        moved = np.stack([x + move[:, 1:2], there[..., 1], z + move[:, 2:]], axis=-1)
        apart.append(np.sqrt(np.sum((here - moved) ** 2, axis=-1).mean(axis=-1)))
    return np.mean(apart, axis=0)
