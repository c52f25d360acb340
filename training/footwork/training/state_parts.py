"""What of a graph is left once a state machine allows: from everywhere every state, and within states everywhere.

After Chiu, Zordan and Wu (2007): transitions that the machine forbids go, then all but the largest strongly connected
part, then for each state with transitions within it all but the largest strongly connected part of its own. The last
step may break what the one before made, so both are repeated until nothing changes (conventions.md 11).

They label whole files. Where a file has a guard before and after a strike, labelled as such, the last frames before the
strike lead nowhere but into it and so are in no part of their own state's; deleting them would cut the strike off. So
frames that only lead out of their state's part, or back into it, count as the wind-up or the recovery of the state that
the capture has after or before them. Between states that both have transitions within them, as from standing to
walking, they are the entry of the later one: from an entry all of its state is reached, though it is not from there.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from footwork.motion.state_machine import NO_STATE, StateMachine
from footwork.training.connectivity import largest_component


class Links(NamedTuple):
    """The edges of a graph of N nodes.

    Args:
        source: the node each leaves.  # (E,)
        target: the node it leads to.  # (E,)
        natural: whether it follows the capture, to the node of the next number.  # (E,)
    """

    source: NDArray
    target: NDArray
    natural: NDArray[np.bool_]

    def where(self, kept: NDArray[np.bool_]) -> "Links":
        """Some of them."""
        return Links(self.source[kept], self.target[kept], self.natural[kept])


class Parts(NamedTuple):
    """What is left.

    Args:
        state: the number of each node's state, NO_STATE for those that are gone.  # (N,)
        links: which edges the machine allows between what is left.  # (E,)
        steps: what each step was, and ``state`` after it.
    """

    state: NDArray[np.int16]
    links: NDArray[np.bool_]
    steps: list[tuple[str, NDArray[np.int16]]]


def permitted(machine: StateMachine, state: NDArray, links: Links) -> NDArray[np.bool_]:
    """Which edges the machine allows: within a state natural ones always, any other where the one state may follow.

    Args:
        machine: the states.
        state: the number of each node's state, NO_STATE for none: no edge of theirs is allowed.  # (N,)
        links: the edges.
    """
    count = len(machine.states)
    allowed = np.zeros((count + 1, count + 1), dtype=np.bool_)  # NO_STATE is the last row and column
    for here, there in machine.allowed:
        allowed[here, there] = True
    here, there = state[links.source], state[links.target]
    return allowed[here, there] | (links.natural & (here == there) & (here != NO_STATE))


def lasting_parts(machine: StateMachine, state: NDArray, links: Links, *, hand_over: bool = True) -> Parts:
    """What the steps leave: nodes from which all of them can be reached, and those of states within these.

    Of strongly connected parts of one size the one with the lowest node is taken.

    Args:
        machine: the states.
        state: the number of each node's state by its label, NO_STATE for none.  # (N,)
        links: the edges.
        hand_over: whether wind-ups, recoveries and entries are told and kept; else they are deleted.
    """
    state = np.asarray(state, dtype=np.int16)
    steps = [("labelled", state)]
    staying = [here for here, there in sorted(machine.allowed) if here == there]
    while True:
        state = connected = _connected(machine, state, links)
        steps.append(("connected", connected))
        for number in staying:
            state = _within(state, number, links.where(permitted(machine, state, links)), staying, hand_over)
        if (state == connected).all():
            return Parts(state, permitted(machine, state, links), steps)
        steps.append(("within states", state))


def missing_states(machine: StateMachine, state: NDArray) -> list[int]:
    """The numbers of the states that no node is in."""
    there = set(state.tolist())
    return [number for number in range(len(machine.states)) if number not in there]


def _connected(machine: StateMachine, state: NDArray, links: Links) -> NDArray[np.int16]:
    """States of the nodes in the largest strongly connected part of what is allowed, NO_STATE of others.  # (N,)"""
    allowed = links.where(permitted(machine, state, links))
    part = largest_component(len(state), allowed.source, allowed.target)
    left = np.full_like(state, NO_STATE)
    left[part] = state[part]
    return left


def _within(state: NDArray, number: int, links: Links, staying: list[int], hand_over: bool) -> NDArray[np.int16]:
    """States once of one of them only the largest strongly connected part of its own is left.  # (N,)

    With ``hand_over`` its entries are left too, and wind-ups and recoveries go to the states they belong to: what only
    leads out goes to the state that follows in the capture, what only leads back to the one before it, or stays where
    characters stay in that one too. As states are handed on along the capture only, that comes to an end.
    """
    own = links.where((state[links.source] == number) & (state[links.target] == number))
    part = largest_component(len(state), own.source, own.target)
    left = np.where(state == number, NO_STATE, state)
    if part.size and hand_over:
        follows = np.zeros(len(state), dtype=np.bool_)
        follows[links.source[links.natural]] = True
        out = np.setdiff1d(_reached(part[0], own.source, own.target, len(state)), part)
        for node in out[follows[out]][::-1].tolist():
            left[node] = left[node + 1]
        back = np.setdiff1d(_reached(part[0], own.target, own.source, len(state)), part)
        left[back] = number if len(staying) > 1 else NO_STATE
        for node in back[follows[back - 1]].tolist():
            if left[node - 1] not in staying:
                left[node] = left[node - 1]
    left[part] = number
    return left


def _reached(start: int, source: NDArray, target: NDArray, count: int) -> NDArray[np.intp]:
    """The nodes that edges lead to from one, ascending."""
    matrix = csr_array((np.ones(len(source), dtype=np.int8), (source, target)), shape=(count, count))
    return np.sort(breadth_first_order(matrix, start, return_predecessors=False))
