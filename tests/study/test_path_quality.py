import json
from dataclasses import replace

import numpy as np
import pytest

from footwork.motion.kinematics import clip_places
from footwork.motion.metric import PointCloudMetric
from footwork.study.foot_slide import slide_of_clip
from footwork.study.graph_paths import best_path_through, natural_path, path_clip
from footwork.study.path_quality import path_quality, pose_jumps, slide_by_step, windowed_costs
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import local_minima
from motion_samples import sample_clips
from toy_graphs import BEHAVIOURS, edge_between, graph_of, homogeneous, planar_places, wandering_clip


@pytest.fixture(scope="module")
def walked():
    """Sample clips that stand with both feet, their metric and the standard graph over them."""
    clips = [replace(clip, contacts=np.ones((clip.frame_count, 2))) for clip in sample_clips(3, 70)]
    metric, nodes = PointCloudMetric.of_clips(clips), nodes_of(clips, BEHAVIOURS)
    return clips, metric, standard_graph(nodes, metric, local_minima(metric.all_pairs(), nodes.lengths, 3.0), 1.0)


def test_costs_computed_anew_from_the_graph_are_those_it_holds(walked):
    clips, _, graph = walked
    jumps = np.flatnonzero(~graph.natural)
    again = windowed_costs(graph, jumps)
    known = np.isfinite(again)
    inside = (graph.frame >= 5) & (graph.frame < clips[0].frame_count - 5)
    np.testing.assert_array_equal(known, inside[graph.source[jumps]] & inside[graph.target[jumps] - 1])
    assert known.sum() > 20
    np.testing.assert_allclose(again[known], graph.cost[jumps][known], rtol=1e-4, atol=1e-5)


def test_natural_edges_do_not_jump(walked):
    graph = walked[2]
    assert pose_jumps(graph, np.flatnonzero(graph.natural)).max() < 1e-5
    assert pose_jumps(graph, np.flatnonzero(~graph.natural)).mean() > 2e-3


def test_a_transition_jumps_as_far_as_the_two_similar_poses_are_apart():
    clips = [wandering_clip(seed, 10) for seed in range(2)]
    graph = graph_of(clips, [(4, 13)])
    own = []
    for clip, frame in ((clips[0], 4), (clips[1], 3)):
        level = np.linalg.inv(homogeneous(planar_places(clip)[frame]))
        own.append(clip_places(clip)[0][frame] @ level[:3, :3].T + level[:3, 3])
    expected = np.sqrt(np.mean(np.sum((own[0] - own[1]) ** 2, axis=-1)))
    assert pose_jumps(graph, np.array([edge_between(graph, 4, 14)]))[0] == pytest.approx(expected, rel=1e-4)


def test_a_path_is_judged_by_its_transitions_and_its_feet(walked):
    clips, _, graph = walked
    jump = int(np.flatnonzero(~graph.natural & (graph.clip[graph.source] != graph.clip[graph.target]))[0])
    path = np.concatenate([best_path_through(graph, [0, int(graph.source[jump])]), [jump]])
    found = path_quality(graph, path)
    json.dumps(found, allow_nan=False)
    taken = path[~graph.natural[path]]
    assert found["transitions"] == len(taken)
    assert found["transition_s"] == {
        "worst": pytest.approx(graph.cost[taken].max()),
        "mean": pytest.approx(graph.cost[taken].mean()),
    }
    assert found["transition_cm"]["worst"] == pytest.approx(5.644 * np.sqrt(graph.cost[taken].max()))
    slides = [slide_of_clip(clips[index]) for index in np.unique(graph.clip[graph.target[path]])]
    source = sum(slide.metres for slide in slides) / sum(slide.seconds for slide in slides)
    assert found["source_foot_slide_cm_s"] == pytest.approx(100 * source, rel=1e-4)


def test_slide_is_told_apart_by_the_kind_of_step(walked):
    graph = walked[2]
    mixed = replace(graph, weight=np.where((graph.clip == 0) & (graph.frame < 10), 0.5, 1.0))
    jump = int(np.flatnonzero(~graph.natural & (graph.source > 20) & (graph.clip[graph.source] == 0))[0])
    path = np.concatenate([natural_path(graph, 0, int(graph.source[jump])), [jump]])
    parts = slide_by_step(mixed, path)
    steps = {"captured": graph.source[jump] - 10, "interpolated": 10, "transitions": 1}
    assert {name: part.seconds for name, part in parts.items()} == {
        name: pytest.approx(2 * count / 30) for name, count in steps.items()
    }
    whole = slide_of_clip(path_clip(graph, path))
    assert sum(part.metres for part in parts.values()) == pytest.approx(whole.metres)
    assert path_quality(mixed, path)["foot_slide_cm_s"] == pytest.approx(whole.cm_per_second)


def test_a_path_without_transitions_slides_as_its_clip_does(walked):
    clips, _, graph = walked
    found = path_quality(graph, np.flatnonzero(graph.natural & (graph.clip[graph.source] == 0)))
    assert found["transition_s"] is found["pose_jump_cm"] is None
    assert found["foot_slide_cm_s"] == pytest.approx(slide_of_clip(clips[0]).cm_per_second, rel=1e-4)
