"""The standard graph on dataset3's core ranges, beside the figures of a rough trial on the same frames."""

import numpy as np
import pytest
from scipy.optimize import minimize

from footwork.motion.alignment import turn
from footwork.motion.kinematics import clip_places
from footwork.motion.metric import UNIT, PointCloudMetric
from footwork.motion.window import window_frames, window_weights
from footwork.training.connectivity import connecting_threshold, largest_component
from footwork.training.dataset import load_clips
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import edges_of
from footwork.training.transitions import local_minima
from shared_data import MOTIONS, needs_motions

pytestmark = needs_motions


@pytest.fixture(scope="module")
def clips():
    tables = {"labels": MOTIONS / "labels.csv", "ranges": MOTIONS / "core_ranges.csv"}
    return load_clips(MOTIONS / "dataset3", labels=tables["labels"], ranges=tables["ranges"]).clips


@pytest.fixture(scope="module")
def costs(clips):
    return PointCloudMetric.of_clips(clips).all_pairs()


def test_captured_frames_cost_what_brute_force_finds(clips, costs):
    points = np.concatenate([clip_places(clip)[0] for clip in clips])
    windows = window_frames([clip.frame_count for clip in clips])
    weights = window_weights()[:, None] / points.shape[1]

    def left_over(move, p, q):
        x, z = turn(q[..., 0], q[..., 2], move[0])
        moved = np.stack([x + move[1], q[..., 1], z + move[2]], axis=-1)
        return np.sum(weights * np.sum((p - moved) ** 2, axis=-1)) / UNIT**2

    for i, j in np.random.default_rng(0).integers(0, len(points), (8, 2)):
        p, q = points[windows[i]], points[windows[j]]
        q = q - q.mean(axis=(0, 1)) * [1, 0, 1]
        p = p - p.mean(axis=(0, 1)) * [1, 0, 1]
        starts = [(theta, 0.0, 0.0) for theta in (-2.4, -0.8, 0.8, 2.4)]
        found = min(minimize(left_over, start, (p, q), options={"gtol": 1e-9}).fun for start in starts)
        assert costs[i, j] == pytest.approx(found, abs=1e-6)


# 0.2 is above the trial's 0.47. These files' own joints give 0.57 here with the floor as captured, which slopes by
# 0.9 %, and 0.65 with it level; with all eight neighbours required at the ends of clips they give the trial's 0.46.
# Above 0.5 neither matters much.
@pytest.mark.parametrize(("threshold", "share"), [(0.2, 0.65), (1.0, 0.77), (5.0, 0.94), (10.0, 0.97)])
def test_the_connected_share_is_near_the_trials(clips, costs, threshold, share):
    nodes = nodes_of(clips, ("stop", "walk", "run", "jump"))
    edges = edges_of(nodes.ends, local_minima(costs, nodes.lengths, threshold))
    connected = largest_component(len(costs), edges.source, edges.target).size / len(costs)
    assert len(costs) == 2721
    assert connected == pytest.approx(share, abs=0.05)


def test_half_of_the_frames_are_connected_by_a_threshold_below_the_papers(clips, costs):
    nodes = nodes_of(clips, ("stop", "walk", "run", "jump"))
    needed = connecting_threshold(nodes.ends, local_minima(costs, nodes.lengths))
    assert needed is not None
    assert 0.05 < needed < 0.6


def test_running_is_out_of_reach_at_the_papers_threshold_for_its_motion_and_not_for_its_height(clips, costs):
    nodes = nodes_of(clips, ("stop", "walk", "run", "jump"))
    running = np.concatenate([clip.labels for clip in clips]) == "run"
    heights = np.concatenate([clip_places(clip)[0][..., 1] for clip in clips]).mean(axis=1)
    held = {}
    for threshold in (1.0, 1.7, 3.0):
        edges = edges_of(nodes.ends, local_minima(costs, nodes.lengths, threshold))
        held[threshold] = running[largest_component(len(costs), edges.source, edges.target)].sum()
    assert held[1.0] == 0
    assert held[1.7] > 0.3 * running.sum()
    assert held[3.0] > 0.7 * running.sum()
    owner = np.repeat(np.arange(len(clips)), nodes.lengths)
    between = np.where(running[:, None] & running & (owner[:, None] != owner), costs, np.inf)
    nearest = between.argmin(axis=1)[running]
    assert abs(np.median(heights[running] - heights[nearest])) < 0.01
