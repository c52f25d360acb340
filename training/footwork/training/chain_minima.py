"""Local minima of s among the pairs of rows of chains: each row's near rows, their s, and the lowest of each hollow."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.near_rows import BLOCK, Forest, near_masks
from footwork.training.pair_windows import PRODUCTS, Standing, pair_cost, pair_products
from footwork.training.transitions import MIN_GAP
from footwork.training.windows import frame_products

# Equal windows differ by this much of rounding at most. As nothing between them counts as lower than another, a
# motion that comes twice has the transitions that exact numbers would give it.
_NOTHING = 1e-10
STRETCH = 60  # rows of a chain that are dealt with together: with one before and one after, bits of an integer
# Stretches that go through the rows near them side by side: they meet the same rows, whose windows are then at hand.
TOGETHER = 16


class Rows(NamedTuple):
    """What the search knows of each row: see Windows and Sketches; and which rows and nodes take part.

    ``leaves`` tells nodes that a chain goes on from, ``active`` nodes that pairs are wanted of, ``awake`` rows that
    are such or next to such.  # (R,) each
    """

    frames: NDArray[np.float64]
    start: NDArray[np.intp]
    mean: NDArray[np.float64]
    energy: NDArray[np.float64]
    weights: NDArray[np.float64]
    standing: Standing
    node: NDArray[np.intp]
    first: NDArray[np.intp]
    last: NDArray[np.intp]
    leaves: NDArray[np.bool_]
    active: NDArray[np.bool_]
    awake: NDArray[np.bool_]
    sketch: NDArray[np.float32]
    sketch_energy: NDArray[np.float32]


class _Band(NamedTuple):
    """Some rows in a row against three later rows in a row; what concerns row j is kept at j % 3."""

    mask: NDArray[np.int64]  # (3,) bits of the rows near to it
    cost: NDArray[np.float64]  # (3, STRETCH + 2) s of these
    products: NDArray[np.float64]  # (3, STRETCH + 2, LENGTH, 3 or PRODUCTS) of the windows' frames


@numba.njit(cache=True, nogil=True)
def minima_of_rows(
    begin: int, end: int, rows: Rows, everyone: Forest, awake: Forest, threshold: float
) -> tuple[NDArray, NDArray, NDArray]:
    """Minima of the rows begin..end - 1, whole chains, with later rows.

    Returns:
        pairs: nodes i < j, sorted by i, then j.  # (n, 2)
        costs: their s.  # (n,)
        counts: panels of balls and of rows compared with a row, pairs near by their sketches, products of frames.
    """
    size = len(rows.node)
    masks, touched = np.zeros((TOGETHER, size), np.int64), np.zeros((TOGETHER, size // BLOCK + 1), np.bool_)
    front = np.empty((2, 2, max(len(everyone.panels), len(awake.panels))), np.int64)
    stretches, latest = np.empty((TOGETHER, 3), np.intp), np.empty(TOGETHER, np.intp)
    near = np.zeros((TOGETHER, 3), np.int64)
    cost = np.empty((TOGETHER, 3, STRETCH + 2))
    kinds = PRODUCTS if rows.standing.times.size else 3
    products = np.empty((TOGETHER, 3, STRETCH + 2, len(rows.weights), kinds))
    counts = np.zeros(4, np.intp)
    pairs, costs, total = np.empty((1024, 2), np.int32), np.empty(1024), 0
    while begin < end:
        begun, count = total, 0
        while begin < end and count < TOGETHER:
            stop = min(begin + STRETCH, rows.last[begin] + 1)
            low, high = max(begin - 1, rows.first[begin]), min(stop, rows.last[begin])
            stretches[count] = low, begin, stop
            sleepers, wakers = _bits(low, high, rows.awake)
            mask, mark = masks[count], touched[count]
            near_masks(low, wakers, rows.sketch, rows.sketch_energy, everyone, front, mask, mark, counts)
            near_masks(low, sleepers, rows.sketch, rows.sketch_energy, awake, front, mask, mark, counts)
            begin, count = stop, count + 1
        near[:] = 0
        latest[:] = -2
        for block in range(touched.shape[1]):
            for n in range(count):
                if touched[n, block]:
                    touched[n, block] = False
                    band = _Band(near[n], cost[n], products[n])
                    latest[n], pairs, costs, total = _sweep(
                        block, latest[n], stretches[n], rows, masks[n], band, threshold, pairs, costs, total, counts
                    )
        for n in range(count):
            band = _Band(near[n], cost[n], products[n])
            pairs, costs, total = _decide(stretches[n], latest[n], rows, band, threshold, pairs, costs, total)
        _sort(pairs[begun:total], costs[begun:total])
    return pairs[:total].copy(), costs[:total].copy(), counts


@numba.njit(cache=True, nogil=True)
def _bits(low: int, high: int, awake: NDArray) -> tuple[int, int]:
    """Bits of the rows low..high that are not awake, and of those that are."""
    bits = [0, 0]
    for row in range(low, high + 1):
        bits[1 if awake[row] else 0] |= 1 << (row - low)
    return bits[0], bits[1]


@numba.njit(cache=True, nogil=True)
def _sort(pairs: NDArray, costs: NDArray) -> None:
    order = np.argsort(pairs[:, 0].astype(np.int64) * (1 << 32) + pairs[:, 1])
    pairs[:] = pairs[order]
    costs[:] = costs[order]


@numba.njit(cache=True, nogil=True)
def _sweep(
    block: int,
    latest: int,
    stretch: NDArray,
    rows: Rows,
    masks: NDArray,
    band: _Band,
    threshold: float,
    pairs: NDArray,
    costs: NDArray,
    total: int,
    counts: NDArray,
) -> tuple[int, NDArray, NDArray, int]:
    """Go through the rows of a block that are near to a stretch, in ascending order, and clear them.

    Appends the minima with rows before the last one near, which is returned and comes back as ``latest``.
    """
    low = stretch[0]
    for other in range(block * BLOCK, min((block + 1) * BLOCK, len(masks))):
        near = _apart(low, other, masks[other], rows)
        masks[other] = 0
        if near == 0:
            continue
        if other != latest + 1 or other == rows.first[other]:
            pairs, costs, total = _decide(stretch, latest, rows, band, threshold, pairs, costs, total)
            band.mask[:] = 0
        _evaluate(low, other, near, rows, band, counts)
        if band.mask[(other + 2) % 3]:
            pairs, costs, total = _decide(stretch, other - 1, rows, band, threshold, pairs, costs, total)
        latest = other
        band.mask[(other + 1) % 3] = 0
    return latest, pairs, costs, total


@numba.njit(cache=True, nogil=True)
def _apart(low: int, other: int, near: int, rows: Rows) -> int:
    """The bits of ``near`` less those rows of the same chain that are too near in time for any neighbour to matter."""
    if other > rows.last[low]:
        return near
    apart = min(max(other - (MIN_GAP - 2) - low + 1, 0), STRETCH + 2)
    return near & ((1 << apart) - 1)


@numba.njit(cache=True, nogil=True)
def _evaluate(low: int, other: int, near: int, rows: Rows, band: _Band, counts: NDArray) -> None:
    """s of a row with those near it. Of the windows of (i - 1, j - 1) all frames but one come again in (i, j)."""
    slot, before = other % 3, (other + 2) % 3
    length = len(rows.weights)
    band.mask[slot] = near
    known = (band.mask[before] << 1) & near
    bit = 0
    while near >> bit:
        if (near >> bit) & 1:
            own, row = band.products[slot, bit], low + bit
            begun = 0
            if (known >> bit) & 1:
                begun = length - 1
                own[:begun] = band.products[before, bit - 1, 1:]
            for k in range(begun, length):
                _multiply(rows.start[row] + k, rows.start[other] + k, rows, own[k])
            cost = _cost(own, rows, row, other) if own.shape[1] == 3 else pair_cost(own, rows.weights)
            band.cost[slot, bit] = cost if cost > _NOTHING else 0.0
            counts[2] += 1
            counts[3] += length - begun
        bit += 1


@numba.njit(cache=True, nogil=True)
def _multiply(a: int, b: int, rows: Rows, products: NDArray) -> None:
    """Products of two frames, under the weights of what stands at them where weights depend on that."""
    if len(products) == 3:
        products[0], products[1], products[2] = frame_products(rows.frames, a, b)
    else:
        pair_products(rows.frames, rows.standing, a, b, products)


@numba.njit(cache=True, nogil=True)
def _cost(products: NDArray, rows: Rows, i: int, j: int) -> float:
    """s under fixed weights, in closed form from the products of two windows' frames (conventions.md 1)."""
    cosine, sine, height = 0.0, 0.0, 0.0
    for k in range(len(rows.weights)):
        cosine += rows.weights[k] * products[k, 0]
        sine += rows.weights[k] * products[k, 1]
        height += rows.weights[k] * products[k, 2]
    cosine -= rows.mean[i, 0] * rows.mean[j, 0] + rows.mean[i, 1] * rows.mean[j, 1]
    sine -= rows.mean[i, 0] * rows.mean[j, 1] - rows.mean[i, 1] * rows.mean[j, 0]
    ground = rows.energy[i, 0] + rows.energy[j, 0] - 2.0 * np.sqrt(cosine * cosine + sine * sine)
    return ground + (rows.energy[i, 1] + rows.energy[j, 1] - 2.0 * height)


@numba.njit(cache=True, nogil=True)
def _decide(
    stretch: NDArray,
    other: int,
    rows: Rows,
    band: _Band,
    threshold: float,
    pairs: NDArray,
    costs: NDArray,
    total: int,
) -> tuple[NDArray, NDArray, int]:
    """Append the minima of a stretch with a row whose next row has been evaluated too."""
    low, begin, stop = stretch
    slot = other % 3
    for row in range(begin, stop):
        bit = row - low
        if not (band.mask[slot] >> bit) & 1 or not band.cost[slot, bit] < threshold:
            continue
        if _wanted(row, other, rows) and _is_minimum(bit, other, band):
            if total == len(costs):
                pairs = np.concatenate((pairs, np.empty_like(pairs)))
                costs = np.concatenate((costs, np.empty_like(costs)))
            pairs[total, 0], pairs[total, 1] = rows.node[row], rows.node[other]
            costs[total] = band.cost[slot, bit]
            total += 1
    return pairs, costs, total


@numba.njit(cache=True, nogil=True)
def _wanted(i: int, j: int, rows: Rows) -> bool:
    """Whether a pair of rows may be a transition: nodes, not near in one chain, one of which leads on."""
    if rows.node[i] < 0 or rows.node[j] < 0 or (rows.first[i] == rows.first[j] and j - i < MIN_GAP):
        return False
    return (rows.leaves[i] or rows.leaves[j]) and (rows.active[i] or rows.active[j])


@numba.njit(cache=True, nogil=True)
def _is_minimum(bit: int, j: int, band: _Band) -> bool:
    """As in training.transitions: of equals the first in reading order counts as the lower one."""
    here = band.cost[j % 3, bit]
    for a in range(max(bit - 1, 0), bit + 2):
        for b in range(j - 1, j + 2):
            if (band.mask[b % 3] >> a) & 1:
                there = band.cost[b % 3, a]
                before = a < bit or (a == bit and b < j)
                if there < here or (before and there == here):
                    return False
    return True
