"""The sweeps of value iteration: greedy ones, which look at every action, and cheap ones, which follow a policy.

Values are of commands expected at the next tick, W = P V (``motion.player_model``), in float32 or float64. A node's lie
as (H + 1, B), its first heading repeated after the last: to shift all headings by whole bins is to begin elsewhere.
Sweeps go from one copy of the values to another, which lie in one array.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import DTypeLike, NDArray

from footwork.motion.actions import Actions, Rules
from footwork.motion.angle import wrapped
from footwork.motion.lookahead import reward_of
from footwork.motion.task import SteeringTask

_FRACTIONS = 512


class Policy(NamedTuple):
    """One action for each state, as what it earns and where it leads.

    Args:
        place: index of the heading bin that it leads into, in a flat copy of the values.  # (N H B,) int32
        share: how far it leads beyond that, a part of a bin.  # (N H B,)
        reward: of its tick.  # (N H B,)
    """

    place: NDArray[np.int32]
    share: NDArray
    reward: NDArray


def no_policy(states: int, kind: DTypeLike) -> Policy:
    """Room for a policy."""
    return Policy(np.zeros(states, np.int32), np.zeros(states, kind), np.zeros(states, kind))


def heading_qualities(task: SteeringTask, kind: DTypeLike) -> NDArray:
    """The control quality of headings: row f, column j is that of f / 512 of a bin past bin j, twice round.

    Between rows it is interpolated: at 36 bins of a Gaussian of 30 degrees that errs by 5e-8.  # (513, 2 H)
    """
    width = 2.0 * np.pi / task.heading_bins
    delta = np.tile(task.headings, 2) + width * np.arange(_FRACTIONS + 1)[:, None] / _FRACTIONS
    return np.exp(-0.5 * (wrapped(delta) / task.heading_sigma) ** 2).astype(kind)


# what an action is to a sweep, columns of ``terms``: the part of a bin it shifts headings by beyond whole ones, the
# worth of the bin come to and of the next one, the reward where the behaviour does not match and does
_SHARE, _HERE, _NEXT, _ELSE, _MATCHED = range(5)


@numba.njit(cache=True, nogil=True)
def improve(
    policy: Policy,
    actions: Actions,
    qualities: NDArray,
    change: NDArray,
    persistent: bool,
    begin: int,
    end: int,
    copies: NDArray,
    old: int,
    new: int,
) -> None:
    """Write the best actions of the nodes begin..end-1 into ``policy``, and the values that these have into a copy.

    Args:
        policy: the result.
        actions: of the graph and the task.
        qualities: ``heading_qualities``.  # (513, 2 H)
        change: PlayerModel.change.  # (B, B, H)
        persistent: whether commands never change.
        begin: the first node.
        end: the node after the last.
        copies: values.  # (copies, N, H + 1, B)
        old: the copy that the best actions are the best by.
        new: the copy written to.
    """
    edge_start, target, yaw, smoothness, shown, turn_limit, _, level, turn_smoothness, headed, rules = actions
    place, shares, rewards = policy
    headings, behaviours = copies.shape[2] - 1, copies.shape[3]
    states, kind = headings * behaviours, copies.dtype
    most = len(level) * np.max(edge_start[begin + 1 : end + 1] - edge_start[begin:end])
    there, shift, terms = np.empty(most, np.int32), np.empty(most, np.int32), np.empty((most, 5), kind)
    ahead, earned = np.empty(2 * states + behaviours, kind), np.empty(states, kind)
    best, choice = np.empty(states, kind), np.empty(states, np.int32)
    for node in range(begin, end):
        count = 0
        best[:] = -np.inf
        for edge in range(edge_start[node], edge_start[node + 1]):
            to = target[edge]
            matched = int(shown[to])
            gaussian = matched >= 0 and bool(headed[matched])
            _copy_twice(copies, old, to, ahead)
            for k in range(len(level) if turn_limit[to] > 0.0 else 1):
                bins = -(yaw[edge] + turn_limit[to] * level[k]) * (headings / (2.0 * np.pi))
                there[count], shift[count] = to, int(np.floor(bins)) % headings
                _set_terms(rules, bins - np.floor(bins), smoothness[edge] * turn_smoothness[to, k], terms, count)
                _earn(qualities, shift[count], terms, count, matched, gaussian, behaviours, earned)
                _take_better(count, terms, earned, ahead, shift[count] * behaviours, behaviours, best, choice)
                count += 1
        at = node * states
        for h in range(headings):
            for wanted in range(behaviours):
                action = int(choice[h * behaviours + wanted])
                to, bin_ = int(there[action]), h + int(shift[action])
                bin_ -= headings if bin_ >= headings else 0
                place[at] = (to * (headings + 1) + bin_) * behaviours + wanted
                shares[at] = terms[action, _SHARE]
                if shown[to] != wanted:
                    rewards[at] = terms[action, _ELSE]
                elif headed[wanted]:
                    row, between, base, gain = _rows_between(terms, action)
                    first, second = qualities[row, bin_], qualities[row + 1, bin_]
                    rewards[at] = base + gain * (first + between * (second - first))
                else:
                    rewards[at] = terms[action, _MATCHED]
                at += 1
        _write_row(best, change, persistent, copies, new, node)


@numba.njit(cache=True, nogil=True)
def _set_terms(rules: Rules, share: float, smoothness: float, terms: NDArray, action: int) -> None:
    terms[action, _SHARE] = share
    terms[action, _HERE], terms[action, _NEXT] = rules.discount * (1.0 - share), rules.discount * share
    terms[action, _ELSE] = reward_of(0.0, smoothness, rules.additive, rules.weight)
    terms[action, _MATCHED] = reward_of(1.0, smoothness, rules.additive, rules.weight)


@numba.njit(cache=True, nogil=True)
def _copy_twice(copies: NDArray, old: int, node: int, ahead: NDArray) -> None:
    """Write a node's values twice over, so that they are a plain stretch of memory from whatever heading on."""
    headings, behaviours = copies.shape[2] - 1, copies.shape[3]
    row = headings * behaviours
    values = copies[old, node].reshape(-1)
    for at in range(row):
        ahead[at] = values[at]
    second = ahead[row:]
    for at in range(row + behaviours):
        second[at] = values[at]


@numba.njit(cache=True, nogil=True)
def _earn(
    qualities: NDArray,
    shift: int,
    terms: NDArray,
    action: int,
    matched: int,
    headed: bool,
    behaviours: int,
    earned: NDArray,
) -> None:
    """Write the reward of an action that comes to a frame of behaviour ``matched`` under each command."""
    earned[:] = terms[action, _ELSE]
    if headed:
        row, between, base, gain = _rows_between(terms, action)
        headings = len(earned) // behaviours
        first, second = qualities[row, shift : shift + headings], qualities[row + 1, shift : shift + headings]
        into = earned[matched::behaviours]
        for h in range(headings):
            into[h] = base + gain * (first[h] + between * (second[h] - first[h]))
    elif matched >= 0:
        earned[matched::behaviours] = terms[action, _MATCHED]


@numba.njit(cache=True, nogil=True)
def _rows_between(terms: NDArray, action: int) -> tuple[int, float, float, float]:
    """The row of ``qualities`` before where an action leads, how far it leads on, and its reward base + gain qc."""
    fraction = terms[action, _SHARE] * terms.dtype.type(_FRACTIONS)
    row = min(int(fraction), _FRACTIONS - 1)
    base = terms[action, _ELSE]
    return row, fraction - terms.dtype.type(row), base, terms[action, _MATCHED] - base


@numba.njit(cache=True, nogil=True)
def _take_better(
    action: int,
    terms: NDArray,
    earned: NDArray,
    ahead: NDArray,
    begin: int,
    behaviours: int,
    best: NDArray,
    choice: NDArray,
) -> None:
    """Put an action in where it is worth more than the best so far."""
    here, after = terms[action, _HERE], terms[action, _NEXT]
    first, second = ahead[begin:], ahead[begin + behaviours :]
    for at in range(len(best)):
        value = earned[at] + (here * first[at] + after * second[at])
        better = value > best[at]
        best[at] = value if better else best[at]
        choice[at] = action if better else choice[at]


@numba.njit(cache=True, nogil=True)
def evaluate(
    policy: Policy,
    discount: float,
    in_place: bool,
    change: NDArray,
    persistent: bool,
    begin: int,
    end: int,
    copies: NDArray,
    old: int,
    new: int,
) -> None:
    """Write the values that following ``policy`` for a tick and the old ones from then on has into a copy.

    Nodes are taken from the last to the first: motion is captured forwards, so what comes after a node is mostly
    known anew already, and where it lies between ``begin`` and ``end`` it is taken so if ``in_place``
    (Gauss and Seidel's way).

    Args:
        policy: what to follow.
        discount: of a tick, of the values' own type.
        in_place: whether to go on from new values where there are any.
        change: PlayerModel.change.  # (B, B, H)
        persistent: whether commands never change.
        begin: the first node.
        end: the node after the last.
        copies: values.  # (copies, N, H + 1, B)
        old: the copy gone on from.
        new: the copy written to.
    """
    place, shares, rewards = policy
    nodes, length, behaviours = copies.shape[1:]
    states, stride, flat = (length - 1) * behaviours, length * behaviours, copies.reshape(-1)
    row = np.empty(states, copies.dtype)
    last, next_bin = end * stride if in_place else 0, np.uint32(behaviours)
    from_old, from_new = np.uint32(old * nodes * stride), np.uint32(new * nodes * stride)
    for node in range(end - 1, begin - 1, -1):
        known, states_here = (node + 1) * stride, slice(node * states, (node + 1) * states)
        to, share, reward = place[states_here], shares[states_here], rewards[states_here]
        for state in range(states):
            # unsigned: compiled code need not look whether an index counts from the end
            at = np.uint32(to[state])
            at += from_new if known <= at < last else from_old
            here, after = flat[at], flat[at + next_bin]
            row[state] = reward[state] + discount * (here + share[state] * (after - here))
        _write_row(row, change, persistent, copies, new, node)


@numba.njit(cache=True, nogil=True)
def _write_row(row: NDArray, change: NDArray, persistent: bool, copies: NDArray, new: int, node: int) -> None:
    """Write what the player model expects of a node's values V, in ``row`` (H B,): W = P V."""
    headings, behaviours = copies.shape[2] - 1, copies.shape[3]
    if not persistent:
        _expect(row, change)
    values = copies[new, node].reshape(-1)
    for at in range(len(row)):
        values[at] = row[at]
    for wanted in range(behaviours):
        values[headings * behaviours + wanted] = row[wanted]


@numba.njit(cache=True, nogil=True)
def _expect(row: NDArray, change: NDArray) -> None:
    """Put the sums over behaviours and jumps of change V in the place of V.  # (H B,), (B, B, H)"""
    behaviours, headings = change.shape[0], change.shape[2]
    values, expected = np.empty((behaviours, 2 * headings), row.dtype), np.zeros(headings, row.dtype)
    for at in range(len(row)):
        h, then = at // behaviours, at % behaviours
        values[then, h] = values[then, h + headings] = row[at]
    for wanted in range(behaviours):
        expected[:] = 0.0
        for then in range(behaviours):
            for jump in range(headings):
                likely, after = change[wanted, then, jump], values[then, jump : jump + headings]
                for h in range(headings):
                    expected[h] += likely * after[h]
        # one by one: the message that Numba has ready for slices of another length takes seconds to compile
        for h in range(headings):
            row[h * behaviours + wanted] = expected[h]
