"""Which segments are interpolated with which: those carried by the same feet that some rule lets pass."""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.angle import wrapped
from footwork.training.graph_options import PAIRINGS
from footwork.training.room import require_room
from footwork.training.segments import Segments

LARGEST_RATIO = 2.0
LARGEST_TURN = np.radians(30.0)  # by which the yaw changes of two flights may differ
_BYTES_PER_PAIR = 100  # while they are listed and sorted


def pairs_of(segments: Segments, rule: str = "ratio") -> NDArray[np.intp]:
    """Pairs of different segments p < q of equal signature, sorted.  # (P, 2)

    Flights whose yaw changes differ by more than LARGEST_TURN are never paired: bodies that turn differently in the
    air keep no angular momentum between them (Safonova and Hodgins 2005).

    Args:
        segments: of all clips.
        rule: ``plain`` for all pairs, ``ratio`` for those of which neither lasts more than twice as long as the
            other, ``neighbours`` for those with equal signatures before and after them besides.

    Raises:
        InputError: for another rule, or more pairs than memory has room for.
    """
    if rule not in PAIRINGS:
        raise InputError(f"no pairing rule {rule!r}, expected one of {', '.join(PAIRINGS)}", "pairing")
    keys = [segments.signature]
    if rule == "neighbours":
        keys += [segments.neighbour(-1), segments.neighbour(1)]
    pairs = _equal_pairs(np.stack(keys, axis=1))
    keep = _turn_alike(segments, pairs)
    if rule != "plain":
        frames = segments.frames[pairs]
        keep &= frames.max(axis=1) <= LARGEST_RATIO * frames.min(axis=1)
    return pairs[keep]


def _equal_pairs(keys: NDArray[np.intp]) -> NDArray[np.intp]:
    """All p < q whose rows of keys are equal, sorted.  # (S, K) -> (P, 2)"""
    kinds = np.unique(keys, axis=0, return_inverse=True)[1].ravel()
    groups = [np.flatnonzero(kinds == kind) for kind in range(kinds.max(initial=-1) + 1)]
    count = sum(len(group) * (len(group) - 1) // 2 for group in groups)
    require_room(_BYTES_PER_PAIR * count, f"{count} pairs of {len(keys)} stretches of motion", "use fewer clips")
    within = [np.stack(np.triu_indices(len(group), 1), axis=1) for group in groups]
    pairs = [group[pair] for group, pair in zip(groups, within, strict=True)]
    joined = np.concatenate([np.zeros((0, 2), np.intp), *pairs])
    return joined[np.lexsort(joined.T[::-1])]


def _turn_alike(segments: Segments, pairs: NDArray[np.intp]) -> NDArray[np.bool_]:
    p, q = pairs.T
    apart = np.abs(wrapped(segments.yaw_change[p] - segments.yaw_change[q]))
    return ~segments.airborne[p] | (apart <= LARGEST_TURN)
