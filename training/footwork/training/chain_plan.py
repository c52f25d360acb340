"""What interpolated chains are made of: pairs of segments at weights, aligned and timed."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.training.blend_kernels import align_starts
from footwork.training.blended_poses import Blend
from footwork.training.segments import Segments
from footwork.training.source_tracks import Tracks
from footwork.training.timing import Timing, row_positions, timing_of

ALIGNED_FRAMES = 5


class Plan(NamedTuple):
    """C chains: the first source is a segment p, the second a segment q."""

    pairs: NDArray[np.intp]  # (C, 2) p and q
    weights: NDArray[np.float64]  # (C,) share of p
    timing: Timing
    bounds: NDArray[np.intp]  # (C, 4) first and last frame of p's clip, then of q's, on the tracks
    move: NDArray[np.float64]  # (C, 3) yaw, x, z that align q to p
    airborne: NDArray[np.bool_]  # (C,)


def plan_of(segments: Segments, tracks: Tracks, pairs: ArrayLike, weights: ArrayLike) -> Plan:
    """Chains of the given pairs (C, 2), each with the weight of its first source (C,).

    Pairs at several weights should stand next to each other: they are aligned once.
    """
    pairs = np.asarray(pairs, dtype=np.intp).reshape(-1, 2)
    timing = timing_of(segments, pairs, weights)
    clips = segments.clip[pairs]
    first, last = tracks.start[clips], tracks.start[clips + 1] - 1
    bounds = np.stack([first[:, 0], last[:, 0], first[:, 1], last[:, 1]], axis=1)
    new = np.append(True, (pairs[1:] != pairs[:-1]).any(axis=1))[: len(pairs)]
    move = np.empty((int(new.sum()), 3))
    align_starts(tracks.places, (first + segments.start[pairs])[new], last[new], ALIGNED_FRAMES, move)
    return Plan(
        pairs,
        np.asarray(weights, dtype=np.float64),
        timing,
        bounds,
        move[np.cumsum(new) - 1],
        segments.airborne[pairs[:, 0]],
    )


def blend_of(plan: Plan, chains: NDArray[np.intp]) -> Blend:
    """The rows of some chains of a plan, context included."""
    which, position = row_positions(plan.timing, chains)
    bounds = plan.bounds[chains]
    return Blend(
        which,
        position + bounds[which][:, [0, 2]],
        bounds,
        plan.weights[chains],
        plan.move[chains],
        plan.airborne[chains],
    )
