"""Choosing a threshold: where the costs of the best places for a transition stop rising steeply.

After Matsunaga and Zordan (2007): local minima of the metric by rank, without those that nearly repeat a better one;
the threshold is at the knee of that curve. They found the knee by eye; ours (conventions.md 7) is where two methods
put it: Kneedle (Satopää and others 2011) and the least-squares fit of two joined straight lines, over the first ranks,
a tenth as many as there are frames. The smaller of their ranks is taken, with a warning where they differ by more than
a fifth. Where one of them finds no knee, twice as many ranks are looked at, and so on; where that never ends with both,
the first that one of them found is taken, with the warning.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite
from footwork.training.planar_poses import FPS
from footwork.training.transitions import Minima

APART = int(0.25 * FPS)  # frames: minima no further than this apart in both frames are one
HEAD_SHARE = 0.1  # ranks looked at, of the number of frames
FEWEST = 5  # ranks that a knee can be found among
_TOLERANCE = 0.2
_CELL = APART + 1  # no two that are kept lie in one cell of so many frames a side


@dataclass(frozen=True, eq=False)
class Knee:
    """A threshold and how it came about; ranks count from one.

    Args:
        threshold: half-way between the cost of rank ``rank`` and the next.
        rank: how many distinct minima are taken: the smaller of the two methods' ranks.
        kneedle: where Kneedle puts the knee; None where the curve never lies above the line between its ends.
        broken_stick: where two joined straight lines, fitted by least squares, meet; None where none bend so.
        costs: s of the ranks looked at.  # (R,)
        median: what the curve is measured in.
    """

    threshold: float
    rank: int
    kneedle: int | None
    broken_stick: int | None
    costs: NDArray[np.float64]
    median: float

    @property
    def complete(self) -> bool:
        """Whether both methods found a knee."""
        return self.kneedle is not None and self.broken_stick is not None

    @property
    def agree(self) -> bool:
        """Whether both methods found a knee, and differ by a fifth at most."""
        if self.kneedle is None or self.broken_stick is None:
            return False
        return abs(self.kneedle - self.broken_stick) <= _TOLERANCE * max(self.kneedle, self.broken_stick)

    @property
    def curve(self) -> NDArray[np.float64]:
        """Costs by rank as multiples of the median, for plotting.  # (R,)"""
        return self.costs / self.median

    @property
    def warning(self) -> str | None:
        """What to tell the user where the methods disagree."""
        if self.agree:
            return None
        ranks = ["none" if rank is None else f"rank {rank}" for rank in (self.kneedle, self.broken_stick)]
        return (
            f"the knee of the costs is uncertain, Kneedle puts it at {ranks[0]} and the broken stick at {ranks[1]}: "
            f"threshold {self.threshold:.3g} takes the best {self.rank}"
        )


def threshold_at_knee(minima: Minima, lengths: Sequence[int], median: float | None = None) -> Knee:
    """The threshold that local minima of a metric suggest.

    Args:
        minima: all local minima, whatever they cost.
        lengths: frames of each clip.
        median: of all pairs' costs, for the curve; that of the minima where not given. The knee does not depend on it.

    Raises:
        InputError: as ``knee`` of all distinct minima.
    """
    if median is None and len(minima.cost):
        median = float(np.median(minima.cost))
    head = max(round(HEAD_SHARE * sum(lengths)), FEWEST)
    partial: Knee | None = None
    while True:
        costs = distinct(minima, lengths, head).cost
        found = _found(costs, median)
        if found is not None and found.complete:
            return found
        partial = partial or found
        if len(costs) < head:
            return partial or knee(costs, median)
        head *= 2


def distinct(minima: Minima, lengths: Sequence[int], most: int) -> Minima:
    """The ``most`` cheapest minima by rank, without those that nearly repeat a cheaper one.

    One repeats another where each of its frames is at most APART from the other's in the same clip. Of equal costs
    the first by i, then j, comes first.
    """
    lengths_array = np.asarray(lengths)
    clip = np.repeat(np.arange(len(lengths_array)), lengths_array)
    place = np.arange(len(clip)) - np.repeat(np.cumsum(lengths_array) - lengths_array, lengths_array)
    kept: dict[tuple[int, int, int, int], tuple[int, int]] = {}
    ranked: list[int] = []
    for number in np.lexsort((minima.j, minima.i, minima.cost)).tolist():
        if len(ranked) == most:
            break
        i, j = int(minima.i[number]), int(minima.j[number])
        cell = int(clip[i]), int(clip[j]), int(place[i]) // _CELL, int(place[j]) // _CELL
        if not _repeats(kept, cell, i, j):
            kept[cell] = i, j
            ranked.append(number)
    return Minima(minima.i[ranked], minima.j[ranked], minima.cost[ranked])


def _repeats(kept: dict, cell: tuple[int, int, int, int], i: int, j: int) -> bool:
    a, b, row, column = cell
    near = (kept.get((a, b, row + r, column + c)) for r in (-1, 0, 1) for c in (-1, 0, 1))
    return any(pair is not None and max(abs(pair[0] - i), abs(pair[1] - j)) <= APART for pair in near)


def knee(costs: ArrayLike, median: float | None = None) -> Knee:
    """The knee of costs by rank, all of which are looked at.

    Args:
        costs: ascending.  # (R,)
        median: what the curve is measured in; that of ``costs`` where not given.

    Raises:
        InputError: where there is none to be found: fewer than FEWEST costs, costs that do not rise, that rise ever
            more steeply or evenly, or are not in order, and a median that is not positive.
    """
    costs = frozen(costs, np.float64)
    require_finite(costs, "costs", "threshold")
    if (np.diff(costs) < 0.0).any():
        raise InputError("costs are not in ascending order, expected them by rank", "threshold")
    if len(costs) < FEWEST:
        raise _none(f"{len(costs)} places for a transition, fewer than the {FEWEST} that one needs")
    if not costs[-1] > costs[0]:
        raise _none(f"all costs are {costs[0]:g}")
    median = float(np.median(costs)) if median is None else median
    if not (np.isfinite(median) and median > 0.0):
        raise _none(f"the median of the costs is {median:g}")
    found = _found(costs, median)
    if found is None:
        raise _none("costs do not rise steeply and then flatten")
    return found


def _none(why: str) -> InputError:
    return InputError(f"no knee to choose it by ({why}), expected a number", "threshold")


def _found(costs: NDArray[np.float64], median: float | None) -> Knee | None:
    """The knee by one method or both; None where there is none or there cannot be."""
    if len(costs) < FEWEST or not costs[-1] > costs[0] or not median or not median > 0.0:
        return None
    at_kneedle, at_break = _kneedle(costs), _broken_stick(costs)
    ranks = [at + 1 for at in (at_kneedle, at_break) if at is not None]
    if not ranks:
        return None
    rank = min(ranks)
    threshold = 0.5 * float(costs[rank - 1] + costs[rank])
    kneedle, broken_stick = (None if at is None else at + 1 for at in (at_kneedle, at_break))
    return Knee(threshold, rank, kneedle, broken_stick, costs, median)


def _kneedle(costs: NDArray[np.float64]) -> int | None:
    """Where a curve that rises ever less lies furthest above the line between its ends; None for one that does not."""
    x = np.linspace(0.0, 1.0, len(costs))
    above = (costs - costs[0]) / (costs[-1] - costs[0]) - x
    best = int(np.argmax(above))
    return best if above[best] > 1e-9 else None


def _broken_stick(costs: NDArray[np.float64]) -> int | None:
    """Where y = a + b x + c max(x - knot, 0), c < 0, fits best with the knot at an inner rank; None if none bends so.

    With 1 and x made orthonormal, and r what is left of y after fitting both, a knot's hinge h takes (h . r)^2 /
    |h less its part along 1 and x|^2 off the sum of squares. Sums over h run from the knot on.
    """
    x = np.linspace(-1.0, 1.0, len(costs))
    flat = np.full(len(x), len(x) ** -0.5)
    slope = x / np.linalg.norm(x)
    rest = costs - (costs @ flat) * flat - (costs @ slope) * slope

    def hinged(values: NDArray) -> NDArray[np.float64]:
        """Sum over h times values, for each knot."""
        return _from_here(x * values) - x * _from_here(values)

    squares = hinged(x) - x * hinged(np.ones(len(x)))
    across = squares - hinged(flat) ** 2 - hinged(slope) ** 2
    bend = hinged(rest)[1:-1]
    gain = np.where(bend < 0.0, bend**2 / across[1:-1], 0.0)
    best = int(np.argmax(gain))
    return best + 1 if gain[best] > 1e-12 * (rest @ rest) and rest @ rest > 0.0 else None


def _from_here(values: NDArray) -> NDArray[np.float64]:
    """The sum of each entry and all after it."""
    return np.cumsum(values[::-1])[::-1]
