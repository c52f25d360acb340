"""A metric over the rows of chains: what the search for transitions, the joins and the graph's assembly compare by."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion.alignment import Alignment
from footwork.motion.dynamics_metric import align_pair_windows
from footwork.motion.metric import UNIT, align_windows, scaled_weights
from footwork.motion.metrics import fixed_cloud
from footwork.motion.pair_weights import PairWeights, dynamics_weights
from footwork.motion.window import RADIUS
from footwork.training.chains import Chains

_PAIRS_AT_ONCE = 2048


@dataclass(frozen=True, eq=False)
class RowMetric:
    """Points of every row of chains, and their weights.

    Args:
        chains: whose M rows.
        points: world places of the metric's points, metres.  # (M, P, 3)
        weights: of the points, the same for all pairs, scaled to sum 1; s under them alone is never more than
            s.  # (P,)
        pair: the weights of each pair, for a metric that has such; their part ``mass`` is ``weights``.

    Raises:
        InputError: for weights that do not fit the points or cannot be scaled.
    """

    chains: Chains
    points: NDArray[np.float64]
    weights: NDArray[np.float64]
    pair: PairWeights | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "weights", scaled_weights(self.weights, self.points.shape[1]))

    def align(self, here: NDArray[np.intp], there: NDArray[np.intp]) -> Alignment:
        """How the windows of rows ``there`` go onto those of rows ``here``, each (n,); square / UNIT^2 is s."""
        starts = range(0, max(len(here), 1), _PAIRS_AT_ONCE)
        parts = [self._align(here[at : at + _PAIRS_AT_ONCE], there[at : at + _PAIRS_AT_ONCE]) for at in starts]
        return Alignment(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    def costs(self, here: NDArray[np.intp], there: NDArray[np.intp]) -> NDArray[np.float64]:
        """s of pairs of rows.  # (n,)"""
        return self.align(here, there).square / UNIT**2

    def _align(self, here: NDArray[np.intp], there: NDArray[np.intp]) -> Alignment:
        first, second = window_rows(self.chains, here), window_rows(self.chains, there)
        if self.pair is None:
            return align_windows(self.points[first], self.points[second], self.weights)
        standing = contacts_of_rows(self.chains, first), contacts_of_rows(self.chains, second)
        return align_pair_windows(self.points[first], self.points[second], *standing, self.pair)


def uniform_rows(chains: Chains) -> RowMetric:
    """The uniform metric over the rows of chains: all joints alike."""
    return RowMetric(chains, chains.places, np.ones(chains.places.shape[1]))


def row_metric(name: str, chains: Chains) -> RowMetric:
    """The metric called ``name`` (footwork.motion.metrics) over the rows of chains.

    Raises:
        InputError: for an unknown name, or a body that lacks what the metric needs.
    """
    if name == "uniform":
        return uniform_rows(chains)
    if name == "dynamics":
        pair = dynamics_weights(chains.skeleton)
        return RowMetric(chains, chains.places, pair.mass, pair)
    cloud = fixed_cloud(name, chains.skeleton)
    # many rows: places are not copied where the points are the joints
    points = chains.places if np.array_equal(cloud.shares, np.eye(len(cloud.shares))) else cloud.points(chains.places)
    return RowMetric(chains, points, cloud.weights)


def window_rows(chains: Chains, rows: NDArray[np.intp]) -> NDArray[np.intp]:
    """The rows of the windows of some rows, held at the ends of their chains.  # (n,) -> (n, LENGTH)"""
    chain = _chain_of_rows(chains, rows)
    first = chains.first_row[chain]
    last = first + (chains.length + 2 * chains.context)[chain] - 1
    around = rows[:, None] + np.arange(-RADIUS, RADIUS + 1)
    return np.clip(around, first[:, None], last[:, None])


def contacts_of_rows(chains: Chains, rows: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Which feet stand at some rows; at rows of context those of the chain's nearest frame.  # (...) -> (..., feet)"""
    chain = _chain_of_rows(chains, rows)
    into = rows - chains.first_row[chain] - chains.context[chain]
    return chains.contacts[chains.first_node[chain] + np.clip(into, 0, chains.length[chain] - 1)]


def _chain_of_rows(chains: Chains, rows: NDArray[np.intp]) -> NDArray[np.intp]:
    return np.searchsorted(chains.first_row, rows, side="right") - 1
