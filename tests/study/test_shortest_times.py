import numpy as np
import pytest

from footwork.study.breadth_first import UNREACHED
from footwork.study.shortest_times import ticks_to_behaviour, ticks_to_turn
from motion_samples import ring_graph
from planning import graph_of_whole_turns

MOST = 9
WITHIN = np.radians(15.0)


def turns_by_brute_force(graph, limit, node: int, ticks: int):
    """The yaws and nodes that all ways of so many ticks end at, each tick turned as far as it may be to one side."""
    ends = {(node, 0.0, 0.0)}
    for _ in range(ticks):
        ends = {
            (int(there), left + yaw + limit[there], right + yaw - limit[there])
            for at, left, right in ends
            for edge in range(graph.edge_start[at], graph.edge_start[at + 1])
            for there, yaw in [(graph.target[edge], float(graph.displacement[edge, 2]))]
        }
    return ends


@pytest.mark.parametrize("radians", [0.7, -0.9, np.pi])
def test_turns_are_as_short_as_the_shortest_of_all_ways(radians):
    graph = graph_of_whole_turns(2)
    limit = np.where(graph.behaviour == 1, 0.05, 0.0)
    found = ticks_to_turn(graph, 1, radians, WITHIN, limit, MOST)
    left, right = radians % (2 * np.pi) - WITHIN, -radians % (2 * np.pi) - WITHIN
    for node in (1, 26, 40, 62):
        first = UNREACHED
        for ticks in range(1, MOST + 1):
            ends = turns_by_brute_force(graph, limit, node, ticks)
            if any(graph.behaviour[at] == 1 and (far >= left or -near >= right) for at, far, near in ends):
                first = ticks
                break
        assert found[node] == first


def test_a_ring_turns_by_its_own_turn_and_what_it_may_add():
    graph, none = ring_graph(12, np.radians(5.01)), np.zeros(12)
    assert (ticks_to_turn(graph, 1, np.radians(90.0), WITHIN, none, 100) == 15).all()
    assert (ticks_to_turn(graph, 1, np.radians(-90.0), WITHIN, none, 100) == 51).all()
    assert (ticks_to_turn(graph, 1, np.radians(90.0), WITHIN, none + np.radians(5.0), 100) == 8).all()
    assert (ticks_to_turn(graph, 0, np.radians(90.0), WITHIN, none, 100) == UNREACHED).all()


def test_changes_are_as_short_as_the_edges_allow():
    graph = graph_of_whole_turns()
    ticks = ticks_to_behaviour(graph, 3)
    assert (ticks[graph.behaviour == 3] == 0).all()
    # the way from a clip to another leaves every fourth frame
    assert set(ticks[:23]) == {1, 2, 3, 4}
    assert (ticks_to_behaviour(graph, 2) == UNREACHED).all()
