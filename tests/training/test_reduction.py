import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from footwork.errors import InputError
from footwork.training import reduction
from footwork.training.graph_options import ORDERS
from footwork.training.path_cost import UNIT
from footwork.training.reduction import reduced
from random_graphs import RandomGraph, random_graph

MUS = (1.0, 1.1, 2.0, 5.0, 100.0)
SEEDS = st.integers(0, 10_000)
STREAMS = st.integers(1, 3)


def costs_between_originals(graph: RandomGraph, edges: Any = slice(None)):
    """All best-path costs, with none of the code under test."""
    order = np.argsort(-graph.base[edges], kind="stable")  # of parallel edges the cheapest is written last
    matrix = np.zeros((graph.nodes, graph.nodes))
    matrix[graph.source[edges][order], graph.target[edges][order]] = graph.base[edges][order]
    np.fill_diagonal(matrix, 0)
    return dijkstra(csr_array(matrix), indices=np.arange(graph.originals))[:, : graph.originals]


def rounds_in_order(graph: RandomGraph, streams: int) -> list[list[int]]:
    """Which originals are searched from side by side: clip by clip, each from its last frame to its first."""
    edges = zip(graph.source.tolist(), graph.target.tolist(), graph.base.tolist(), strict=True)
    joined = {a for a, b, cost in edges if b == a + 1 and b < graph.originals and cost == UNIT}
    runs: list[list[int]] = [[]]
    for node in range(graph.originals):
        runs[-1].insert(0, node)
        if node not in joined:
            runs.append([])
    own: list[list[list[int]]] = [[] for _ in range(streams)]
    for run in sorted(runs, key=len, reverse=True):
        min(own, key=lambda mine: sum(map(len, mine))).append(run)
    queues = [[node for run in sorted(mine) for node in run] for mine in own]
    return [[queue[turn] for queue in queues if turn < len(queue)] for turn in range(max(map(len, queues)))]


def slow_labels(graph: RandomGraph, cost, origin: int):
    """Bellman and Ford: every edge again and again until nothing falls."""
    label = np.full(graph.nodes, np.inf)
    label[origin] = 0
    for _ in range(graph.nodes):
        np.minimum.at(label, graph.target, label[graph.source] + cost)
    return label


def slow_paths(graph: RandomGraph, mu: float, kept, origin: int) -> set[int]:
    """The edges of the best paths over the whole graph, with the rules for ties written out."""
    both, chosen = kept[graph.source] & kept[graph.target], set()
    cost = np.where(both, graph.base, np.floor(mu * graph.base))
    label = slow_labels(graph, cost, origin)
    best = np.flatnonzero(np.isfinite(label[graph.target]) & (label[graph.source] + cost == label[graph.target]))
    first = np.lexsort((best, graph.base[best], graph.source[best], ~kept[graph.source[best]]))
    last = {int(graph.target[edge]): int(edge) for edge in best[first][::-1]}
    for wanted in np.flatnonzero(np.isfinite(label[: graph.originals])).tolist():
        while wanted != origin:
            chosen.add(last[wanted])
            wanted = int(graph.source[last[wanted]])
    return chosen


def slowly_reduced(graph: RandomGraph, mu: float, streams: int) -> tuple[list[int], list[int]]:
    """The definition: searches of a round all see what was kept before it."""
    kept, chosen = np.arange(graph.nodes) < graph.originals, set()
    for origins in rounds_in_order(graph, streams):
        chosen = chosen.union(*(slow_paths(graph, mu, kept, origin) for origin in origins))
        kept[graph.source[sorted(chosen)]] = True
    return np.flatnonzero(kept).tolist(), sorted(chosen)


@given(SEEDS, st.sampled_from(MUS), STREAMS, st.booleans())
@settings(max_examples=60, deadline=None)
def test_it_keeps_what_the_definition_keeps_node_for_node_and_edge_for_edge(seed, mu, streams, ties):
    graph = random_graph(seed, ties=ties)
    found = reduced(*graph, mu, streams=streams)
    assert (found.nodes.tolist(), found.edges.tolist()) == slowly_reduced(graph, mu, streams)


@given(SEEDS, st.booleans())
@settings(max_examples=40, deadline=None)
def test_at_mu_one_every_best_cost_between_originals_stays(seed, ties):
    graph = random_graph(seed, ties=ties)
    np.testing.assert_array_equal(
        costs_between_originals(graph, reduced(*graph, 1.0).edges), costs_between_originals(graph)
    )


@given(SEEDS, st.floats(1.0, 20.0), st.sampled_from(ORDERS), STREAMS)
@settings(max_examples=60, deadline=None)
def test_costs_are_at_most_mu_times_the_best(seed, mu, order, streams):
    graph = random_graph(seed, chains=20, edges=250)
    best = costs_between_originals(graph)
    kept = costs_between_originals(graph, reduced(*graph, mu, order=order, streams=streams).edges)
    assert np.all(kept <= mu * best)
    np.testing.assert_array_equal(np.isinf(kept), np.isinf(best))


@given(SEEDS, st.sampled_from(MUS), STREAMS, st.booleans(), st.sampled_from([400, 1500]))
@settings(max_examples=100, deadline=None)
def test_passing_over_what_cannot_matter_changes_nothing(seed, mu, streams, ties, edges):
    graph = random_graph(seed, clips=4, chains=30, edges=edges, ties=ties)
    pruned, whole = (reduced(*graph, mu, streams=streams, prune=prune) for prune in (True, False))
    np.testing.assert_array_equal(pruned.nodes, whole.nodes)
    np.testing.assert_array_equal(pruned.edges, whole.edges)


@pytest.mark.parametrize("seed", [5, 16, 20, 29])
def test_a_stream_looks_for_paths_to_what_another_found_beyond_its_budgets(seed):
    # graphs for which keeping the budgets as they were would lose paths
    graph = random_graph(seed, clips=4, chains=100, edges=1500, longest=40)
    pruned, whole = (reduced(*graph, 2.0, streams=2, prune=prune) for prune in (True, False))
    np.testing.assert_array_equal(pruned.edges, whole.edges)


def test_what_another_stream_keeps_is_reached_from_nodes_that_were_searched_before():
    # a graph in which the best way to such a node leaves one whose budget was large enough all along
    graph = random_graph(84, clips=4, chains=60, edges=900, longest=20, ties=True)
    pruned, whole = (reduced(*graph, 1.1, streams=2, prune=prune) for prune in (True, False))
    np.testing.assert_array_equal(pruned.edges, whole.edges)


def test_streams_side_by_side_find_the_same_every_time():
    graph = random_graph(5, clips=6, chains=60, edges=900)
    found = [reduced(*graph, 2.0, streams=3).edges.tolist() for _ in range(5)]
    assert all(edges == found[0] for edges in found)


def test_passing_over_what_cannot_matter_saves_work():
    graph = random_graph(1, clips=20, chains=600, edges=20_000)
    pruned, whole = (reduced(*graph, 5.0, prune=prune) for prune in (True, False))
    np.testing.assert_array_equal(pruned.edges, whole.edges)
    assert pruned.looked < 0.8 * whole.looked


@given(SEEDS)
@settings(max_examples=20, deadline=None)
def test_edges_in_another_order_of_the_input_are_kept_alike(seed):
    graph = random_graph(seed)
    shuffled = np.random.default_rng(seed).permutation(len(graph.source))
    other = RandomGraph(*graph[:2], *(array[shuffled] for array in graph[2:]))
    ends = [
        {(int(of.source[e]), int(of.target[e]), int(of.base[e])) for e in reduced(*of, 3.0).edges}
        for of in (graph, other)
    ]
    assert ends[0] == ends[1]


@pytest.mark.parametrize("mu", [1.0, 5.0, 1e300, math.inf])
def test_originals_and_the_natural_edges_between_them_stay(mu):
    graph = random_graph(7)
    found = reduced(*graph, mu)
    natural = np.flatnonzero(
        (graph.target == graph.source + 1) & (graph.target < graph.originals) & (graph.base == UNIT)
    )
    assert found.nodes[: graph.originals].tolist() == list(range(graph.originals))
    assert set(natural) <= set(found.edges)


def test_a_larger_mu_keeps_less():
    graph = random_graph(3, clips=6, chains=60, edges=900)
    sizes = [len(reduced(*graph, mu).nodes) for mu in (1.0, 2.0, 10.0, 1e6)]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[0] > sizes[-1]


def test_the_orders_of_clips_give_other_graphs_and_each_the_same_one_again():
    graph = random_graph(5, clips=6, chains=60, edges=900)
    options: list[dict[str, Any]] = [{"order": "frames"}, {"order": "reverse"}, {"order": "random", "seed": 3}]
    found = [reduced(*graph, 5.0, **option).nodes.tolist() for option in options]
    again = [reduced(*graph, 5.0, **option).nodes.tolist() for option in options]
    assert found == again
    assert len({tuple(nodes) for nodes in found}) == 3


def test_a_way_longer_than_small_numbers_hold_is_kept_all_the_same():
    # from original 0 over 400 interpolated nodes to original 1, at the largest mu
    way = np.array([0, *range(2, 402), 1], dtype=np.int32)
    base = np.full(401, 6 * UNIT, dtype=np.int32)
    found = reduced(402, 2, way[:-1], way[1:], base, 1e9)
    assert len(found.nodes) == 402
    assert len(found.edges) == 401


def test_originals_that_nothing_joins_stay_alone():
    empty = np.empty(0, dtype=np.int32)
    found = reduced(5, 3, empty, empty, empty, 5.0)
    assert found.nodes.tolist() == [0, 1, 2]
    assert len(found.edges) == 0
    assert len(reduced(0, 0, empty, empty, empty, 5.0).nodes) == 0


def test_of_parallel_edges_the_cheapest_is_kept_and_loops_never():
    source, target = np.array([0, 0, 0, 0], dtype=np.int32), np.array([0, 1, 1, 1], dtype=np.int32)
    base = np.array([UNIT, 3 * UNIT, 2 * UNIT, 2 * UNIT], dtype=np.int32)
    assert reduced(2, 2, source, target, base, 2.0).edges.tolist() == [2]


def test_progress_reaches_one_and_an_interruption_passes_through():
    graph, shares = random_graph(2), []
    reduced(*graph, 5.0, progress=shares.append)
    assert shares == sorted(shares)
    assert (len(shares), shares[-1]) == (len(rounds_in_order(graph, reduction.STREAMS)), 1.0)

    def interrupt(share: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reduced(*graph, 5.0, progress=interrupt)


@pytest.mark.parametrize("mu", [0.99, 0.0, -1.0, math.nan])
def test_mu_below_one_is_refused(mu):
    with pytest.raises(InputError, match=r"^mu: .*expected at least 1$"):
        reduced(*random_graph(0), mu)


def test_another_order_is_refused_by_its_name():
    with pytest.raises(InputError, match="order: 'best', expected one of frames, reverse, random"):
        reduced(*random_graph(0), 5.0, order="best")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"base": np.array([UNIT - 1])}, "edges cost 1023"),
        ({"base": np.array([1 << 16])}, "edges cost 65536"),
        ({"target": np.array([2])}, "nodes that are not there"),
        ({"source": np.array([-1])}, "nodes that are not there"),
        ({"originals": 3}, "3 originals among 2 nodes"),
    ],
)
def test_graphs_that_are_none_are_refused(change, message):
    fields = {"count": 2, "originals": 1, "source": np.array([0]), "target": np.array([1]), "base": np.array([UNIT])}
    with pytest.raises(InputError, match=message):
        reduced(**(fields | change), mu=2.0)
