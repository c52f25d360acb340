"""Segments and the quickest ways between them, against a search over frames that knows of no segments."""

import heapq
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion.annotation import NO_WAY, Annotation
from footwork.motion.graph import MotionGraph
from footwork.motion.state_machine import State, StateMachine
from footwork.training.annotated_recipe import annotated
from toy_graphs import graph_of, wandering_clip

MACHINE = StateMachine(
    (
        State("move", ("move",), ("move", "hit", "rest"), ("hit", "move")),
        State("hit", ("hit",), ("move",)),
        State("rest", ("rest",), ("move",)),
    )
)
ENDS = (8, 17, 26)
FRAMES = graph_of([wandering_clip(seed, 9) for seed in range(3)], [])
COSTS = (0.0, 0.125, 0.25)  # few of them, whole in 1/1024, so that sums are often equal


def linked(jumps: list[tuple[int, int, float]], cuts: tuple[int, ...] = ENDS) -> MotionGraph:
    """Three clips of nine frames: the capture, cut after some frames, and transitions of some cost."""
    edges = sorted([(node, node + 1, False, 0.0) for node in range(26) if node not in cuts])
    edges = sorted(edges + [(source, target, True, cost) for source, target, cost in jumps], key=lambda edge: edge[0])
    source, target, jump, cost = (np.array(column) for column in zip(*edges, strict=True))
    return replace(
        FRAMES,
        edge_start=np.searchsorted(source, np.arange(28)),
        target=target,
        cost=cost,
        natural=~jump,
        smoothness=np.ones(len(edges)),
        displacement=np.zeros((len(edges), 3)),
    )


@st.composite
def graphs(draw):
    """A graph of three clips, of which the machine forbids no edge, and the state of each node."""
    node = st.integers(0, 26)
    state = np.repeat(draw(st.lists(st.sampled_from([0, 0, 1, 2]), min_size=9, max_size=9)), 3)
    jumps = draw(st.lists(st.tuples(node, node, st.sampled_from(COSTS)), min_size=2, max_size=30))
    pairs = MACHINE.allowed
    cuts = {at for at in range(26) if state[at] != state[at + 1] and (state[at], state[at + 1]) not in pairs}
    kept = [(a, b, cost) for a, b, cost in jumps if (state[a], state[b]) in pairs]
    return linked(kept, (*ENDS, *cuts)), state


def quickest(graph: MotionGraph, inside: np.ndarray, start: int, goal: int) -> tuple[int, int] | None:
    """Frames between two and 1024ths of s on the way, by Dijkstra's search over frames; the first edge is free."""
    queue = [(0, 0, start, True)]
    done = set()
    while queue:
        ticks, rough, node, first = heapq.heappop(queue)
        if node == goal and not first:
            return ticks - 1, rough
        if (node, first) in done or not (inside[node] or first):
            continue
        done.add((node, first))
        for edge in range(graph.edge_start[node], graph.edge_start[node + 1]):
            further = rough + round(1024 * float(graph.cost[edge]))
            heapq.heappush(queue, (ticks + 1, further, int(graph.target[edge]), False))
    return None


@settings(max_examples=50, deadline=None)
@given(graphs())
def test_segments_are_the_longest_stretches_without_a_branch(made):
    graph, state = made
    found = annotated(graph, MACHINE, state)
    found.require_fits(graph)
    out = [graph.target[graph.edge_start[n] : graph.edge_start[n + 1]].tolist() for n in range(graph.node_count)]
    for node in range(graph.node_count - 1):
        ways_in = sum(targets.count(node + 1) for targets in out)
        joined = out[node] == [node + 1] and ways_in == 1 and state[node] == state[node + 1]
        natural = graph.natural[graph.edge_start[node]] if out[node] else False
        assert (found.segment[node] == found.segment[node + 1]) == (joined and natural)


@settings(max_examples=50, deadline=None)
@given(graphs())
def test_ways_are_the_quickest_and_the_smoothest_of_these(made):
    graph, state = made
    found = annotated(graph, MACHINE, state)
    for pair, hops in zip(MACHINE.at_once, found.ways, strict=True):
        inside = np.isin(state, pair)
        for row, segment in enumerate(found.between(pair)):
            for column, goal in enumerate(found.of_state(pair[1])):
                best = quickest(graph, inside, int(found.last[segment]), int(found.first[goal]))
                assert hops.delay[row, column] == (NO_WAY if best is None else best[0])
                assert walked(graph, found, pair, int(segment), int(goal)) == best


def walked(graph: MotionGraph, found: Annotation, pair, segment: int, goal: int) -> tuple[int, int] | None:
    """Frames between two segments and 1024ths of s on the way that the tables tell, hop by hop."""
    frames, rough, there = 0, 0, None
    for edge in found.hops(graph, pair, segment, goal):
        frames += 0 if there is None else int(found.length[there])
        rough += round(1024 * float(graph.cost[edge]))
        there = found.segment[graph.target[edge]]
    return None if there is None else (frames, rough)


def test_of_ways_alike_in_all_the_edge_of_the_lowest_number_is_taken():
    # from the end of the first clip two frames lead on to the end of the third
    graph = linked([(8, 13, 0.0), (8, 10, 0.0), (10, 18, 0.0), (13, 18, 0.0)], (8, 9, 10, 12, 13))
    assert reached_first(graph) == 13
    graph = linked([(8, 10, 0.0), (8, 13, 0.0), (10, 18, 0.0), (13, 18, 0.0)], (8, 9, 10, 12, 13))
    assert reached_first(graph) == 10


def test_a_smoother_way_wins_only_over_one_that_is_as_quick():
    onward = [(10, 18, 0.0), (13, 18, 0.0), (15, 18, 0.0)]
    graph = linked([(8, 10, 0.5), (8, 13, 0.25), (8, 14, 0.0), *onward], (8, 9, 10, 12, 13, 15))
    assert reached_first(graph) == 13


def reached_first(graph: MotionGraph) -> int:
    """Where the way from the end of the first clip to the beginning of the third leads first."""
    found = annotated(graph, MACHINE, np.repeat([0, 0, 1], 9))
    edge = found.ways[1].edge[found.segment[8], 0]
    return int(graph.target[edge])
