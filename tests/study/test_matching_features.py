import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.kinematics import clip_places, facing_yaw
from footwork.study.motion_matching.chains import chains_of, graph_of_all_frames
from footwork.study.motion_matching.features import GROUPS, Weights, normalised, raw_features
from motion_samples import ring_graph
from toy_graphs import graph_of, wandering_clip

CLIPS = [wandering_clip(1, 50), wandering_clip(2, 1), wandering_clip(3, 37)]
GRAPH = graph_of_all_frames(CLIPS)
CHAINS = chains_of(GRAPH)
RAW = raw_features(GRAPH, CHAINS)


def seen_from(yaw, vector):
    """A vector of the world turned into a frame that faces ``yaw``."""
    x, y, z = vector
    return [x * np.cos(yaw) - z * np.sin(yaw), y, z * np.cos(yaw) + x * np.sin(yaw)]


def plain_features(clip, frame):
    """The 27 numbers of one frame, straight from the clip's own world."""
    places, yaws = clip_places(clip)[0], facing_yaw(clip.skeleton, clip_places(clip)[0])
    root, yaw, last = clip.root_position, yaws[frame], clip.frame_count - 1
    ground = root[frame] * [1.0, 0.0, 1.0]
    before, after = max(frame - 1, 0), min(frame + 1, last)
    seconds = max(after - before, 1) / 30.0
    feet = [places[:, clip.skeleton.index(f"{side}_foot")] for side in ("left", "right")]
    found = [seen_from(yaw, foot[frame] - ground) for foot in feet]
    found += [seen_from(yaw, (point[after] - point[before]) / seconds) for point in (*feet, root)]
    ahead = [min(frame + ticks, last) for ticks in (10, 20, 30)]
    found += [np.delete(seen_from(yaw, root[there] - root[frame]), 1) for there in ahead]
    found += [[np.sin(yaws[there] - yaw), np.cos(yaws[there] - yaw)] for there in ahead]
    return np.concatenate(found)


def test_features_are_those_of_a_plain_computation_in_the_clips_own_world():
    plain = [plain_features(clip, frame) for clip in CLIPS for frame in range(clip.frame_count)]
    np.testing.assert_allclose(RAW, plain, atol=2e-5)


def test_every_group_has_mean_zero_and_its_weight_as_mean_deviation():
    weights = Weights(0.5, 1.0, 2.0, 3.0, 4.0)
    features = normalised(RAW, weights)
    np.testing.assert_allclose(features.values.mean(axis=0), 0.0, atol=1e-5)
    for name, group in GROUPS.items():
        assert features.values[:, group].std(axis=0).mean() == pytest.approx(getattr(weights, name), rel=1e-5)
    np.testing.assert_allclose(features.values * features.scale + features.offset, RAW, atol=1e-5)


def test_a_feature_that_never_changes_counts_nothing():
    assert np.isfinite(normalised(np.ones((4, 27)), Weights()).values).all()


def test_chains_are_the_clips():
    lengths = [clip.frame_count for clip in CLIPS]
    ends = np.cumsum(lengths) - 1
    np.testing.assert_array_equal(CHAINS.last, np.repeat(ends, lengths))
    np.testing.assert_array_equal(CHAINS.first, np.repeat(ends + 1 - lengths, lengths))
    np.testing.assert_array_equal(np.flatnonzero(CHAINS.edge < 0), ends)


def test_transitions_of_a_graph_are_no_part_of_its_chains():
    graph = graph_of([CLIPS[0], CLIPS[2]], [(10, 60), (70, 3)])
    np.testing.assert_array_equal(chains_of(graph).last, np.repeat([49, 86], [50, 37]))


def test_mirror_images_come_along():
    graph = graph_of_all_frames(CLIPS, mirror=True)
    assert graph.node_count == 2 * GRAPH.node_count
    mirrored = raw_features(graph, chains_of(graph))[GRAPH.node_count :]
    left, right = mirrored[:, 0:3], RAW[:, 3:6]
    np.testing.assert_allclose(left, right * [-1.0, 1.0, 1.0], atol=2e-5)


def test_natural_edges_that_lead_elsewhere_are_refused():
    with pytest.raises(InputError, match="a natural edge from node 11 to 0, expected natural edges to the next node"):
        chains_of(ring_graph(12))
