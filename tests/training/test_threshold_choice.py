"""Builds whose threshold or metric is not the usual one."""

from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.metric import PointCloudMetric
from footwork.motion.metric_names import NAMES
from footwork.training import threshold_choice
from footwork.training.build import build_bundle
from footwork.training.graph_options import USUAL_THRESHOLD, GraphOptions
from footwork.training.knee import threshold_at_knee
from footwork.training.stages import Stages
from footwork.training.threshold_choice import chosen
from footwork.training.transitions import local_minima
from motion_samples import SampleMotions, sample_clip, sample_clips, stepping


@pytest.fixture(scope="module")
def motions() -> SampleMotions:
    clips = [sample_clip(seed, 90, speed=1.0 + 0.13 * seed, turn=0.5 - 0.3 * seed) for seed in range(4)]
    return SampleMotions([stepping(clip, 15) for clip in clips])


def test_an_automatic_threshold_is_that_of_the_knee(motions):
    bundle, report = build_bundle(motions, GraphOptions(threshold="auto"))
    lengths = [90] * 4
    knee = threshold_at_knee(local_minima(PointCloudMetric.of_clips(motions.clips).all_pairs(), lengths), lengths)
    assert report["threshold"] == bundle.provenance["options"]["threshold"] == knee.threshold
    assert report["knee"] == bundle.provenance["knee"]
    assert report["knee"]["rank"] == knee.rank
    jumps = ~bundle.graph.natural
    assert bundle.graph.cost[jumps].max() < knee.threshold


@pytest.mark.parametrize(("times", "above"), [(1.0, False), (30.0, True)])
def test_without_a_threshold_an_annotated_graph_takes_the_knee_where_it_is_high(motions, monkeypatch, times, above):
    real = threshold_choice.threshold_at_knee

    def scaled(minima, lengths):
        knee = real(minima, lengths)
        return replace(knee, threshold=times * knee.threshold)

    monkeypatch.setattr(threshold_choice, "threshold_at_knee", scaled)
    options, told = chosen(motions.clips, GraphOptions(graph="annotated"), Stages())
    assert (options.number > USUAL_THRESHOLD) == ("knee" in told) == above
    assert options.number >= USUAL_THRESHOLD


def test_without_a_knee_it_takes_the_usual_one():
    clips = sample_clips(2, 60)
    assert chosen(clips, GraphOptions(graph="annotated"), Stages()) == (
        GraphOptions(graph="annotated", threshold=USUAL_THRESHOLD),
        {},
    )
    with pytest.raises(InputError, match="no knee to choose it by"):
        chosen(clips, GraphOptions(graph="annotated", threshold="auto"), Stages())


@pytest.mark.parametrize("metric", NAMES)
def test_smoothness_is_judged_by_the_uniform_metric_whichever_built_the_graph(motions, metric):
    bundle, _ = build_bundle(motions, GraphOptions(threshold=3.0, metric=metric))
    assert bundle.provenance["options"]["metric"] == metric
    graph = bundle.graph
    uniform = _uniform_costs(motions.clips, graph)
    np.testing.assert_allclose(graph.smoothness[~graph.natural], np.exp(-uniform), rtol=1e-5)
    assert np.allclose(graph.cost[~graph.natural], uniform, rtol=1e-5) == (metric == "uniform")


def _uniform_costs(clips: list[Clip], graph: MotionGraph) -> np.ndarray:
    jumps = np.flatnonzero(~graph.natural)
    here, there = graph.source[jumps], graph.target[jumps]
    start = np.cumsum([0] + [clip.frame_count for clip in clips])
    i, j = start[graph.clip[here]] + graph.frame[here], start[graph.clip[there]] + graph.frame[there] - 1
    return PointCloudMetric.of_clips(clips).pair_costs(i, j)
