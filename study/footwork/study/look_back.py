"""Dynamic programming against a known player: from what a tick's end is worth to what its beginning is worth.

Values are over nodes and the yaw that a character faces in the world, evenly from -pi on: what is asked for is known,
so no command is an axis. Between yaws they are interpolated, and the control quality is exact.
"""

from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.actions import Actions
from footwork.motion.angle import wrapped, wrapped_angle
from footwork.motion.lookahead import control_quality, reward_of
from footwork.motion.threads import THREADS

_FRACTIONS = 64
_WORTH_SHARING = 512  # nodes, under which threads cost more than they bring


class LookBack:
    """Looks back over ticks, on all processors.

    Args:
        actions: of the graph and the task.
        bins: yaws that values are tabulated at.
        discount: the worth of the next tick against this one's.
    """

    def __init__(self, actions: Actions, bins: int, discount: float) -> None:
        self.actions, self.bins, self.discount = actions, bins, discount
        width = 2.0 * np.pi / bins
        yaws = np.tile(-np.pi + width * np.arange(bins), 2)
        self._yaws = yaws + width * np.arange(_FRACTIONS + 1)[:, None] / _FRACTIONS
        self._pool = ThreadPoolExecutor(THREADS)

    def over(self, nodes: NDArray, heading: float, wanted: int, after: NDArray, before: NDArray) -> None:
        """Write what nodes are worth before a tick into their rows of ``before``.

        Args:
            nodes: which.  # (n,) int32
            heading: wanted yaw in the world, radians.
            wanted: index of the behaviour asked for, -1 for one that nothing matches.
            after: what nodes are worth after the tick.  # (N, bins) float32
            before: the result.  # (N, bins) float32
        """
        sigma = self.actions.rules.heading_sigma
        qualities = np.exp(-0.5 * (wrapped(heading - self._yaws) / sigma) ** 2).astype(np.float32)
        common = self.actions, np.float32(self.discount), wanted, qualities, after, before
        if len(nodes) < _WORTH_SHARING:
            look_back(nodes, *common)
            return
        parts = np.array_split(nodes, 2 * THREADS)
        list(self._pool.map(lambda part: look_back(part, *common), parts))


@numba.njit(cache=True, nogil=True)
def look_back(
    nodes: NDArray,
    actions: Actions,
    discount: np.float32,
    wanted: int,
    qualities: NDArray,
    after: NDArray,
    before: NDArray,
) -> None:
    """``LookBack.over``; ``qualities`` are those of facings a fraction of a bin past each bin.  # (65, 2 bins)"""
    # Compiled code counts references at each look into a tuple of arrays, so it looks once.
    edge_start, target, behaviour = actions.edge_start, actions.target, actions.behaviour
    yaw, smoothness, turn_smoothness = actions.yaw, actions.smoothness, actions.turn_smoothness
    limit, level, rules = actions.turn_limit, actions.level, actions.rules
    bins = after.shape[1]
    round_twice = np.empty(2 * bins + 1, after.dtype)
    headed = wanted >= 0 and actions.headed[wanted]
    for node in nodes:
        best = before[node]
        best[:] = -np.inf
        for edge in range(edge_start[node], edge_start[node + 1]):
            there = target[edge]
            for heading in range(bins):
                round_twice[heading] = round_twice[bins + heading] = after[there, heading]
            round_twice[2 * bins] = after[there, 0]
            matches = behaviour[there] == wanted and wanted >= 0
            for turn in range(len(level) if limit[there] > 0.0 else 1):
                quality = smoothness[edge] * turn_smoothness[there, turn]
                place = (yaw[edge] + level[turn] * limit[there]) * (bins / (2.0 * np.pi))
                whole = np.floor(place)
                share, first = place - whole, int(whole) % bins
                low = np.float32(reward_of(0.0, quality, rules.additive, rules.weight))
                high = np.float32(reward_of(1.0, quality, rules.additive, rules.weight))
                values = round_twice[first : first + bins + 1]
                if matches and headed:
                    earned = qualities[int(np.rint(share * _FRACTIONS)), first : first + bins]
                    _take_better_facing(values, np.float32(share), discount, earned, low, high, best)
                else:
                    _take_better(values, np.float32(share), discount, high if matches else low, best)


@numba.njit(cache=True, nogil=True)
def _take_better_facing(
    values: NDArray,
    share: np.float32,
    discount: np.float32,
    earned: NDArray,
    low: np.float32,
    high: np.float32,
    best: NDArray,
) -> None:
    gain = high - low
    for h in range(len(best)):
        value = low + gain * earned[h] + discount * (values[h] + share * (values[h + 1] - values[h]))
        best[h] = value if value > best[h] else best[h]


@numba.njit(cache=True, nogil=True)
def _take_better(values: NDArray, share: np.float32, discount: np.float32, reward: np.float32, best: NDArray) -> None:
    for h in range(len(best)):
        value = reward + discount * (values[h] + share * (values[h + 1] - values[h]))
        best[h] = value if value > best[h] else best[h]


@numba.njit(cache=True, nogil=True)
def best_ahead(
    actions: Actions, discount: float, node: int, yaw: float, heading: float, wanted: int, after: NDArray
) -> tuple[int, float]:
    """The edge and the extra turn that are best from exactly here; turns may lie between the levels.

    Args:
        actions: of the graph and the task.
        discount: the worth of the next tick against this one's.
        node: where the character is.
        yaw: how it faces in the world, radians.
        heading: wanted yaw in the world, radians.
        wanted: index of the behaviour asked for, -1 for one that nothing matches.
        after: what nodes are worth after the tick.  # (N, bins)
    """
    headed, rules, levels = wanted >= 0 and actions.headed[wanted], actions.rules, len(actions.level)
    highest, best, best_turn = -np.inf, -1, 0.0
    for edge in range(actions.edge_start[node], actions.edge_start[node + 1]):
        there, limit = actions.target[edge], actions.turn_limit[actions.target[edge]]
        matches = actions.behaviour[there] == wanted and wanted >= 0
        onto = wrapped_angle(heading - yaw - actions.yaw[edge])
        count = levels if limit > 0.0 else 1
        for level in range(count + (abs(onto) < limit)):
            turn = actions.level[level] * limit if level < count else onto
            faced = yaw + actions.yaw[edge] + turn
            quality = actions.smoothness[edge] * np.exp(-4.0 * actions.price[there] * np.sin(0.5 * turn) ** 2)
            control = control_quality(heading - faced, matches, headed, rules.heading_sigma)
            reward = reward_of(control, quality, rules.additive, rules.weight)
            value = reward + discount * between_bins(after[there], faced)
            if value > highest:
                highest, best, best_turn = value, edge, turn
    return best, best_turn


@numba.njit(cache=True, nogil=True)
def between_bins(values: NDArray, angle: float):  # -> a number of the values' own type
    """The periodic linear interpolation of ``values`` (bins,), tabulated evenly from -pi on."""
    bins = len(values)
    turns = angle / (2.0 * np.pi) + 0.5
    place = (turns - np.floor(turns)) * bins
    low = min(int(place), bins - 1)
    return values[low] + (place - low) * (values[(low + 1) % bins] - values[low])
