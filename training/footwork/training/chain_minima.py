"""Local minima of s among the pairs of rows of chains: each row's near rows, their s, and the lowest of each hollow."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.chain_tiles import COLUMNS, STRETCH, Compared, Tile, fill_tile, new_tile, set_rows
from footwork.training.near_rows import BLOCK, Forest, near_masks
from footwork.training.transitions import MIN_GAP

# Near rows of one chain that are further apart than this are dealt with apart. A tile also pays for the frames around
# its rows, so that a few rows in between are worth it; how many made no clear difference (3, 8 and 14 were tried).
_APART = 8


class Rows(NamedTuple):
    """What the search knows of each row: see Windows and Sketches; and which rows and nodes take part.

    ``leaves`` tells nodes that a chain goes on from, ``active`` nodes that pairs are wanted of, ``awake`` rows that
    are such or next to such.  # (R,) each
    """

    compared: Compared
    node: NDArray[np.intp]
    first: NDArray[np.intp]
    last: NDArray[np.intp]
    leaves: NDArray[np.bool_]
    active: NDArray[np.bool_]
    awake: NDArray[np.bool_]
    sketch: NDArray[np.float32]
    sketch_energy: NDArray[np.float32]


@numba.njit(cache=True, nogil=True)
def minima_of_rows(
    begin: int, end: int, rows: Rows, everyone: Forest, awake: Forest, threshold: float
) -> tuple[NDArray, NDArray]:
    """Minima of the rows begin..end - 1, whole chains, with later rows.

    Returns:
        pairs: nodes i < j, in no order.  # (n, 2)
        costs: their s.  # (n,)
    """
    size = len(rows.node)
    masks, touched = np.zeros(size, np.int64), np.zeros(size // BLOCK + 1, np.bool_)
    front = np.empty((2, 2, max(len(everyone.panels), len(awake.panels))), np.int64)
    near = np.empty((size, 2), np.int64)
    tile, candidates = new_tile(rows.compared), np.empty(((STRETCH + 2) * COLUMNS, 2), np.intp)
    pairs, costs, total = np.empty((1024, 2), np.int32), np.empty(1024), 0
    while begin < end:
        stop = min(begin + STRETCH, rows.last[begin] + 1)
        low, high = max(begin - 1, rows.first[begin]), min(stop, rows.last[begin])
        sleepers, wakers = _bits(low, high, rows.awake)
        near_masks(low, wakers, rows.sketch, rows.sketch_energy, everyone, front, masks, touched)
        near_masks(low, sleepers, rows.sketch, rows.sketch_energy, awake, front, masks, touched)
        count = _collect(low, rows, masks, touched, near)
        set_rows(tile, rows.compared, low, high + 1 - low)
        at = 0
        while at < count:
            past = _run(near[:count], at, rows)
            box = _box(low, near[:count], at, past, rows)
            fill_tile(tile, rows.compared, low, *box)
            found = _candidates(tile, box, threshold, candidates)
            ends = begin, stop, near[at, 0], near[past - 1, 0] + 1
            pairs, costs, total = _append(candidates[:found], box, ends, rows, tile, pairs, costs, total)
            at = past
        begin = stop
    return pairs[:total].copy(), costs[:total].copy()


@numba.njit(cache=True, nogil=True)
def _bits(low: int, high: int, awake: NDArray) -> tuple[int, int]:
    """Bits of the rows low..high that are not awake, and of those that are."""
    bits = [0, 0]
    for row in range(low, high + 1):
        bits[1 if awake[row] else 0] |= 1 << (row - low)
    return bits[0], bits[1]


@numba.njit(cache=True, nogil=True)
def _collect(low: int, rows: Rows, masks: NDArray, touched: NDArray, near: NDArray) -> int:
    """List the near rows in ``near``, ascending, with the bits of those they are near to, and clear the masks."""
    count = 0
    for block in range(len(touched)):
        if not touched[block]:
            continue
        touched[block] = False
        for other in range(block * BLOCK, min((block + 1) * BLOCK, len(masks))):
            bits = _apart(low, other, masks[other], rows)
            masks[other] = 0
            if bits:
                near[count, 0], near[count, 1] = other, bits
                count += 1
    return count


@numba.njit(cache=True, nogil=True)
def _apart(low: int, other: int, near: int, rows: Rows) -> int:
    """The bits of ``near`` less those rows of the same chain that are too near in time for any neighbour to matter."""
    if other > rows.last[low]:
        return near
    apart = min(max(other - (MIN_GAP - 2) - low + 1, 0), STRETCH + 2)
    return near & ((1 << apart) - 1)


@numba.njit(cache=True, nogil=True)
def _run(near: NDArray, at: int, rows: Rows) -> int:
    """Where those end that are dealt with together with near[at]: of one chain, and with a row around few enough."""
    begun, end = near[at, 0], rows.last[near[at, 0]]
    past = at + 1
    while past < len(near):
        row = near[past, 0]
        if row > end or row - near[past - 1, 0] > _APART or row - begun > COLUMNS - 3:
            break
        past += 1
    return past


@numba.njit(cache=True, nogil=True)
def _box(low: int, near: NDArray, at: int, past: int, rows: Rows) -> tuple[int, int, int, int]:
    """First row, rows, first column and columns of a run and those next to it that are near too."""
    bits, column, end = 0, near[at, 0], near[past - 1, 0]
    for n in range(at, past):
        bits |= near[n, 1]
    chain = rows.first[column]
    if at > 0 and near[at - 1, 0] == column - 1 and rows.first[column - 1] == chain:
        column -= 1
        bits |= near[at - 1, 1]
    if past < len(near) and near[past, 0] == end + 1 and rows.first[end + 1] == chain:
        end += 1
        bits |= near[past, 1]
    first, count, columns = 0, 0, end + 1 - column
    while not (bits >> first) & 1:
        first += 1
    while bits >> (first + count):
        count += 1
    return low + first, count, column, columns


@numba.njit(cache=True, nogil=True)
def _candidates(tile: Tile, box: tuple[int, int, int, int], threshold: float, candidates: NDArray) -> int:
    """Rows and columns of a tile's pairs under the threshold that are lowest among those around them.

    As in training.transitions: of equals the first in reading order counts as the lower one.
    """
    _, rows, _, columns = box
    lowest = np.empty(columns, np.bool_)
    count = 0
    for n in range(rows):
        _mark_lowest(tile.cost[n], tile.cost[n + 1], tile.cost[n + 2], threshold, lowest)
        for m in range(columns):
            if lowest[m]:
                candidates[count, 0], candidates[count, 1] = n, m
                count += 1
    return count


@numba.njit(cache=True, nogil=True)
def _mark_lowest(above: NDArray, own: NDArray, below: NDArray, threshold: float, lowest: NDArray) -> None:
    # all comparisons are made, so that many pairs can be looked at side by side
    for m in range(len(lowest)):
        cost = own[m + 1]
        before = (above[m] > cost) & (above[m + 1] > cost) & (above[m + 2] > cost) & (own[m] > cost)
        after = (own[m + 2] >= cost) & (below[m] >= cost) & (below[m + 1] >= cost) & (below[m + 2] >= cost)
        lowest[m] = before & after & (cost < threshold)


@numba.njit(cache=True, nogil=True)
def _append(
    candidates: NDArray,
    box: tuple[int, int, int, int],
    ends: tuple[int, int, int, int],
    rows: Rows,
    tile: Tile,
    pairs: NDArray,
    costs: NDArray,
    total: int,
) -> tuple[NDArray, NDArray, int]:
    """Append those that may be transitions and lie between the two ends of rows and of columns."""
    for n, m in candidates:
        row, other = box[0] + n, box[2] + m
        if not (ends[0] <= row < ends[1] and ends[2] <= other < ends[3] and _wanted(row, other, rows)):
            continue
        if total == len(costs):
            pairs = np.concatenate((pairs, np.empty_like(pairs)))
            costs = np.concatenate((costs, np.empty_like(costs)))
        pairs[total, 0], pairs[total, 1] = rows.node[row], rows.node[other]
        costs[total] = tile.cost[n + 1, m + 1]
        total += 1
    return pairs, costs, total


@numba.njit(cache=True, nogil=True)
def _wanted(i: int, j: int, rows: Rows) -> bool:
    """Whether a pair of rows may be a transition: nodes, not near in one chain, one of which leads on."""
    if rows.node[i] < 0 or rows.node[j] < 0 or (rows.first[i] == rows.first[j] and j - i < MIN_GAP):
        return False
    return (rows.leaves[i] or rows.leaves[j]) and (rows.active[i] or rows.active[j])
