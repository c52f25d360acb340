import json
from dataclasses import replace

import numpy as np
import pytest

from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.coded_values import exact
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.study.replay import Stage, replay
from footwork.study.scoring import score
from footwork.study.showing import Showing
from made_traces import trace
from motion_samples import ring_graph
from toy_bundle import toy_bundle

FIELDS = {
    "control",
    "transition",
    "transition_jumps",
    "total",
    "heading_error_deg",
    "settle_s",
    "settled_share",
    "behaviour_latency_s",
    "answered_share",
    "jumps_asked",
    "jumps_answered",
    "missing_behaviours",
    "foot_slide_cm_s",
    "skating_ratio",
    "velocity_jump_m_s",
    "switch_share",
    "turn_share",
    "decision_us",
    "tick_us",
}
SHARED = {"source_foot_slide_cm_s", "source_skating_ratio", "batch", "table_mb", "clip_mb", "intervals"}


def ring_bundle(turn: float = 0.0) -> Bundle:
    graph = ring_graph(12, turn)
    task = SteeringTask(behaviours=graph.behaviours)
    values = np.zeros((graph.node_count, 2, task.heading_bins), np.float32)
    return Bundle(graph, {"steering": PolicyTable(task, exact(values), 0.0, 1, True)})


def test_a_character_that_does_as_it_is_told_scores_one():
    report = score(ring_bundle(), [trace()])
    assert [report[name] for name in ("control", "transition", "total")] == [1.0, 1.0, 1.0]
    assert report["missing_behaviours"] == []
    assert report["ticks"] == 120


def test_a_character_that_turns_on_its_own_is_judged_at_the_frame_an_edge_leads_to():
    turn = np.radians(5.0)
    report = score(ring_bundle(turn), [trace(ticks=7)])
    turned = np.radians(5.0 * np.arange(1, 7))
    assert report["control"] == pytest.approx(np.exp(-0.5 * (turned / np.radians(30.0)) ** 2).mean(), rel=1e-6)


def test_all_fields_are_there_overall_and_for_each_trace():
    report = score(toy_bundle(), [trace("a.csv"), trace("b.csv", 300, turn=0.05, attack=1)])
    assert set(report) >= FIELDS | SHARED
    json.dumps(report, allow_nan=False)
    assert [one["file"] for one in report["traces"]] == ["a.csv", "b.csv"]
    assert all(set(one) >= FIELDS for one in report["traces"])
    weights = np.array([one["ticks"] for one in report["traces"]])
    control = np.array([one["control"] for one in report["traces"]])
    assert report["control"] == pytest.approx((weights * control).sum() / weights.sum())


def test_the_same_traces_score_the_same():
    bundle = toy_bundle()
    one, two = (score(bundle, [trace(turn=0.02, attack=1)]) for _ in range(2))
    for report in (one, two, *one["traces"], *two["traces"]):
        for name in ("decision_us", "tick_us", "batch"):
            report.pop(name, None)
    assert one == two


def test_a_missing_behaviour_scores_nothing_at_its_ticks_and_is_listed():
    report = score(ring_bundle(), [trace(ticks=140, attack=1)])
    assert report["missing_behaviours"] == ["jump"]
    assert (report["jumps_asked"], report["jumps_answered"]) == (1, 0)
    # the window of 12 source ticks covers eleven ticks of 1/30 s; the character meanwhile walks on
    assert report["control"] == pytest.approx(1.0 - 11 / 120)


def test_a_trace_that_asks_for_nothing_that_the_character_can_do_is_refused():
    with pytest.raises(InputError, match=r"^made\.csv: asks only for stop; the frames show walk$"):
        score(ring_bundle(), [trace(forward=0)])


def test_inertialisation_changes_what_is_shown_but_not_what_is_done():
    bundle = toy_bundle()
    controller = SteeringController(bundle.graph, bundle.table("steering"))
    stages = [Stage(bundle.graph, Showing(inertialise=smooth)) for smooth in (True, False)]
    smooth, bare = (replay(trace(), controller, stage) for stage in stages)
    np.testing.assert_array_equal(smooth.followed.facing, bare.followed.facing)
    np.testing.assert_array_equal(smooth.followed.cost, bare.followed.cost)
    assert np.percentile(bare.shown.switches, 95) > 2 * np.percentile(smooth.shown.switches, 95)


def test_the_cost_of_the_graph_is_charged():
    bundle = toy_bundle()
    smoothness = np.where(bundle.graph.natural, 1.0, np.exp(-2.0))
    costly = replace(bundle, graph=replace(bundle.graph, smoothness=smoothness))
    report = score(costly, [trace(ticks=400)])
    assert report["transition_jumps"] == pytest.approx(np.exp(-2.0))


def test_no_traces_is_refused():
    with pytest.raises(InputError, match="at least one"):
        score(toy_bundle(), [])
