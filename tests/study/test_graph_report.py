import json
from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.study import graph_report as module
from footwork.study.graph_report import graph_report
from motion_samples import ring_graph
from toy_graphs import graph_of, wandering_clip


def test_only_captured_frames_count_as_frames():
    graph = ring_graph(12)
    weight = np.where(np.arange(12) % 2, 0.5, 1.0)
    report = graph_report(replace(graph, weight=weight), frames=20)
    json.dumps(report, allow_nan=False)
    assert report["transition_time"]["sources"] == 6
    # ways of 2, 4 .. 10 ticks
    assert report["transition_time"]["mean_s"] == pytest.approx(6 / 30)
    assert report["connectivity"]["scc_fraction"] == pytest.approx(6 / 20)
    assert report["connectivity"]["closure_share"] == pytest.approx(6 * 5 / (20 * 19))
    assert report["transition_jumps"] is report["tour"] is None


def test_times_and_maneuverability_are_there_for_labels_and_behaviours():
    graph = graph_of([wandering_clip(seed, 12) for seed in range(2)], [(11, 11), (23, -1), (5, 17)])
    graph = replace(graph, labels=("duck", "walk"), label=np.repeat([0, 1], 12), behaviour=np.repeat([-1, 1], 12))
    report = graph_report(graph)
    json.dumps(report, allow_nan=False)
    assert report["label_times_least_s"][0] == {"from": "duck", "duck": 0.0, "walk": pytest.approx(1 / 30)}
    assert [row["from"] for row in report["behaviour_times_mean_s"]] == ["walk"]
    assert {row["label"] for row in report["maneuverability_by_label"]} == {"duck", "walk"}
    assert report["maneuverability_s"]["labels"] > report["maneuverability_s"]["behaviours"]
    assert report["tour"]["through"] == ["walk", "duck"]
    assert report["transition_jumps"]["sampled"] == 3
    assert report["connectivity"]["closure_share"] is None


def test_a_large_graph_is_sampled_and_says_so(monkeypatch):
    monkeypatch.setattr(module, "_EXACT_WORK", 1)
    monkeypatch.setattr(module, "SAMPLED_SOURCES", 5)
    times = graph_report(ring_graph(40))["transition_time"]
    assert (times["sources"], times["exact"]) == (5, False)
    low, high = times["interval_95_s"]
    assert low <= times["mean_s"] <= high
    assert times["mean_s"] == pytest.approx(20 / 30)


def test_a_graph_without_captured_frames_is_refused():
    with pytest.raises(InputError, match="no captured frames"):
        graph_report(replace(ring_graph(4), weight=np.full(4, 0.5)))
