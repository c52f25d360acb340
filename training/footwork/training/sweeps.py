"""The sweeps of value iteration: greedy ones, which look at every action, and cheap ones, which follow a policy.

Values are of commands expected at the next tick, W = P V (``motion.player_model``), in float32 or float64. A node's lie
as (H + 1, Q), its first heading repeated after the last: to shift all headings by whole bins is to begin elsewhere.
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
        place: index of the heading bin that it leads into, in a flat copy of the values.  # (N H Q,) int32
        share: how far it leads beyond that, a part of a bin.  # (N H Q,)
        reward: of its tick.  # (N H Q,)
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


def speed_qualities(speed: NDArray[np.float64], task: SteeringTask, kind: DTypeLike) -> NDArray:
    """SteeringTask.speed_quality of nodes of these speeds under each request.  # (N,) -> (N, Q)"""
    return task.speed_quality(speed[:, None], task.requests.speed).astype(kind)


# what an action is to a sweep, columns of ``terms``: the part of a bin it shifts headings by beyond whole ones, the
# worth of the bin come to and of the next one, the reward where the behaviour does not match and does
_SHARE, _HERE, _NEXT, _ELSE, _MATCHED = range(5)


@numba.njit(cache=True, nogil=True)
def improve(
    policy: Policy,
    actions: Actions,
    asks: NDArray,
    paces: NDArray,
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
        asks: index of the behaviour that each request asks for.  # (Q,)
        paces: ``speed_qualities``.  # (N, Q)
        qualities: ``heading_qualities``.  # (513, 2 H)
        change: PlayerModel.change of requests.  # (Q, Q, H)
        persistent: whether commands never change.
        begin: the first node.
        end: the node after the last.
        copies: values.  # (copies, N, H + 1, Q)
        old: the copy that the best actions are the best by.
        new: the copy written to.
    """
    edge_start, target, yaw, smoothness, shown, turn_limit, _, level, turn_smoothness, headed, _, rules = actions
    place, shares, rewards = policy
    headings, requests = copies.shape[2] - 1, copies.shape[3]
    states, kind = headings * requests, copies.dtype
    most = len(level) * np.max(edge_start[begin + 1 : end + 1] - edge_start[begin:end])
    there, shift, terms = np.empty(most, np.int32), np.empty(most, np.int32), np.empty((most, 5), kind)
    ahead, earned = np.empty(2 * states + requests, kind), np.empty(states, kind)
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
                _earn(qualities, shift[count], terms, count, matched, gaussian, asks, paces[to], earned)
                _take_better(count, terms, earned, ahead, shift[count] * requests, requests, best, choice)
                count += 1
        at = node * states
        for h in range(headings):
            for wanted in range(requests):
                action = int(choice[h * requests + wanted])
                to, bin_ = int(there[action]), h + int(shift[action])
                bin_ -= headings if bin_ >= headings else 0
                place[at] = (to * (headings + 1) + bin_) * requests + wanted
                shares[at] = terms[action, _SHARE]
                if shown[to] != asks[wanted]:
                    rewards[at] = terms[action, _ELSE]
                elif headed[shown[to]]:
                    row, between, base, gain = _rows_between(terms, action)
                    first, second = qualities[row, bin_], qualities[row + 1, bin_]
                    rewards[at] = base + gain * paces[to, wanted] * (first + between * (second - first))
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
    headings, requests = copies.shape[2] - 1, copies.shape[3]
    row = headings * requests
    values = copies[old, node].reshape(-1)
    for at in range(row):
        ahead[at] = values[at]
    second = ahead[row:]
    for at in range(row + requests):
        second[at] = values[at]


@numba.njit(cache=True, nogil=True)
def _earn(
    qualities: NDArray,
    shift: int,
    terms: NDArray,
    action: int,
    matched: int,
    headed: bool,
    asks: NDArray,
    pace: NDArray,
    earned: NDArray,
) -> None:
    """Write the reward of an action that comes to a frame of behaviour ``matched`` under each request.

    ``pace`` is what the frame's speed does to it, of headed behaviours alone.  # (Q,)
    """
    earned[:] = terms[action, _ELSE]
    if headed:
        row, between, base, gain = _rows_between(terms, action)
        headings = len(earned) // len(asks)
        first, second = qualities[row, shift : shift + headings], qualities[row + 1, shift : shift + headings]
        for wanted in range(len(asks)):
            if asks[wanted] == matched:
                into, gained = earned[wanted :: len(asks)], gain * pace[wanted]
                for h in range(headings):
                    into[h] = base + gained * (first[h] + between * (second[h] - first[h]))
    elif matched >= 0:
        earned[matched :: len(asks)] = terms[action, _MATCHED]


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
    requests: int,
    best: NDArray,
    choice: NDArray,
) -> None:
    """Put an action in where it is worth more than the best so far."""
    here, after = terms[action, _HERE], terms[action, _NEXT]
    first, second = ahead[begin:], ahead[begin + requests :]
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
        change: PlayerModel.change of requests.  # (Q, Q, H)
        persistent: whether commands never change.
        begin: the first node.
        end: the node after the last.
        copies: values.  # (copies, N, H + 1, Q)
        old: the copy gone on from.
        new: the copy written to.
    """
    place, shares, rewards = policy
    nodes, length, requests = copies.shape[1:]
    states, stride, flat = (length - 1) * requests, length * requests, copies.reshape(-1)
    row = np.empty(states, copies.dtype)
    last, next_bin = end * stride if in_place else 0, np.uint32(requests)
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
    """Write what the player model expects of a node's values V, in ``row`` (H Q,): W = P V."""
    headings, requests = copies.shape[2] - 1, copies.shape[3]
    if not persistent:
        _expect(row, change)
    values = copies[new, node].reshape(-1)
    for at in range(len(row)):
        values[at] = row[at]
    for wanted in range(requests):
        values[headings * requests + wanted] = row[wanted]


@numba.njit(cache=True, nogil=True)
def _expect(row: NDArray, change: NDArray) -> None:
    """Put the sums over requests and jumps of change V in the place of V.  # (H Q,), (Q, Q, H)"""
    requests, headings = change.shape[0], change.shape[2]
    values, expected = np.empty((requests, 2 * headings), row.dtype), np.zeros(headings, row.dtype)
    for at in range(len(row)):
        h, then = at // requests, at % requests
        values[then, h] = values[then, h + headings] = row[at]
    for wanted in range(requests):
        expected[:] = 0.0
        for then in range(requests):
            for jump in range(headings):
                likely, after = change[wanted, then, jump], values[then, jump : jump + headings]
                if likely != 0.0:
                    for h in range(headings):
                        expected[h] += likely * after[h]
        # one by one: the message that Numba has ready for slices of another length takes seconds to compile
        for h in range(headings):
            row[h * requests + wanted] = expected[h]
