"""Local minima of s among the pairs of rows of chains: each row's near rows, their s, and the lowest of each hollow."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.chain_bands import (
    COLUMNS,
    DIAGONALS,
    ROWS,
    STRETCH,
    Band,
    Compared,
    fill_band,
    fill_band_by_pairs,
    new_room,
)
from footwork.training.near_rows import BLOCK, Forest, near_masks
from footwork.training.transitions import MIN_GAP

# Near rows of one chain that are further apart than this are dealt with apart, and so are diagonals. A band also pays
# for the frames around its rows, so that a few rows in between are worth it.
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
    (cost, products), candidates = new_room(rows.compared), np.empty((ROWS * COLUMNS, 2), np.intp)
    used, bands = np.zeros(DIAGONALS, np.bool_), np.empty((DIAGONALS, 2), np.int64)
    # to compiled code, each look into a tuple of arrays counts references: it is done once
    frames, start, mean, energy, weights, standing = rows.compared
    by_pairs = standing.times.size > 0
    pairs, costs, total = np.empty((1024, 2), np.int32), np.empty(1024), 0
    while begin < end:
        stop = min(begin + STRETCH, rows.last[begin] + 1)
        low, high = max(begin - 1, rows.first[begin]), min(stop, rows.last[begin])
        sleepers, wakers = _bits(low, high, rows.awake)
        near_masks(low, wakers, rows.sketch, rows.sketch_energy, everyone, front, masks, touched)
        near_masks(low, sleepers, rows.sketch, rows.sketch_energy, awake, front, masks, touched)
        count = _collect(low, rows, masks, touched, near)
        at = 0
        while at < count:
            past = _run(near[:count], at, rows)
            ends = begin, stop, near[at, 0], near[past - 1, 0] + 1
            around = _around(near[:count], at, past, rows)
            for b in range(_diagonals(around, used, bands)):
                band = _band(low, high + 1 - low, around, bands[b, 0], bands[b, 1])
                if by_pairs:
                    fill_band_by_pairs(cost, products, frames, start, standing, weights, band)
                else:
                    fill_band(cost, products, frames, start, mean, energy, weights, band)
                found = _candidates(cost, band, threshold, candidates)
                pairs, costs, total = _append(candidates[:found], band, ends, rows, cost, pairs, costs, total)
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
def _around(near: NDArray, at: int, past: int, rows: Rows) -> NDArray:
    """A run, and the rows of its chain next to it that are near too."""
    column, end = near[at, 0], near[past - 1, 0]
    if at > 0 and near[at - 1, 0] == column - 1 and rows.first[column - 1] == rows.first[column]:
        at -= 1
    if past < len(near) and near[past, 0] == end + 1 and rows.first[end + 1] == rows.first[column]:
        past += 1
    return near[at:past]


@numba.njit(cache=True, nogil=True)
def _diagonals(near: NDArray, used: NDArray, bands: NDArray) -> int:
    """First and last diagonals of the bands of a run, in ``bands``, and how many these are.

    The n-th row and the m-th near row meet on diagonal n - m; ``used`` is scratch.
    """
    used[:] = False
    for t in range(len(near)):
        bits, diagonal = near[t, 1], COLUMNS - 1 - (near[t, 0] - near[0, 0])
        while bits:
            if bits & 1:
                used[diagonal] = True
            bits >>= 1
            diagonal += 1
    count, last = 0, -_APART
    for diagonal in range(len(used)):
        if not used[diagonal]:
            continue
        if count == 0 or diagonal - last > _APART:
            bands[count, 0] = diagonal - (COLUMNS - 1)
            count += 1
        bands[count - 1, 1], last = diagonal - (COLUMNS - 1), diagonal
    return count


@numba.njit(cache=True, nogil=True)
def _band(base: int, count: int, near: NDArray, low: int, high: int) -> Band:
    """The band of the diagonals low..high of a run, with those columns only that have near rows on them."""
    first = near[0, 0]
    begin, end = near[-1, 0], first
    for row, bits in near:
        n = max(low + row - first, 0)
        if (bits >> n) & ((1 << max(min(high + row - first, ROWS - 1) - n + 1, 0)) - 1):
            begin, end = min(begin, row), max(end, row)
    return Band(base, count, low + begin - first, high - low + 1, begin, end - begin + 1)


@numba.njit(cache=True, nogil=True)
def _candidates(cost: NDArray, band: Band, threshold: float, candidates: NDArray) -> int:
    """Columns and diagonals of a band's pairs under the threshold that are lowest among those around them.

    As in training.transitions: of equals the first in reading order counts as the lower one.
    """
    count = 0
    for m in range(band.columns):
        for v in range(band.diagonals):
            if cost[m + 1, v + 2] < threshold and _lowest(cost, m + 1, v + 2):
                candidates[count, 0], candidates[count, 1] = m, v
                count += 1
    return count


@numba.njit(cache=True, nogil=True)
def _lowest(cost: NDArray, m: int, v: int) -> bool:
    """Whether a pair is the lowest of its hollow; a row's pairs lie one diagonal lower in each column."""
    own = cost[m, v]
    above = cost[m - 1, v] > own and cost[m, v - 1] > own and cost[m + 1, v - 2] > own
    beside = cost[m - 1, v + 1] > own and cost[m + 1, v - 1] >= own
    return above and beside and cost[m - 1, v + 2] >= own and cost[m, v + 1] >= own and cost[m + 1, v] >= own


@numba.njit(cache=True, nogil=True)
def _append(
    candidates: NDArray,
    band: Band,
    ends: tuple[int, int, int, int],
    rows: Rows,
    cost: NDArray,
    pairs: NDArray,
    costs: NDArray,
    total: int,
) -> tuple[NDArray, NDArray, int]:
    """Append those that may be transitions and lie between the two ends of rows and of columns."""
    for m, v in candidates:
        row, other = band.base + band.diagonal + v + m, band.column + m
        if not (ends[0] <= row < ends[1] and ends[2] <= other < ends[3] and _wanted(row, other, rows)):
            continue
        if total == len(costs):
            pairs = np.concatenate((pairs, np.empty_like(pairs)))
            costs = np.concatenate((costs, np.empty_like(costs)))
        pairs[total, 0], pairs[total, 1] = rows.node[row], rows.node[other]
        costs[total] = cost[m + 1, v + 2]
        total += 1
    return pairs, costs, total


@numba.njit(cache=True, nogil=True)
def _wanted(i: int, j: int, rows: Rows) -> bool:
    """Whether a pair of rows may be a transition: nodes, not near in one chain, one of which leads on."""
    if rows.node[i] < 0 or rows.node[j] < 0 or (rows.first[i] == rows.first[j] and j - i < MIN_GAP):
        return False
    return (rows.leaves[i] or rows.leaves[j]) and (rows.active[i] or rows.active[j])
