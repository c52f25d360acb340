import numpy as np

from footwork.training import chosen_edges
from footwork.training.chosen_edges import ChosenEdges

START, TARGET, BASE = np.array([0, 3, 4]), np.array([1, 1, 0, 0]), np.array([9, 8, 7, 6])


def test_pairs_that_come_often_are_one_edge_and_of_parallel_ones_the_cheapest(monkeypatch):
    monkeypatch.setattr(chosen_edges, "_MOST", 3)
    links = ChosenEdges()
    for _ in range(5):
        links.add(np.array([0, 1], dtype=np.int32), np.array([1, 0], dtype=np.int32))
    assert links.edges(START, TARGET, BASE).tolist() == [1, 3]


def test_no_pairs_are_no_edges():
    assert len(ChosenEdges().edges(START, TARGET, BASE)) == 0
