import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flat_graphs import distances, line, random_graph, sources_of
from footwork.errors import InputError
from footwork.motion.kinematics import clip_places
from footwork.study.graph_paths import (
    best_path,
    best_path_through,
    natural_path,
    path_clip,
    path_costs,
    path_nodes,
    path_seconds,
)
from motion_samples import ring_graph
from toy_graphs import edge_between, graph_of, wandering_clip


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 14), st.integers(0, 50))
def test_a_best_path_costs_as_little_as_any(seed, nodes, edges):
    edge_start, target = random_graph(seed, nodes, edges)
    rng = np.random.default_rng(seed)
    cost, start = rng.integers(0, 5, edges).astype(float), int(rng.integers(nodes))
    goals = rng.integers(0, nodes, 2)
    least = distances(edge_start, target, cost)[start, goals].min()
    if not np.isfinite(least):
        with pytest.raises(InputError, match="no path"):
            best_path(edge_start, target, cost, start, goals)
        return
    path = best_path(edge_start, target, cost, start, goals)
    assert cost[path].sum() == least
    stations = [start, *target[path]]
    np.testing.assert_array_equal(sources_of(edge_start)[path], stations[:-1])
    assert stations[-1] in goals


def test_a_smooth_detour_is_taken_up_to_five_frames():
    assert path_costs([1.0, 0.5, 0.0]).tolist() == [1.0, 3.5, 6.0]
    edge_start = np.array([0, 2, 3, 4, 5, 6, 6])
    target = np.array([1, 5, 2, 3, 4, 5])
    for rough, taken in ((0.2, 1), (0.1, 5)):
        cost = path_costs([1, rough, 1, 1, 1, 1])
        assert len(best_path(edge_start, target, cost, 0, 5)) == taken


@pytest.mark.parametrize(("start", "goals"), [(-1, [2]), (0, [9]), (9, [0]), (0, []), (0, [-2])])
def test_nodes_that_are_not_there_are_refused(start, goals):
    with pytest.raises(InputError, match="expected nodes 0 to 4"):
        best_path(*line(5), np.ones(4), start, goals)


def test_the_natural_path_of_a_clip_is_the_clip():
    clip = wandering_clip(1, 14)
    graph = graph_of([clip], [(13, 0)])
    laid = path_clip(graph, natural_path(graph, 0, 99))
    before, after = clip_places(clip)[0], clip_places(laid)[0]
    spread = [np.linalg.norm(p.reshape(-1, 1, 3) - p.reshape(1, -1, 3), axis=-1) for p in (before, after)]
    np.testing.assert_allclose(spread[0], spread[1], atol=1e-4)
    np.testing.assert_array_equal(laid.labels, np.full(14, "walk"))
    assert path_seconds(natural_path(graph, 0, 99)) == pytest.approx(clip.seconds)


def test_a_path_goes_on_from_where_a_transition_laid_it():
    clips = [wandering_clip(seed, 10) for seed in range(2)]
    graph = graph_of(clips, [(4, 13), (19, 0)])
    path = best_path_through(graph, [2, 17])
    assert path_nodes(graph, path).tolist() == [2, 3, 4, 14, 15, 16, 17]
    laid, second = clip_places(path_clip(graph, path))[0], clip_places(clips[1])[0]
    # the second part moves as it was captured
    between = [np.linalg.norm(p[:, None, :, None] - p[None, :, None], axis=-1) for p in (laid[3:], second[4:8])]
    np.testing.assert_allclose(between[0], between[1], atol=1e-5)
    # and lies one captured step from where the first part was left
    step = graph.displacement[edge_between(graph, 4, 14)]
    moved = np.linalg.norm(laid[3, 0, [0, 2]] - laid[2, 0, [0, 2]])
    assert moved == pytest.approx(np.linalg.norm(step[:2]), abs=1e-6)


def test_stops_are_visited_in_turn_and_motion_goes_on_after_each():
    graph = ring_graph(12)
    assert path_nodes(graph, best_path_through(graph, [3, [9, 5], 2])).tolist() == [
        3,
        4,
        5,
        6,
        7,
        8,
        9,
        10,
        11,
        0,
        1,
        2,
    ]
    again = path_nodes(graph, best_path_through(graph, [0, [1], [2]], ticks=3)).tolist()
    assert again == [*range(12), *range(12), 0, 1, 2]


@pytest.mark.parametrize("stops", [[], [3], [[1, 2], 3], [[], 3]])
def test_a_path_needs_one_beginning_and_a_stop(stops):
    with pytest.raises(InputError, match="expected one node and then"):
        best_path_through(ring_graph(12), stops)


def test_a_path_that_breaks_off_is_refused():
    with pytest.raises(InputError, match="end to end"):
        path_nodes(ring_graph(6), np.array([0, 2]))
    with pytest.raises(InputError, match="at least one"):
        path_nodes(ring_graph(6), np.array([], dtype=int))
