from dataclasses import replace

import numpy as np

from footwork.study.graph_paths import path_nodes
from footwork.study.tour import middles, tour, tour_labels
from motion_samples import ring_graph

WORDS = ("", "crawl", "jump", "run", "walk")


def ring_of(label, **arrays):
    return replace(ring_graph(len(label)), labels=WORDS, label=np.array(label), **arrays)


def test_labels_come_in_the_usual_order_those_without_a_word_not_at_all():
    assert tour_labels(ring_of([1, 0, 2, 3, 4, 4])) == ["walk", "run", "jump", "crawl"]


def test_a_tour_comes_through_the_middle_of_every_label_and_back():
    label = np.repeat([4, 2, 0, 3, 1], 12)
    graph = ring_of(label)
    edges = tour(graph)
    assert edges is not None
    nodes = path_nodes(graph, edges)
    # walk at 6, run at 42, jump at 18, crawl at 54, and 15 ticks on from there it is past 6 and must go round again
    assert len(nodes) == 1 + 36 + 36 + 36 + 72
    assert (nodes[0], nodes[36], nodes[72], nodes[108], nodes[-1]) == (6, 42, 18, 54, 6)


def test_short_stretches_are_passed_over_where_there_are_long_ones():
    label = np.concatenate([np.full(4, 2), np.full(8, 4), np.full(15, 2), np.full(6, 4)])
    graph = ring_of(label)
    assert middles(graph, "jump").tolist() == [12 + 7]
    assert middles(graph, "walk").tolist() == [8]


def test_frames_between_two_are_no_stops():
    label, weight = np.repeat([4, 2], 12), np.ones(24)
    weight[8:12] = 0.5
    assert middles(ring_of(label, weight=weight), "walk").tolist() == [4]


def test_there_is_no_tour_of_one_label_or_without_a_way():
    assert tour(ring_graph(12)) is None
    graph = ring_of(np.repeat([4, 2], 12))
    two_rings = np.where(np.arange(24) == 11, 0, np.where(np.arange(24) == 23, 12, graph.target))
    assert tour(replace(graph, target=two_rings)) is None
