"""The measures on real capture: the standard graph over a walker of many step lengths."""

import numpy as np
import pytest

from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import BEHAVIOURS
from footwork.study.closure import closure_share
from footwork.study.foot_slide import slide_of_capture, slide_of_clip
from footwork.study.graph_paths import best_path_through
from footwork.study.path_quality import path_quality, windowed_costs
from footwork.study.transition_times import transition_times
from footwork.training.dataset import load_clips
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import local_minima
from shared_data import MOTIONS, needs_motions

pytestmark = needs_motions
THRESHOLDS = (0.4, 1.0, 2.0, 6.0)


@pytest.fixture(scope="module")
def walker():
    """Its clips, and its graph at each threshold."""
    clips = load_clips(MOTIONS / "dataset1", labels=MOTIONS / "labels.csv", ranges=MOTIONS / "core_ranges.csv").clips
    metric, nodes = PointCloudMetric.of_clips(clips), nodes_of(clips, BEHAVIOURS)
    costs = metric.all_pairs()
    graphs = [standard_graph(nodes, metric, local_minima(costs, nodes.lengths, at), 1.0) for at in THRESHOLDS]
    return clips, dict(zip(THRESHOLDS, graphs, strict=True))


def test_costs_and_slide_out_of_the_graph_are_those_of_the_clips(walker):
    clips, graphs = walker
    jumps = np.flatnonzero(~graphs[2.0].natural)
    again = windowed_costs(graphs[2.0], jumps)
    known = np.isfinite(again)
    assert known.sum() > 50
    np.testing.assert_allclose(again[known], graphs[2.0].cost[jumps][known], atol=1e-4)
    slides = [slide_of_clip(clip) for clip in clips]
    expected = 100 * sum(slide.metres for slide in slides) / sum(slide.seconds for slide in slides)
    assert slide_of_capture(graphs[2.0]).cm_per_second == pytest.approx(expected, rel=1e-4)


def test_more_can_be_reached_and_sooner_at_higher_thresholds(walker):
    graphs = walker[1].values()
    frames = np.arange(next(iter(graphs)).node_count)
    shares = [closure_share(graph.edge_start, graph.target, frames) for graph in graphs]
    assert shares == sorted(shares)
    assert shares[0] < 0.5 < shares[-1]
    times = [transition_times(graph.edge_start, graph.target, frames) for graph in graphs]
    assert [one.reachable_share for one in times] == pytest.approx(shares)
    assert (times[-1].mean or np.inf) < (times[1].mean or 0.0)


def test_a_path_from_short_to_long_steps_stays_under_the_threshold(walker):
    graph = walker[1][2.0]
    short, long = (
        np.flatnonzero(graph.clip == graph.clips.index(name))
        for name in graph.clips
        if name.startswith(("07_02", "07_11"))
    )
    found = path_quality(graph, best_path_through(graph, [short[8], long[20:40]]))
    assert 0.0 < found["transition_s"]["worst"] < 2.0
    assert 0.1 < found["seconds"] < 5.0
