"""What following a policy is worth where commands never change: one pass over most states, many over a few.

A state leads to two, the headings that it comes between. Many states a policy only passes on its way: nothing leads to
them but others of the kind. Taken away one after another (Kahn 1962) they leave a closed core, the cycles where it
ends. The core is swept until its values settle; the others then follow in the opposite order, each once.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.training.sweeps import Policy

WORKING_BYTES = 56
"""What settling takes for a state where all are in the core; else it is less."""


@numba.njit(cache=True, nogil=True)
def settle(
    policy: Policy, discount: float, wanted: int, tolerance: float, sweeps: int, copies: NDArray, now: int
) -> None:
    """Put what following ``policy`` under one command is worth in the place of a copy's values.

    Args:
        policy: what to follow.
        discount: of a tick.
        wanted: index of the command.
        tolerance: the core is settled once a sweep changes it by less.
        sweeps: no more are made of the core than cost what so many of all states would.
        copies: values.  # (copies, N, H + 1, B)
        now: the copy.
    """
    headings, requests, values = copies.shape[2] - 1, copies.shape[3], copies[now].reshape(-1)
    place, shares, rewards = policy
    ways = _ways(place, shares, wanted, headings, requests)
    order, passed = _passed_by(ways)
    _add_cycles(ways, order, passed)
    core = order[passed:]
    if len(core):
        most = sweeps * len(order) // len(core)
        _settle_core(policy, discount, wanted, tolerance, most, ways, core, values, headings, requests)
    for index in range(passed - 1, -1, -1):
        at = order[index] * requests + wanted
        here, after = values[place[at]], values[place[at] + requests]
        worth = rewards[at] + discount * (here + shares[at] * (after - here))
        _put(values, order[index], wanted, headings, requests, worth)


@numba.njit(cache=True, nogil=True)
def _ways(place: NDArray, shares: NDArray, wanted: int, headings: int, requests: int) -> NDArray[np.int32]:
    """The two states that each leads to under a command, the same twice where it comes to a heading exactly.  # (S, 2)

    They are numbered node * headings + heading.
    """
    states = len(place) // requests
    ways = np.empty((states, 2), np.int32)
    for state in range(states):
        at = state * requests + wanted
        row = place[at] // requests
        node = row // (headings + 1)
        ways[state] = row - node
        if shares[at] > 0.0:
            ways[state, 1] += 1 if row - node * (headings + 1) < headings - 1 else 1 - headings
    return ways


@numba.njit(cache=True, nogil=True)
def _passed_by(ways: NDArray[np.int32]) -> tuple[NDArray[np.int32], int]:
    """The states that no cycle leads to, each before those it leads to, and how many they are."""
    into, order, count = np.zeros(len(ways), np.int32), np.empty(len(ways), np.int32), 0
    for state in range(len(ways)):
        into[ways[state, 0]] += 1
        into[ways[state, 1]] += 1
    for state in range(len(ways)):
        if into[state] == 0:
            order[count] = state
            count += 1
    done = 0
    while done < count:
        for onward in ways[order[done]]:
            into[onward] -= 1
            if into[onward] == 0:
                order[count] = onward
                count += 1
        done += 1
    return order, count


@numba.njit(cache=True, nogil=True)
def _add_cycles(ways: NDArray[np.int32], order: NDArray[np.int32], passed: int) -> None:
    """Add the other states to ``order``, depth first: each after those it leads to, but where a cycle closes."""
    tried, path = np.zeros(len(order), np.uint8), np.empty(len(order) - passed, np.int32)
    for state in order[:passed]:
        tried[state] = 3
    count = passed
    for root in range(len(order)):
        length = 0
        if tried[root] == 0:
            path[0], length = root, 1
        while length > 0:
            state = path[length - 1]
            tried[state] += 1
            if tried[state] > 2:
                order[count] = state
                count += 1
                length -= 1
                continue
            onward = ways[state, tried[state] - 1]
            if tried[onward] == 0:
                path[length] = onward
                length += 1


@numba.njit(cache=True, nogil=True)
def _settle_core(
    policy: Policy,
    discount: float,
    wanted: int,
    tolerance: float,
    most: int,
    ways: NDArray[np.int32],
    core: NDArray[np.int32],
    values: NDArray,
    headings: int,
    requests: int,
) -> None:
    """Sweep over the core in its own order, in float64, on copies that lie close together."""
    count, number = len(core), np.empty(len(ways), np.int32)
    for index in range(count):
        number[core[index]] = index
    first, second = number[ways[core, 0]], number[ways[core, 1]]
    here, after, reward, worth = np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    for index in range(count):
        state = core[index]
        at = state * requests + wanted
        after[index] = discount * policy.share[at]
        here[index] = discount - after[index]
        reward[index] = policy.reward[at]
        worth[index] = values[(state + state // headings) * requests + wanted]
    change, made = np.inf, 0
    while change >= tolerance and made < most:
        change = 0.0
        for index in range(count):
            new = reward[index] + (here[index] * worth[first[index]] + after[index] * worth[second[index]])
            change = max(change, abs(new - worth[index]))
            worth[index] = new
        made += 1
    for index in range(count):
        _put(values, core[index], wanted, headings, requests, worth[index])


@numba.njit(cache=True, nogil=True)
def _put(values: NDArray, state: int, wanted: int, headings: int, requests: int, worth: float) -> None:
    """Write a state's worth, at the first heading also after the last."""
    node = state // headings
    at = (state + node) * requests + wanted
    values[at] = worth
    if state == node * headings:
        values[at + headings * requests] = worth
