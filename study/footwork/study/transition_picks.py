"""The transitions that a metric would choose: its cheapest distinct local minima, as many as its knee says.

After Matsunaga and Zordan (2007). A minimum counts only where a whole blend has room (convention).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.metric import Metric
from footwork.study.blends import inside
from footwork.training.knee import APART, Knee, distinct, threshold_at_knee
from footwork.training.transitions import Minima, local_minima


@dataclass(frozen=True, eq=False)
class Ranking:
    """A metric's places for a transition by rank, and where its knee is.

    Args:
        ranked: distinct minima from the cheapest on; as many as were asked for or there are.
        knee: of all of them; None where there is none.
        median: of the costs of all pairs of frames.
    """

    ranked: Minima
    knee: Knee | None
    median: float

    def first(self, count: int) -> Minima:
        """The cheapest ``count``, or all where there are fewer."""
        return Minima(self.ranked.i[:count], self.ranked.j[:count], self.ranked.cost[:count])

    @property
    def knee_rank(self) -> int:
        """How many lie up to the knee; all that were kept where there is none."""
        return self.knee.rank if self.knee else len(self.ranked.i)

    @property
    def picks(self) -> Minima:
        """Those up to the knee."""
        return self.first(self.knee_rank)


def ranking(costs: NDArray[np.float64], lengths: Sequence[int], most: int) -> Ranking:
    """The ranking by the costs of all pairs of frames.

    Args:
        costs: s of every pair of frames, symmetric.  # (N, N)
        lengths: frames of each clip; they sum to N.
        most: places to keep, more where the knee lies further on.
    """
    minima = local_minima(costs, lengths)
    whole = inside(lengths, minima.i) & inside(lengths, minima.j)
    minima = Minima(minima.i[whole], minima.j[whole], minima.cost[whole])
    median = median_of_pairs(costs)
    knee = knee_of(minima, lengths, median)
    return Ranking(distinct(minima, lengths, max(most, knee.rank if knee else 0)), knee, median)


def knee_of(minima: Minima, lengths: Sequence[int], median: float) -> Knee | None:
    """The knee of local minima, None where there is none."""
    try:
        return threshold_at_knee(minima, lengths, median)
    except InputError:
        return None


def median_of_pairs(costs: NDArray[np.float64]) -> float:
    """The median over all pairs of two different frames, from every so manieth row of a large matrix."""
    rows = np.arange(0, len(costs), max(1, len(costs) // 1000))
    others = np.ones((len(rows), len(costs)), dtype=bool)
    others[np.arange(len(rows)), rows] = False
    return float(np.median(costs[rows][others]))


def partners(picks: Minima, others: Minima) -> NDArray[np.intp]:
    """For each pick the other's nearest pick that is APART at most in both frames, -1 for none.  # (M,)

    Frames are compared by number: two clips' ends lie further apart than a blend has room for.
    """
    if not len(others.i):
        return np.full(len(picks.i), -1, dtype=np.intp)
    far = np.maximum(np.abs(picks.i[:, None] - others.i), np.abs(picks.j[:, None] - others.j))
    nearest = far.argmin(axis=1)
    return np.where(far[np.arange(len(far)), nearest] <= APART, nearest, -1)


def ranked_by(metric: Metric, lengths: Sequence[int], most: int) -> Ranking:
    """The ranking by a metric, whose matrix is not kept."""
    return ranking(metric.all_pairs(), lengths, most)
