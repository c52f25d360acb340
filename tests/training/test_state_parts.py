"""What a state machine leaves of a graph, against the same steps on sets of nodes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion.state_machine import NO_STATE, State, StateMachine
from footwork.training.state_parts import Links, lasting_parts, missing_states, permitted

FIGHT = StateMachine(
    (
        State("move", ("move",), ("move", "hit", "dodge"), ("hit", "dodge")),
        State("hit", ("hit",), ("move",)),
        State("dodge", ("dodge",), ("move",)),
    )
)


GO = StateMachine(
    (
        State("stand", ("stand",), ("stand", "go", "leap")),
        State("go", ("go",), ("go", "stand")),
        State("leap", ("leap",), ("go",)),
    )
)


def links_of(count: int, ends: set[int], jumps: list[tuple[int, int]]) -> Links:
    natural = [(node, node + 1) for node in range(count - 1) if node not in ends]
    source, target = np.array(natural + jumps, dtype=np.int64).reshape(-1, 2).T
    return Links(source, target, np.arange(len(source)) < len(natural))


def reached(start: int, nodes: set[int], edges: list[tuple[int, int]]) -> set[int]:
    found, waiting = {start}, [start]
    while waiting:
        here = waiting.pop()
        more = {b for a, b in edges if a == here and b in nodes} - found
        found |= more
        waiting += more
    return found


def largest(nodes: set[int], edges: list[tuple[int, int]]) -> set[int]:
    back = [(b, a) for a, b in edges]
    parts = [reached(node, nodes, edges) & reached(node, nodes, back) for node in sorted(nodes)]
    cyclic = [part for part in parts if len(part) > 1 or (min(part), min(part)) in edges]
    return max(cyclic, key=lambda part: (len(part), -min(part)), default=set())


def by_hand(state: list[int], links: Links) -> list[int]:
    """The published steps, word for word, on the fighting machine: nothing handed over."""
    every = list(zip(links.source.tolist(), links.target.tolist(), links.natural.tolist(), strict=True))
    edges = [
        (a, b)
        for a, b, natural in every
        if min(state[a], state[b]) >= 0 and (0 in (state[a], state[b]) or (natural and state[a] == state[b]))
    ]
    nodes = {node for node, one in enumerate(state) if one >= 0}
    while True:
        before = nodes
        inside = [(a, b) for a, b in edges if a in nodes and b in nodes]
        nodes = largest(nodes, inside)
        own = {node for node in nodes if state[node] == 0}
        nodes = nodes - own | largest(own, [(a, b) for a, b in inside if a in own and b in own])
        if nodes == before:
            return sorted(nodes)


@st.composite
def graphs(draw):
    count = draw(st.integers(1, 24))
    state = draw(st.lists(st.sampled_from([0, 0, 0, 1, 2, NO_STATE]), min_size=count, max_size=count))
    node = st.integers(0, count - 1)
    ends = draw(st.sets(node, max_size=4))
    return np.array(state), links_of(count, ends, draw(st.lists(st.tuples(node, node), max_size=40)))


@settings(max_examples=80, deadline=None)
@given(graphs())
def test_without_handing_over_the_published_steps_leave_the_same(graph):
    state, links = graph
    parts = lasting_parts(FIGHT, state, links, hand_over=False)
    left = np.flatnonzero(parts.state != NO_STATE)
    assert left.tolist() == by_hand(state.tolist(), links)
    np.testing.assert_array_equal(parts.state[left], state[left])


@settings(max_examples=80, deadline=None)
@given(graphs())
def test_what_is_left_hangs_together_as_a_whole_and_within_its_states(graph):
    state, links = graph
    parts = lasting_parts(FIGHT, state, links)
    left = set(np.flatnonzero(parts.state != NO_STATE).tolist())
    kept = links.where(parts.links)
    edges = list(zip(kept.source.tolist(), kept.target.tolist(), strict=True))
    assert parts.links.tolist() == permitted(FIGHT, parts.state, links).tolist()
    own = {node for node in left if parts.state[node] == 0}
    assert largest(left, edges) == left
    assert largest(own, [(a, b) for a, b in edges if a in own and b in own]) == own
    # only frames of the state with transitions within it are handed over, and only along the capture
    assert all(state[node] == 0 for node in left if parts.state[node] != state[node])


def test_a_wind_up_goes_to_the_strike_and_a_recovery_comes_from_it():
    # frames 0-4 move in a loop, 5 and 6 wind up, 7 and 8 hit, 9 recovers, 10 goes back
    state = np.array([0] * 7 + [1] * 2 + [0] * 2)
    links = links_of(11, {10}, [(4, 0), (10, 0)])
    assert lasting_parts(FIGHT, state, links).state.tolist() == [0] * 5 + [1] * 6
    published = lasting_parts(FIGHT, state, links, hand_over=False).state
    assert published.tolist() == [0] * 5 + [NO_STATE] * 6
    assert missing_states(FIGHT, published) == [1, 2]


def test_between_standing_and_going_the_capture_keeps_its_starts_and_stops():
    # 0-2 stand in a loop, 3 and 4 only start from it, 5-8 go in a loop, 9 only stops, 10 stands and leads back
    state = np.array([0] * 5 + [1] * 5 + [0])
    links = links_of(11, {10}, [(2, 0), (8, 6), (10, 0)])
    parts = lasting_parts(GO, state, links)
    assert parts.state.tolist() == [0] * 3 + [1] * 6 + [0] * 2
    assert lasting_parts(GO, state, links, hand_over=False).state.tolist() in (
        [0] * 3 + [NO_STATE] * 8,
        [NO_STATE] * 11,
    )


@settings(max_examples=80, deadline=None)
@given(graphs())
def test_from_everywhere_in_a_state_all_of_its_part_is_reached(graph):
    state, links = graph
    parts = lasting_parts(GO, state, links)
    left = set(np.flatnonzero(parts.state != NO_STATE).tolist())
    kept = links.where(parts.links)
    edges = list(zip(kept.source.tolist(), kept.target.tolist(), strict=True))
    assert largest(left, edges) == left
    for number in (0, 1):
        own = {node for node in left if parts.state[node] == number}
        inside = [(a, b) for a, b in edges if a in own and b in own]
        core = largest(own, inside)
        assert all(core <= reached(node, own, inside) for node in own)
        assert bool(core) == bool(own)


def test_a_stretch_between_two_kinds_of_strike_is_shared_where_it_can_be_left_and_entered():
    # 0-2 move in a loop, 3 hits, 4 recovers and leads home, 5 is entered from home and winds up, 6 dodges, 7 goes home
    state = np.array([0, 0, 0, 1, 0, 0, 2, 0])
    links = links_of(8, {7}, [(2, 0), (4, 0), (1, 5), (7, 0)])
    parts = lasting_parts(FIGHT, state, links)
    assert parts.state.tolist() == [0, 0, 0, 1, 1, 2, 2, 2]
    # from the recovery into the wind-up the capture went on, which the machine forbids
    assert not parts.links[(links.source == 4) & (links.target == 5)].any()


def test_edges_are_allowed_as_the_machine_says():
    state = np.array([0, 0, 1, 1, 2, NO_STATE])
    pairs = [(a, b) for a in range(6) for b in range(6)]
    source, target = np.array(pairs).T
    for natural in (False, True):
        kept = permitted(FIGHT, state, Links(source, target, np.full(36, natural)))
        for (a, b), allowed in zip(pairs, kept.tolist(), strict=True):
            here, there = state[a], state[b]
            follows = 0 in (here, there) or (natural and here == there)
            assert allowed == (min(here, there) >= 0 and follows), (a, b, natural)


@pytest.mark.parametrize("state", [[], [NO_STATE] * 3, [0, 0, 0]])
def test_what_never_comes_back_is_left_with_nothing(state):
    parts = lasting_parts(FIGHT, np.array(state, dtype=np.int16), links_of(len(state), set(), []))
    assert (parts.state == NO_STATE).all()
