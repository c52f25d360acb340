"""Dynamic programming against a known player: from what a tick's end is worth to what its beginning is worth.

Values are over nodes and the yaw that a character faces in the world, evenly from -pi on: what is asked for is known,
so no command is an axis. Between yaws they are interpolated, and the control quality is exact.
"""

from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.actions import Actions
from footwork.motion.angle import wrapped, wrapped_angle
from footwork.motion.lookahead import control_quality, reward_of
from footwork.motion.threads import THREADS

_FRACTIONS = 64
_LANES = 8  # rows are swept in whole vectors of so many numbers
_WORTH_SHARING = 512  # nodes, under which threads cost more than they bring


class Ways(NamedTuple):
    """What each of E edges with each of L extra turns leads to and earns; all that hangs on no player.

    Args:
        first: the tabulated yaw that one at -pi comes to or just past.  # (E, L)
        share: how far past, as a share of the way to the next.  # (E, L)
        fraction: the same in steps of a 64th.  # (E, L)
        least: what is earned where the control quality is 0.  # (E, L)
        gain: how much more where it is 1.  # (E, L)
    """

    first: NDArray[np.int16]
    share: NDArray[np.float32]
    fraction: NDArray[np.int16]
    least: NDArray[np.float32]
    gain: NDArray[np.float32]


def ways_of(actions: Actions, bins: int) -> Ways:
    """The ways of a task's actions, for values at so many yaws."""
    turn = actions.level * actions.turn_limit[actions.target, None]
    place = (actions.yaw[:, None].astype(np.float64) + turn) * (bins / (2.0 * np.pi))
    whole = np.floor(place)
    quality = actions.smoothness[:, None] * actions.turn_smoothness[actions.target]
    earn: Any = reward_of  # of arrays, too
    least, most = (earn(control, quality, actions.rules.additive, actions.rules.weight) for control in (0.0, 1.0))
    return Ways(
        first=(whole.astype(np.int64) % bins).astype(np.int16),
        share=(place - whole).astype(np.float32),
        fraction=np.rint((place - whole) * _FRACTIONS).astype(np.int16),
        least=least.astype(np.float32),
        gain=(most - least).astype(np.float32),
    )


class LookBack:
    """Looks back over ticks, on all processors.

    Args:
        actions: of the graph and the task.
        onward: ``actions.onward_edges``, which are looked at first.  # (N,)
        bins: yaws that values are tabulated at.
        discount: the worth of the next tick against this one's.
    """

    def __init__(self, actions: Actions, onward: NDArray[np.int32], bins: int, discount: float) -> None:
        self.actions, self.bins, self.discount = actions, bins, discount
        self._onward, self._ways = onward, ways_of(actions, bins)
        nodes, width = len(actions.behaviour), bins + -(-bins // _LANES) * _LANES
        self._round, self._highest = np.zeros((nodes, width + 1), np.float32), np.zeros(nodes, np.float32)
        step = 2.0 * np.pi / bins
        yaws = -np.pi + step * (np.arange(width) % bins)
        self._yaws = yaws + step * np.arange(_FRACTIONS + 1)[:, None] / _FRACTIONS
        self._pool = ThreadPoolExecutor(THREADS)

    def over(self, nodes: NDArray, onto: NDArray, heading: float, wanted: int, after: NDArray, before: NDArray) -> None:
        """Write what nodes are worth before a tick into their rows of ``before``.

        Args:
            nodes: which.  # (n,) int32
            onto: all that edges lead to from them.  # (m,) int32
            heading: wanted yaw in the world, radians.
            wanted: index of the behaviour asked for, -1 for one that nothing matches.
            after: what nodes are worth after the tick.  # (N, bins) float32
            before: the result.  # (N, bins) float32
        """
        sigma = self.actions.rules.heading_sigma
        qualities = np.exp(-0.5 * (wrapped(heading - self._yaws) / sigma) ** 2).astype(np.float32)
        go_round(onto, after, self._round, self._highest)
        values = np.float32(self.discount), self._round, self._highest
        common = self.actions, self._onward, self._ways, *values, wanted, qualities, before
        if len(nodes) < _WORTH_SHARING:
            look_back(nodes, *common)
            return
        parts = np.array_split(nodes, 2 * THREADS)
        list(self._pool.map(lambda part: look_back(part, *common), parts))


@numba.njit(cache=True, nogil=True)
def go_round(nodes: NDArray, values: NDArray, round_again: NDArray, highest: NDArray) -> None:
    """Write nodes' values (N, bins) into rows that go on from the first after the last, and the highest of each."""
    bins, width = values.shape[1], round_again.shape[1]
    for node in nodes:
        highest[node] = values[node].max()
        for first in range(0, width, bins):
            count = min(bins, width - first)
            round_again[node, first : first + count] = values[node, :count]


@numba.njit(cache=True, nogil=True)
def look_back(
    nodes: NDArray,
    actions: Actions,
    onward: NDArray,
    ways: Ways,
    discount: np.float32,
    after: NDArray,
    highest: NDArray,
    wanted: int,
    qualities: NDArray,
    before: NDArray,
) -> None:
    """``LookBack.over``: values after are those of ``go_round``.

    ``qualities`` are those of facings a fraction of a bin past each bin (65, width). Edges that can be no better than
    those looked at before them, whatever the yaw, are left out.
    """
    # Compiled code counts references at each look into a tuple of arrays, so it looks once.
    edge_start, target, behaviour, limit = actions.edge_start, actions.target, actions.behaviour, actions.turn_limit
    first, share, fraction, least, gain = ways
    bins, levels = before.shape[1], share.shape[1]
    best = np.empty(after.shape[1] - 1 - bins, np.float32)
    headed = wanted >= 0 and actions.headed[wanted]
    for node in nodes:
        best[:], lowest = -np.inf, np.float32(-np.inf)
        for place in range(edge_start[node] - 1, edge_start[node + 1]):
            edge = onward[node] if place < edge_start[node] else place
            there = target[edge]
            matches = behaviour[there] == wanted and wanted >= 0
            most = least[edge, 0] + (gain[edge, 0] if matches else np.float32(0.0))
            if place == onward[node] or most + discount * highest[there] <= lowest:
                continue
            for turn in range(levels if limit[there] > 0.0 else 1):
                at, further = np.int64(first[edge, turn]), discount * share[edge, turn]
                here, reward, more = discount - further, least[edge, turn], gain[edge, turn]
                if matches and headed:
                    row = fraction[edge, turn]
                    _take_better_facing(after, there, at, here, further, qualities, row, more, reward, best)
                else:
                    reward += more if matches else np.float32(0.0)
                    _take_better(after, there, at, here, further, reward, best)
            lowest = best[0]
            for h in range(1, bins):
                lowest = min(lowest, best[h])
        for h in range(bins):
            before[node, h] = best[h]


# Unsigned indices let compiled code take many numbers at once; a call or a part of an array would count references.
@numba.njit(inline="always")
def _take_better_facing(
    after: NDArray,
    there: int,
    first: np.int64,
    here: np.float32,
    further: np.float32,
    qualities: NDArray,
    fraction: int,
    gain: np.float32,
    least: np.float32,
    best: NDArray,
) -> None:
    row, part = np.uintp(there), np.uintp(fraction)
    for h in range(len(best)):
        at, to = np.uintp(first + h), np.uintp(h)
        value = (
            least + gain * qualities[part, at] + (here * after[row, at] + further * after[row, np.uintp(first + h + 1)])
        )
        best[to] = value if value > best[to] else best[to]


@numba.njit(inline="always")
def _take_better(
    after: NDArray,
    there: int,
    first: np.int64,
    here: np.float32,
    further: np.float32,
    reward: np.float32,
    best: NDArray,
) -> None:
    row = np.uintp(there)
    for h in range(len(best)):
        at, to = np.uintp(first + h), np.uintp(h)
        value = reward + (here * after[row, at] + further * after[row, np.uintp(first + h + 1)])
        best[to] = value if value > best[to] else best[to]


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
