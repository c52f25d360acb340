import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from flat_graphs import distances, line, random_graph, sources_of
from footwork.study.breadth_first import reversed_edges, ticks_between, ticks_from

graphs = st.builds(random_graph, st.integers(0, 10_000), st.integers(1, 14), st.integers(0, 40))


@settings(max_examples=60, deadline=None)
@given(graphs, st.data())
def test_ticks_are_those_of_the_nearest_source_and_back_those_to_it(graph, data):
    nodes = len(graph[0]) - 1
    sources = data.draw(st.lists(st.integers(0, nodes - 1), min_size=1, max_size=3))
    table = distances(*graph)
    back_start, before = reversed_edges(*graph)
    for ticks, expected in (
        (ticks_from(graph[0], graph[1], sources), table[sources].min(axis=0)),
        (ticks_from(back_start, before, sources), table[:, sources].min(axis=1)),
    ):
        np.testing.assert_array_equal(np.where(ticks < 0, np.inf, ticks), expected)


def test_reversed_edges_join_the_same_nodes():
    edge_start, target = random_graph(3, 20, 70)
    start, source = reversed_edges(edge_start, target)
    turned = sorted(zip(source.tolist(), sources_of(start).tolist(), strict=True))
    assert turned == sorted(zip(sources_of(edge_start).tolist(), target.tolist(), strict=True))


def test_a_table_of_ways_along_a_line():
    table = ticks_between(*line(6), [1, 4], np.array([0, 1, 5]))
    np.testing.assert_array_equal(table, [[-1, 0, 4], [-1, -1, 1]])
