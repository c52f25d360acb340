import numpy as np
import pytest
from scipy.optimize import minimize

from footwork.errors import InputError
from footwork.motion.alignment import turn
from footwork.motion.kinematics import clip_places
from footwork.motion.metric import UNIT, PointCloudMetric, align_windows
from footwork.motion.window import LENGTH, window_frames, window_weights
from motion_samples import sample_clip

LENGTHS = (40, 150, 7, 1, 30)


def places(lengths=LENGTHS):
    return [clip_places(sample_clip(seed, frames))[0] for seed, frames in enumerate(lengths)]


@pytest.fixture(scope="module")
def metric():
    return PointCloudMetric(places())


@pytest.fixture(scope="module")
def costs(metric):
    return metric.all_pairs()


def numpy_costs(points, windows, joint_weights):
    """The flat form of conventions.md 1: windows centred one by one, five products of their full depth."""
    weights = (window_weights()[:, None] * joint_weights).ravel()
    x, y, z = np.moveaxis(points[windows].reshape(len(windows), -1, 3), -1, 0)
    x, z = x - (x @ weights)[:, None], z - (z @ weights)[:, None]
    energy = (x**2 + y**2 + z**2) @ weights
    real = (x * weights) @ x.T + (z * weights) @ z.T
    imaginary = (x * weights) @ z.T - (z * weights) @ x.T
    square = energy[:, None] + energy - 2.0 * (y * weights) @ y.T - 2.0 * np.hypot(real, imaginary)
    return np.maximum(square, 0.0) / UNIT**2


def test_all_pairs_equal_the_flat_form(costs):
    points = np.concatenate(places())
    flat = numpy_costs(points, window_frames(LENGTHS), np.full(21, 1 / 21))
    np.testing.assert_allclose(costs, flat, atol=1e-9)


def test_all_pairs_equal_the_flat_form_with_weights_of_joints():
    weights = np.random.default_rng(0).random(21)
    weights[3] = 0.0
    costs = PointCloudMetric(places(), weights).all_pairs()
    flat = numpy_costs(np.concatenate(places()), window_frames(LENGTHS), weights / weights.sum())
    np.testing.assert_allclose(costs, flat, atol=1e-9)


def test_all_pairs_equal_brute_force_minimisation(costs):
    points, windows = np.concatenate(places()), window_frames(LENGTHS)
    weights = window_weights()[:, None] / 21

    def left_over(move, p, q):
        x, z = turn(q[..., 0], q[..., 2], move[0])
        moved = np.stack([x + move[1], q[..., 1], z + move[2]], axis=-1)
        return np.sum(weights * np.sum((p - moved) ** 2, axis=-1)) / UNIT**2

    for i, j in np.random.default_rng(3).integers(0, len(points), (12, 2)):
        p, q = points[windows[i]], points[windows[j]]
        offset = (p - q).mean(axis=(0, 1))
        starts = [(theta, offset[0], offset[2]) for theta in (-2.4, -0.8, 0.8, 2.4)]
        found = min(minimize(left_over, start, (p, q), options={"gtol": 1e-9}).fun for start in starts)
        assert costs[i, j] == pytest.approx(found, abs=1e-6)


def test_chosen_pairs_equal_all_pairs(metric, costs):
    i, j = np.random.default_rng(4).integers(0, metric.frame_count, (2, 5000))
    np.testing.assert_allclose(metric.pair_costs(i, j), costs[i, j], atol=1e-9)
    assert metric.pair_costs([], np.array([], int)).shape == (0,)


def test_costs_are_symmetric_and_zero_for_the_same_frame(costs):
    np.testing.assert_array_equal(costs, costs.T)
    np.testing.assert_allclose(np.diag(costs), 0.0, atol=1e-9)


def test_moving_a_clip_on_the_ground_changes_nothing(costs):
    clips = places()
    x, z = turn(clips[1][..., 0], clips[1][..., 2], 2.2)
    clips[1] = np.stack([x + 40.0, clips[1][..., 1], z - 25.0], axis=-1)
    np.testing.assert_allclose(PointCloudMetric(clips).all_pairs(), costs, atol=1e-9)


def test_lifting_a_clip_costs_the_height_squared():
    clip = places((30,))[0]
    lifted = PointCloudMetric([clip, clip + np.array([0.0, 0.1, 0.0])]).all_pairs()
    np.testing.assert_allclose(np.diag(lifted[:30, 30:]), (0.1 / UNIT) ** 2, atol=1e-9)


def test_a_cost_of_one_is_5_644_cm():
    clip = places((30,))[0]
    lifted = PointCloudMetric([clip, clip + np.array([0.0, 0.05644, 0.0])]).all_pairs()
    np.testing.assert_allclose(np.diag(lifted[:30, 30:]), 1.0, atol=1e-9)


def test_the_alignment_moves_one_window_onto_the_other(metric):
    clip = places((40,))[0]
    x, z = turn(clip[..., 0], clip[..., 2], -1.1)
    both = PointCloudMetric([np.stack([x + 2.0, clip[..., 1], z + 3.0], axis=-1), clip])
    found = both.align(12, 40 + 12)
    np.testing.assert_allclose([found.theta, found.x0, found.z0], [[-1.1], [2.0], [3.0]], atol=1e-9)


def test_windows_as_arrays_give_the_same_costs(metric, costs):
    points, windows = np.concatenate(places()), window_frames(LENGTHS)
    found = align_windows(points[windows[[3, 50, 190]]], points[windows[[60, 199, 9]]])
    np.testing.assert_allclose(found.square / UNIT**2, costs[[3, 50, 190], [60, 199, 9]], atol=1e-9)
    with pytest.raises(InputError, match=f"expected \\(any, {LENGTH}, 21, 3\\)"):
        align_windows(points[None, :4], points[None, :4])


def test_points_on_one_upright_line_cost_their_heights_alone():
    rng = np.random.default_rng(5)
    heights = rng.random((2, 20, 4))
    columns = [np.stack([np.full_like(h, 7.0), h, np.full_like(h, -2.0)], axis=-1) for h in heights]
    metric = PointCloudMetric(columns)
    costs = metric.all_pairs()
    assert metric.align(5, 25).theta[0] == 0.0
    weights = window_weights()[:, None] / 4
    expected = np.sum(weights * (heights[0, 5:16] - heights[1, 5:16]) ** 2) / UNIT**2
    assert costs[10, 30] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("clips", "weights", "says"),
    [
        ([], None, "no clips"),
        ([np.zeros((0, 21, 3))], None, "empty"),
        ([np.zeros((4, 21, 3)), np.zeros((4, 20, 3))], None, "clip 1 has shape"),
        ([np.full((4, 21, 3), np.nan)], None, "is nan"),
        ([np.zeros((4, 21, 3))], np.zeros(21), "not all zero"),
        ([np.zeros((4, 21, 3))], -np.ones(21), "zero or more"),
        ([np.zeros((4, 21, 3))], np.ones(20), "shape"),
    ],
)
def test_what_cannot_be_compared_is_refused(clips, weights, says):
    with pytest.raises(InputError, match=says):
        PointCloudMetric(clips, weights)
