import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flat_graphs import csr, distances, line, random_graph, ring, sources_of
from footwork.study.maneuverability import maneuverability, segments


def chains(edge_start, target):
    """Last node and number of nodes of each segment, by joining pairs until nothing changes."""
    source, nodes = sources_of(edge_start), len(edge_start) - 1
    alone = (np.bincount(source, minlength=nodes)[source] == 1) & (np.bincount(target, minlength=nodes)[target] == 1)
    after = {int(a): int(b) for a, b in zip(source[alone], target[alone], strict=True) if a != b}
    found = []
    left = set(range(nodes))
    for start in [n for n in range(nodes) if n not in after.values()] + list(range(nodes)):
        if start in left:
            walk = [start]
            left.discard(start)
            while after.get(walk[-1]) in left:
                walk.append(after[walk[-1]])
                left.discard(walk[-1])
            found.append((walk[-1], len(walk)))
    return sorted(found)


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 16), st.integers(0, 24))
def test_every_node_is_in_one_segment_and_none_has_a_branch_inside(seed, nodes, edges):
    graph = random_graph(seed, nodes, edges)
    cut = segments(*graph)
    assert sorted(zip(cut.last.tolist(), cut.length.tolist(), strict=True)) == chains(*graph)
    assert cut.length.sum() == nodes


def reentry_by_search(graph, inside):
    """Ticks to the next entry from outside: shortest ways in the graph of nodes that remember whether they left."""
    edge_start, target = graph
    nodes, source = len(edge_start) - 1, sources_of(graph[0])
    # node n as long as the kind was not left, node n + nodes once it was (and from anywhere outside it)
    left = ~inside
    source2 = np.concatenate([source[inside[source]], source[left[source]] + nodes])
    end = np.concatenate([target[inside[source]], target[left[source]] + nodes])
    end = np.where((end < nodes) & left[end % nodes], end + nodes, end)
    table = distances(*csr(2 * nodes, source2, end))
    begin = np.where(inside, np.arange(nodes), np.arange(nodes) + nodes)
    return table[np.ix_(begin, np.flatnonzero(inside) + nodes)].min(axis=1, initial=np.inf)


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 14), st.integers(0, 40), st.booleans())
def test_maneuverability_is_that_of_the_formula(seed, nodes, edges, reentry):
    graph = random_graph(seed, nodes, edges)
    kind = np.random.default_rng(seed).integers(-1, 3, nodes)
    found = maneuverability(*graph, kind, ("a", "b", "c"), reentry=reentry)
    cut, table = segments(*graph), distances(*graph)
    for name, seconds, answered in zip(found.kinds, found.seconds, found.answered, strict=True):
        inside = kind == ("a", "b", "c").index(name)
        to_kind = reentry_by_search(graph, inside) if reentry else table[:, inside].min(axis=1)
        ends = to_kind[cut.last]
        known = np.isfinite(ends)
        assert answered == pytest.approx(known.mean())
        if known.any():
            assert seconds == pytest.approx((0.5 * (cut.length[known] - 1) + ends[known]).mean() / 30)
        else:
            assert np.isnan(seconds)
    assert set(found.kinds) == {"abc"[index] for index in np.unique(kind[kind >= 0])}


def test_on_two_loops_that_meet_the_times_are_known():
    # 0 1 2 3 (a) and 4 5 6 7 (b) go round through 0, which leads to 1 and to 4
    graph = csr(8, [0, 1, 2, 3, 0, 4, 5, 6, 7], [1, 2, 3, 0, 4, 5, 6, 7, 0])
    kind = np.repeat([0, 1], 4)
    # segments: 0 (end 0), 1-3 (end 3), 4-7 (end 7)
    plain = maneuverability(*graph, kind, ("a", "b"))
    ticks = {"a": (0 + (1 + 0) + (1.5 + 1)) / 3, "b": ((0 + 1) + (1 + 2) + 1.5) / 3}
    assert plain.by_kind() == {name: pytest.approx(value / 30) for name, value in ticks.items()}
    assert plain.mean == pytest.approx(sum(ticks.values()) / 60)
    again = maneuverability(*graph, kind, ("a", "b"), reentry=True)
    # from 0 it takes four ticks through b to come to a again, and two from 7 round to b
    ticks = {"a": (5 + (1 + 6) + (1.5 + 1)) / 3, "b": ((0 + 1) + (1 + 2) + (1.5 + 2)) / 3}
    assert again.by_kind() == {name: pytest.approx(value / 30) for name, value in ticks.items()}


def test_from_chosen_frames_it_is_the_mean_time_from_each():
    kind = np.repeat([0, 1], [9, 3])
    found = maneuverability(*ring(12), kind, ("a", "b"), frames=np.array([0, 4, 10]))
    assert found.by_kind() == {"a": pytest.approx(2 / 3 / 30), "b": pytest.approx((9 + 5 + 0) / 3 / 30)}


def test_a_loop_is_one_segment_and_what_is_never_left_is_never_entered_anew():
    cut = segments(*ring(9))
    assert (cut.last.tolist(), cut.length.tolist()) == ([8], [9])
    found = maneuverability(*ring(9), np.zeros(9), ("a",), reentry=True)
    assert (found.answered.tolist(), found.mean, found.by_kind()) == ([0.0], None, {"a": None})
    assert maneuverability(*ring(9), np.zeros(9), ("a",)).mean == pytest.approx(4 / 30)
    assert maneuverability(*line(4), np.full(4, -1), ("a",)).mean is None
