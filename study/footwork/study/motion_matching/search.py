"""The search for the frame with the nearest features, by boxes around 16 and 64 frames.

A frame is no nearer than the box it lies in, and a sum of squares no less than a part of it: boxes and frames that
cannot beat the best are left as soon as that is known, as the public reference implementation does. Its boxes are
around frames that follow each other; here they are around frames that are alike, which leaves a tenth of them to look
into. What may be searched is laid out in sets, such as the frames of one behaviour.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.arrays import frozen

SMALL, LARGE = 16, 64
_INSIDE = LARGE // SMALL
NOWHERE = -1


class SearchSets(NamedTuple):
    """Sets of frames with their features and boxes: S small boxes in L large ones, read-only.

    Each set is filled up to whole large boxes with frames NOWHERE, which are infinitely far.

    Args:
        frames: the frame of every row.  # (S * SMALL,) int32
        rows: its features.  # (S * SMALL, 27) float32
        small: least and greatest features of the small boxes.  # (2, S, 27) float32
        large: least and greatest features of the large boxes.  # (2, 27, L) float32
        start: set t has the large boxes ``start[t]:start[t + 1]``.  # (T + 1,)
    """

    frames: NDArray[np.int32]
    rows: NDArray[np.float32]
    small: NDArray[np.float32]
    large: NDArray[np.float32]
    start: NDArray[np.int64]


def search_sets(values: NDArray[np.float32], members: Sequence[NDArray[np.intp]]) -> SearchSets:
    """Lay out sets of frames.

    Args:
        values: features of all frames.  # (N, 27)
        members: the frames of each set, ascending, at least one.  # (M,) each
    """
    members = [near_together(values, some) for some in members]
    boxes = [-(-len(some) // LARGE) for some in members]
    missing = [LARGE * count - len(some) for some, count in zip(members, boxes, strict=True)]
    filled = [np.pad(some, (0, more), constant_values=NOWHERE) for some, more in zip(members, missing, strict=True)]
    frames = np.concatenate(filled)
    there = (frames != NOWHERE)[:, None]
    low, high = (np.where(there, values[frames], beyond).astype(np.float32) for beyond in (np.inf, -np.inf))
    small, large = (_boxes(low, high, size) for size in (SMALL, LARGE))
    return SearchSets(
        frozen(frames, np.int32),
        frozen(low, np.float32),
        frozen(small, np.float32),
        frozen(large.transpose(0, 2, 1), np.float32),
        frozen(np.cumsum([0, *boxes]), np.int64),
    )


def near_together(values: NDArray[np.float32], frames: NDArray[np.intp]) -> NDArray[np.intp]:
    """The same frames, so ordered that boxes are small: cut in two across their widest feature, again and again.

    Cuts are where boxes end, large ones first.
    """
    if len(frames) <= SMALL:
        return frames
    box = LARGE if len(frames) > LARGE else SMALL
    own = values[frames]
    widest = int(np.argmax(own.std(axis=0)))
    ordered = frames[np.argsort(own[:, widest], kind="stable")]
    cut = box * -(-len(frames) // (2 * box))
    return np.concatenate([near_together(values, ordered[:cut]), near_together(values, ordered[cut:])])


def _boxes(low: NDArray, high: NDArray, size: int) -> NDArray[np.float32]:
    """Least of the rows of ``low`` and greatest of those of ``high``, so many rows at a time.  # (2, n, 27)"""
    shape = (-1, size, low.shape[1])
    return np.stack([low.reshape(shape).min(axis=1), high.reshape(shape).max(axis=1)])


@numba.njit(cache=True, nogil=True)
def distance(query: NDArray, rows: NDArray, row: int, most: Any) -> np.float32:
    """The squared distance of features, or a part of it that is over ``most`` already.  # (27,), (n, 27)"""
    total = np.float32(0.0)
    for k in range(query.shape[0]):
        away = query[k] - rows[row, k]
        total += away * away
        if total > most:
            break
    return total


@numba.njit(cache=True, nogil=True)
def _distance_to_box(query: NDArray, boxes: NDArray, box: int, most: Any) -> np.float32:
    """As ``distance``, to a box.  # (2, S, 27)"""
    total, none = np.float32(0.0), np.float32(0.0)
    for k in range(query.shape[0]):
        under, over = boxes[0, box, k] - query[k], query[k] - boxes[1, box, k]
        away = under if under > over else over
        away = away if away > none else none
        total += away * away
        if total > most:
            break
    return total


@numba.njit(cache=True, nogil=True)
def _distances_to_boxes(query: NDArray, boxes: NDArray, first: int, sums: NDArray) -> None:
    """Squared distances to boxes side by side, so that the compiler works on several at once.  # (2, 27, L), (n,)"""
    count = sums.shape[0]
    sums[:] = np.float32(0.0)
    for k in range(query.shape[0]):
        wanted, low, high = query[k], boxes[0, k, first : first + count], boxes[1, k, first : first + count]
        for box in range(count):
            away = wanted - min(max(wanted, low[box]), high[box])
            sums[box] += away * away


@numba.njit(cache=True, nogil=True)
def nearest(
    query: NDArray, sets: SearchSets, number: int, skipped: tuple[int, int], cost: Any, scratch: NDArray
) -> tuple[int, Any]:
    """The first frame of a set whose squared distance is least, if less than ``cost``.

    Args:
        query: what is looked for.  # (27,) float32
        sets: where to look.
        number: which set.
        skipped: frames from the first of these two up to the second, exclusive, are passed over.
        cost: what to beat.
        scratch: room for a number for each large box.  # (L,) float32

    Returns:
        the frame, ``NOWHERE`` where none is nearer, and its distance or ``cost``
    """
    first, end = sets.start[number], sets.start[number + 1]
    bounds = scratch[: end - first]
    _distances_to_boxes(query, sets.large, first, bounds)
    likely = np.argmin(bounds)  # looked into first, so that most others need not be
    found, cost = _nearest_in_box(query, sets, first + likely, skipped, NOWHERE, np.float32(cost))
    for box in range(end - first):
        if bounds[box] <= cost and box != likely:
            found, cost = _nearest_in_box(query, sets, first + box, skipped, found, cost)
    return found, cost


@numba.njit(cache=True, nogil=True)
def _nearest_in_box(query, sets, box, skipped, found, cost):
    """``nearest`` in one large box, against what is found so far; of equals the lower frame wins."""
    for small in range(LARGE // SMALL * box, LARGE // SMALL * (box + 1)):
        if _distance_to_box(query, sets.small, small, cost) > cost:
            continue
        for row in range(SMALL * small, SMALL * (small + 1)):
            frame = sets.frames[row]
            if skipped[0] <= frame < skipped[1] or frame == NOWHERE:
                continue
            here = distance(query, sets.rows, row, cost)
            if here < cost or (here == cost and frame < found):
                found, cost = frame, here
    return found, cost


@numba.njit(cache=True, nogil=True)
def nearest_by_brute_force(query, sets, number, skipped, cost, scratch):
    """``nearest`` by looking at every frame whole: the baseline."""
    found, cost = NOWHERE, np.float32(cost)
    for row in range(LARGE * sets.start[number], LARGE * sets.start[number + 1]):
        frame, here = sets.frames[row], distance(query, sets.rows, row, np.inf)
        if here < cost and not skipped[0] <= frame < skipped[1]:
            found, cost = frame, here
    return found, cost
