import json
from dataclasses import replace

import numpy as np
import pytest

from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import clip_places
from footwork.motion.shadowing_task import ShadowingTask
from footwork.motion.state_machine import State, StateMachine
from footwork.motion.task import SteeringTask
from footwork.study.graph_clips import clip_of_graph, clips_of_graph
from footwork.study.inspection import inspect_bundle, inspect_clips
from footwork.study.responsiveness import PATIENCE, change_times, turn_times
from footwork.study.steered_clip import steered_clip
from footwork.training.annotated_recipe import annotated
from footwork.training.shadowing import solve_shadowing
from footwork.training.value_iteration import solve
from motion_samples import ring_graph, sample_clips
from toy_bundle import FRAMES, SHOWN, toy_bundle
from toy_graphs import graph_of, wandering_clip


def test_a_bundle_is_described_in_json():
    report = inspect_bundle(toy_bundle())
    json.dumps(report, allow_nan=False)
    assert (report["clips"], report["nodes"]) == (3, 3 * FRAMES)
    assert report["edges"] == report["transitions"] + 3 * (FRAMES - 1)
    assert report["behaviours"] == {"stop": FRAMES, "walk": FRAMES, "run": 0, "jump": FRAMES}
    assert sum(report["labels"].values()) == report["nodes"]
    assert 0.9 < report["connectivity"]["reachable_share"] <= 1.0
    assert set(report["responsiveness"]["changes"]) == {"stop to walk", "stop to jump", "walk to stop", "walk to jump"}
    turns = report["responsiveness"]["turns"]
    assert set(turns) == {f"walk {degrees}" for degrees in ("+45", "-45", "+90", "-90", "+135", "-135", "+180")}
    assert all(one["shortest_s"] <= one["mean_s"] + 1e-9 for one in turns.values())
    assert report["attribution"]


def test_ways_on_a_ring_are_known():
    graph = ring_graph(12)
    walking = StateMachine((State("on", ("walk",), ("on",), ("on",)),))
    notes = annotated(graph, walking, np.zeros(12, dtype=np.int16))
    table = solve_shadowing(graph, notes, 0, ShadowingTask(distance_bins=2, bearing_bins=4))
    report = inspect_bundle(Bundle(graph, {}, annotation=notes, shadowing=table))
    assert report["shadowing"]["states"] == 8
    assert report["bytes"]["table shadowing"] == 8 * 4
    assert report["states"] == [{"state": "on", "segments": 1, "nodes": 12, "mean_segment_s": pytest.approx(0.4)}]
    assert [(pair["pairs"], pair["mean_s"]) for pair in report["at_once"]] == [(1, 0.0)]
    connectivity, times = report["connectivity"], report["transition_time"]
    assert times["longest_s"] == pytest.approx(11 / 30)
    assert times["mean_s"] == pytest.approx(6 / 30)
    assert times["exact"]
    assert connectivity["edges_per_node"] == connectivity["reachable_share"] == 1.0
    assert connectivity["scc_fraction"] is None


def test_turning_takes_as_long_as_the_only_way_round():
    graph = ring_graph(12, np.radians(5.01))
    controller = SteeringController(graph, solve(graph, task_of(graph)))
    taken = turn_times(graph, controller, "walk", np.radians(90.0))
    # 15 steps of a little over 5 degrees come within 15 degrees of 90
    np.testing.assert_allclose(taken.seconds, 15 / 30)
    assert taken.share == 1.0


def test_what_never_happens_counts_as_the_patience_and_unanswered():
    graph = ring_graph(12)
    controller = SteeringController(graph, solve(graph, task_of(graph)))
    taken = change_times(graph, controller, "walk", "stop")
    np.testing.assert_allclose(taken.seconds, PATIENCE)
    assert taken.share == 0.0


def task_of(graph: MotionGraph) -> SteeringTask:
    return SteeringTask(behaviours=graph.behaviours)


def test_clips_are_described_each_and_all():
    clips = sample_clips(4, 60)
    report = inspect_clips(clips)
    json.dumps(report, allow_nan=False)
    assert report["frames"] == sum(one["frames"] for one in report["each"]) == 240
    assert report["labels"] == {"walk": 60, "idle": 60, "run": 60, "jump": 60}
    assert inspect_clips([])["frames"] == 0


def test_a_clip_comes_back_out_of_its_graph_as_it_went_in():
    clips = [wandering_clip(seed, 12) for seed in range(2)]
    graph = graph_of(clips, [(11, 12), (23, 0)])
    for before, after in zip(clips, clips_of_graph(graph), strict=True):
        between = [np.linalg.norm(p[:, :, None] - p[:, None], axis=-1) for p in both_places(before, after)]
        np.testing.assert_allclose(between[0], between[1], atol=1e-5)
        steps = [np.linalg.norm(np.diff(p, axis=0), axis=-1) for p in both_places(before, after)]
        np.testing.assert_allclose(steps[0], steps[1], atol=1e-5)


def both_places(before, after):
    return clip_places(before)[0], clip_places(after)[0]


def test_frames_between_two_are_no_part_of_a_clip():
    graph = graph_of([wandering_clip(seed, 12) for seed in range(2)], [(11, 12), (23, 0)])
    weight = np.where(np.arange(24) < 5, 0.75, 1.0)
    mixed = replace(graph, weight=weight, other_clip=np.where(weight < 1, 1, graph.clip))
    assert [clip.frame_count for clip in clips_of_graph(mixed)] == [7, 12]
    with pytest.raises(InputError, match="no node"):
        clip_of_graph(replace(mixed, weight=np.where(graph.clip == 0, 0.5, 1.0)), 0)


def test_a_clip_that_is_not_in_the_graph_is_refused():
    with pytest.raises(InputError, match="no node"):
        clip_of_graph(toy_bundle().graph, 7)


def test_steering_gives_a_clip_of_the_time_asked_for():
    clip = steered_clip(toy_bundle(), [(0.5, 0.0, "walk"), (1.0, 90.0, SHOWN[0])])
    assert clip.frame_count == 45
    with pytest.raises(InputError):
        steered_clip(toy_bundle(), [(1.0, 0.0, "run")])
    with pytest.raises(InputError):
        steered_clip(toy_bundle(), [])
