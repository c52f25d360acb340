from dataclasses import replace

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.metric import UNIT, PointCloudMetric
from footwork.motion.metrics import NAMES, fixed_cloud, metric_of
from motion_samples import sample_clip, sample_clips
from shared_data import MOTIONS, needs_motions


@pytest.fixture(scope="module")
def clips():
    """Sample clips that stand on the left, on both, on the right and on no foot by turns."""
    foot = np.arange(120) // 8 % 4
    contacts = np.stack([foot <= 1, (foot == 1) | (foot == 2)], axis=-1)
    return [replace(clip, contacts=contacts) for clip in sample_clips(3)]


@pytest.fixture(scope="module")
def capture():
    from footwork.training.dataset import load_clips

    return load_clips(MOTIONS / "dataset2", ranges=MOTIONS / "core_ranges.csv").clips


def test_uniform_is_the_metric_of_all_joints_alike(clips):
    np.testing.assert_array_equal(metric_of("uniform", clips).all_pairs(), PointCloudMetric.of_clips(clips).all_pairs())


@pytest.mark.parametrize("name", NAMES)
def test_every_metric_agrees_with_itself(name, clips):
    metric = metric_of(name, clips)
    costs = metric.all_pairs()
    assert metric.frame_count == 360
    np.testing.assert_array_equal(costs, costs.T)
    np.testing.assert_allclose(np.diag(costs), 0.0, atol=1e-8)
    i, j = np.random.default_rng(1).integers(0, 360, (2, 500))
    np.testing.assert_allclose(metric.pair_costs(i, j), costs[i, j], atol=1e-8)
    np.testing.assert_allclose(metric.align(i, j).square / UNIT**2, costs[i, j], atol=1e-8)


@pytest.mark.parametrize("name", NAMES)
def test_a_lifted_clip_in_the_air_costs_the_height_squared_under_every_metric(name):
    clip = sample_clip()
    lifted = replace(clip, root_position=clip.root_position + np.array([0.0, 0.1, 0.0]))
    costs = metric_of(name, [clip, lifted]).all_pairs()
    np.testing.assert_allclose(np.diag(costs[:120, 120:]), (0.1 / UNIT) ** 2, atol=1e-8)


def test_windows_longer_than_clips_hold_their_ends(clips):
    short = [clip.cut(10, 14) for clip in clips]
    for name in NAMES:
        assert np.isfinite(metric_of(name, short).all_pairs()).all()


@needs_motions
@pytest.mark.parametrize("name", NAMES)
def test_on_capture_costs_are_finite_and_zero_for_the_same_frame(name, capture):
    costs = metric_of(name, capture).all_pairs()
    assert costs.shape == (264, 264)
    assert np.isfinite(costs).all()
    np.testing.assert_allclose(np.diag(costs), 0.0, atol=1e-8)
    assert 1.0 < np.median(costs) < 100.0  # thresholds of all metrics are of one scale


@needs_motions
def test_on_capture_friction_only_adds_to_the_mass_part(capture):
    dynamics = metric_of("dynamics", capture)
    cloud = fixed_cloud("dynamics", capture[0].skeleton)
    from footwork.motion.kinematics import clip_places

    mass_part = PointCloudMetric([cloud.points(clip_places(clip)[0]) for clip in capture], cloud.weights).all_pairs()
    assert (dynamics.all_pairs() >= mass_part - 1e-8).all()


def test_an_unknown_metric_is_named_with_those_there_are(clips):
    with pytest.raises(InputError, match="'dynamic', expected one of uniform, dynamics, torso, joints"):
        metric_of("dynamic", clips)
    with pytest.raises(InputError, match="no metric"):
        fixed_cloud("", clips[0].skeleton)


def test_bodies_must_be_one_and_have_what_the_metric_needs(clips):
    with pytest.raises(InputError, match="no clips"):
        metric_of("uniform", [])
    weightless = replace(clips[0].skeleton, masses=np.zeros(21))
    light = [replace(clip, skeleton=weightless) for clip in clips]
    with pytest.raises(InputError, match="no masses"):
        metric_of("dynamics", light)
    assert metric_of("uniform", light).frame_count == 360
    with pytest.raises(InputError, match="another body than that of sample0"):
        metric_of("dynamics", [clips[0], light[1]])
    renamed = replace(clips[0].skeleton, names=tuple(f"j{number}" for number in range(21)))
    with pytest.raises(InputError, match=r"joints\.toml: no joint 'thigh'"):
        metric_of("joints", [replace(clip, skeleton=renamed) for clip in clips])
