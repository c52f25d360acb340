"""What else solves a steering process without extra turns: quantecon's modified policy iteration, numpy sweeps."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

from footwork.motion.actions import Actions
from footwork.motion.task import SteeringTask


class Pairs(NamedTuple):
    """A decision process of states (N B H) in the order of states, K actions each, as any solver takes it."""

    reward: NDArray[np.float64]  # (S, K)
    low: NDArray[np.int32]  # (S, K) the state of the heading bin come to
    high: NDArray[np.int32]  # (S, K) that of the next
    share: NDArray[np.float64]  # (S, K) of the next

    @property
    def nbytes(self) -> int:
        """What they take."""
        return sum(array.nbytes for array in self)


class Found(NamedTuple):
    """Values, the count of improvements, the residual they are under, and what the arrays of the solver took."""

    values: NDArray[np.float64]
    improvements: int
    residual: float
    nbytes: int


def pairs_of(actions: Actions, task: SteeringTask) -> Pairs:
    """The states and actions written out; every node has as many edges."""
    nodes, behaviours, headings = len(actions.behaviour), len(task.behaviours), task.heading_bins
    after = task.headings - actions.yaw.astype(np.float64)[:, None]  # (E, H)
    place = (after + np.pi) / (2 * np.pi) * headings
    low = np.floor(place).astype(np.int64)
    shown = actions.behaviour[actions.target]
    wanted = np.arange(behaviours)[:, None, None]
    reward = actions.smoothness[:, None] * task.control_quality(after, wanted, shown[:, None])  # (B, E, H)
    row = (actions.target[:, None] * behaviours + wanted) * headings
    edges = len(actions.target) // nodes

    def by_state(values: NDArray) -> NDArray:
        wide = np.broadcast_to(values, (behaviours, len(actions.target), headings))
        return np.ascontiguousarray(
            wide.reshape(behaviours, nodes, edges, headings).transpose(1, 0, 3, 2).reshape(-1, edges)
        )

    return Pairs(
        by_state(reward),
        by_state((row + low % headings).astype(np.int32)),
        by_state((row + (low + 1) % headings).astype(np.int32)),
        by_state(place - low),
    )


def quantecon_process(pairs: Pairs, discount: float):
    """quantecon's DiscreteDP in its sparse form of state-action pairs, and what its arrays take."""
    from quantecon.markov import DiscreteDP

    states, edges = pairs.reward.shape
    columns = np.stack([pairs.low.ravel(), pairs.high.ravel()], axis=1).ravel()
    chances = np.stack([1.0 - pairs.share.ravel(), pairs.share.ravel()], axis=1).ravel()
    follows = csr_matrix((chances, columns, 2 * np.arange(states * edges + 1)), shape=(states * edges, states))
    state, action = np.repeat(np.arange(states), edges), np.tile(np.arange(edges), states)
    process = DiscreteDP(pairs.reward.ravel(), follows, discount, state, action)
    kept = (follows.data, follows.indices, follows.indptr, process.R, process.s_indices, process.a_indices)
    return process, sum(array.nbytes for array in kept if array is not None)


def by_quantecon(process, nbytes: int, discount: float, residual: float) -> Found:
    """Modified policy iteration; it stops where half the span of a change is under ``residual``."""
    epsilon = 2.0 * residual * discount / (1.0 - discount)
    found = process.solve(method="modified_policy_iteration", epsilon=epsilon, max_iter=10_000)
    return Found(found.v, found.num_iter, residual, nbytes)


def by_numpy(pairs: Pairs, discount: float, residual: float, most: int) -> Found:
    """Plain sweeps over every action, stopped and completed by the same bounds, or after ``most``."""
    values, sweeps, least, highest = np.zeros(len(pairs.reward)), 0, 0.0, np.inf
    while 0.5 * (highest - least) >= residual and sweeps < most:
        here, following = values[pairs.low], values[pairs.high]
        here += pairs.share * (following - here)
        here *= discount
        here += pairs.reward
        new = here.max(axis=1)
        least, highest = (new - values).min(), (new - values).max()
        values, sweeps = new, sweeps + 1
    values += 0.5 * (least + highest) * discount / (1.0 - discount)
    return Found(values, sweeps, 0.5 * float(highest - least), pairs.nbytes + 3 * pairs.reward.nbytes)
