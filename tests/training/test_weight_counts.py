"""How many motions lie between two segments."""

from dataclasses import replace

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.metric import UNIT
from footwork.training.chain_plan import plan_of
from footwork.training.segments import segments_of
from footwork.training.source_tracks import tracks_of
from footwork.training.weight_counts import needed_weights, pair_distances, weights_of_pairs
from motion_samples import sample_clip


def test_weights_divide_the_way_evenly():
    levels = weights_of_pairs(np.array([1, 0, 3]))
    np.testing.assert_allclose(levels, [0.5, 0.25, 0.5, 0.75])


@pytest.mark.parametrize(("apart", "count"), [(0.0, 0), (0.9, 0), (1.0, 0), (1.1, 1), (3.5, 3), (50.0, 9)])
def test_each_hop_is_as_long_as_the_threshold_lets_it_be(apart, count):
    threshold = 0.2
    reach = UNIT * np.sqrt(threshold)
    assert needed_weights(np.array([apart * reach]), threshold, 9).tolist() == [count]
    if 0 < count < 9:
        assert apart / (count + 1) <= 1.0 < apart / count


def test_the_distance_is_that_of_the_joints_after_the_alignment():
    clip, turned = sample_clip(0, 40), quaternion.from_yaw(1.3)
    rotations = clip.rotations.copy()
    rotations[:, 0] = quaternion.multiply(turned, rotations[:, 0])
    root = quaternion.rotate(turned, clip.root_position) + np.array([2.0, 0.0, -1.0])
    there = replace(clip, root_position=root, rotations=rotations)
    lifted = replace(there, root_position=root + np.array([0.0, 0.07, 0.0]))
    clips = [clip, there, lifted]
    segments, tracks = segments_of(clips), tracks_of(clips)
    whole = np.flatnonzero(segments.start == 0)
    pairs = np.array([[whole[0], whole[1]], [whole[0], whole[2]]])
    move = plan_of(segments, tracks, pairs, np.full(2, 0.5)).move
    np.testing.assert_allclose(pair_distances(segments, tracks, pairs, move), [0.0, 0.07], atol=1e-9)
