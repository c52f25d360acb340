import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from footwork.errors import InputError
from footwork.motion.alignment import align, turn
from footwork.motion.body import default_body
from footwork.motion.dynamics_metric import DynamicsMetric, align_pair_windows
from footwork.motion.kinematics import clip_places
from footwork.motion.metric import UNIT, PointCloudMetric
from footwork.motion.pair_weights import PairWeights, dynamics_weights
from footwork.motion.window import LENGTH, window_frames, window_weights
from motion_samples import sample_clip

LENGTHS = (40, 100, 7, 1, 30)
WEIGHTS = dynamics_weights(default_body())


def places(lengths=LENGTHS):
    return [clip_places(sample_clip(seed, frames))[0] for seed, frames in enumerate(lengths)]


def stepping(lengths=LENGTHS, seed=0):
    """Contacts that last some frames, of all four kinds."""
    rng = np.random.default_rng(seed)
    return [np.repeat(rng.random((length // 4 + 1, 2)) < 0.5, 4, axis=0)[:length] for length in lengths]


@pytest.fixture(scope="module")
def metric():
    return DynamicsMetric(places(), stepping(), WEIGHTS)


@pytest.fixture(scope="module")
def costs(metric):
    return metric.all_pairs()


def flat_costs(points, contacts, lengths, weights):
    """The flat form of conventions.md 1 for weights of each pair: all windows laid out, one product per quantity."""
    windows = window_frames(lengths)
    x, y, z = np.moveaxis(points[windows].reshape(len(windows), -1, 3), -1, 0)
    of_frames = window_weights()[:, None]
    g = (of_frames * weights.mass).ravel()
    a = (of_frames * weights.frictions(contacts[windows])).reshape(len(windows), -1)
    q = x * x + y * y + z * z
    omega = g.sum() + a.sum(axis=1)[:, None] + a.sum(axis=1)

    def one(values):
        return np.sum((g + a) * values, axis=1)[:, None] + values @ a.T

    def dot(u, v):
        return ((g + a) * u) @ v.T + u @ (a * v).T

    first_x, first_z = one(x), one(z)
    second_x, second_z = first_x.T, first_z.T
    real = dot(x, x) + dot(z, z) - (first_x * second_x + first_z * second_z) / omega
    imaginary = dot(x, z) - dot(z, x) - (first_x * second_z - first_z * second_x) / omega
    square = one(q) + one(q).T - 2.0 * dot(y, y)
    square -= (first_x**2 + first_z**2 + second_x**2 + second_z**2) / omega
    return np.maximum(square - 2.0 * np.hypot(real, imaginary), 0.0) / UNIT**2


def test_all_pairs_equal_the_flat_form(costs):
    points = np.concatenate(places())
    points = points - points.mean(axis=(0, 1))
    flat = flat_costs(points, np.concatenate(stepping()), LENGTHS, WEIGHTS)
    np.testing.assert_allclose(costs, flat, atol=1e-8)


def test_all_pairs_equal_the_flat_form_with_any_weights():
    rng = np.random.default_rng(8)
    mass = rng.random(21) * (rng.random(21) < 0.8)
    weights = PairWeights(mass / mass.sum(), rng.random((2, 21)) * (rng.random(21) < 0.4))
    points = np.concatenate(places())
    flat = flat_costs(points - points.mean(axis=(0, 1)), np.concatenate(stepping()), LENGTHS, weights)
    np.testing.assert_allclose(DynamicsMetric(places(), stepping(), weights).all_pairs(), flat, atol=1e-8)


def left_over(move, p, q, weights):
    x, z = turn(q[:, 0], q[:, 2], move[0])
    moved = np.stack([x + move[1], q[:, 1], z + move[2]], axis=-1)
    return np.sum(weights * np.sum((p - moved) ** 2, axis=-1))


def searched(p, q, weights):
    offset = np.average(p - q, axis=0, weights=weights)
    starts = [(theta, offset[0], offset[2]) for theta in (-2.4, -0.8, 0.8, 2.4)]
    return min(minimize(left_over, start, (p, q, weights), options={"gtol": 1e-10}).fun for start in starts)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), form=st.sampled_from(["uniform", "per point", "per pair"]))
def test_each_form_of_weights_equals_brute_force_on_random_windows(seed, form):
    rng = np.random.default_rng(seed)
    first, second = rng.normal(0.0, 0.5, (2, LENGTH, 6, 3)) + rng.normal(0.0, 3.0, (2, 1, 1, 3))
    standing = rng.random((2, LENGTH, 2)) < 0.5
    mass = np.full(6, 1 / 6) if form == "uniform" else rng.dirichlet(np.ones(6))
    friction = np.zeros((2, 6)) if form != "per pair" else rng.random((2, 6))
    weights = PairWeights(mass, friction)
    found = align_pair_windows(first, second, standing[0], standing[1], weights)
    flat = (window_weights()[:, None] * weights.of_pairs(*standing)).ravel()
    p, q = first.reshape(-1, 3), second.reshape(-1, 3)
    assert found.square == pytest.approx(searched(p, q, flat), abs=1e-6)
    assert left_over((found.theta, found.x0, found.z0), p, q, flat) == pytest.approx(found.square, abs=1e-9)
    metric = DynamicsMetric([first, second], list(standing), weights)
    middle = metric.all_pairs()[LENGTH // 2, LENGTH + LENGTH // 2]
    assert middle * UNIT**2 == pytest.approx(found.square, abs=1e-8)


def test_chosen_pairs_equal_all_pairs(metric, costs):
    i, j = np.random.default_rng(4).integers(0, metric.frame_count, (2, 3000))
    np.testing.assert_allclose(metric.pair_costs(i, j), costs[i, j], atol=1e-8)
    assert metric.pair_costs([], np.array([], int)).shape == (0,)


def test_costs_are_symmetric_and_zero_for_the_same_frame(costs):
    np.testing.assert_array_equal(costs, costs.T)
    np.testing.assert_allclose(np.diag(costs), 0.0, atol=1e-8)


def test_friction_only_adds_to_the_mass_part(costs):
    mass_part = PointCloudMetric(places(), WEIGHTS.mass).all_pairs()
    assert (costs >= mass_part - 1e-8).all()
    assert (costs > 1.5 * mass_part)[:40, 40:140].mean() > 0.3


def test_clips_that_stand_alike_throughout_have_fixed_weights():
    """What a frame of each class of contacts weighs, class by class, is the fixed-weight metric."""
    classes = [(False, False), (True, False), (False, True), (True, True)]
    clips = places((30, 25, 35, 20))
    held = [np.tile(feet, (len(clip), 1)) for feet, clip in zip(classes, clips, strict=True)]
    costs = DynamicsMetric(clips, held, WEIGHTS).all_pairs()
    ends = np.cumsum([len(clip) for clip in clips])
    for a in range(4):
        for b in range(a, 4):
            weights = WEIGHTS.of_pairs(classes[a], classes[b])
            fixed = PointCloudMetric([clips[a], clips[b]], weights).all_pairs() * weights.sum()
            block = costs[ends[a] - len(clips[a]) : ends[a], ends[b] - len(clips[b]) : ends[b]]
            np.testing.assert_allclose(block, fixed[: len(clips[a]), len(clips[a]) :], atol=1e-8)


def test_where_nothing_stands_the_mass_part_is_all():
    nothing = [np.zeros((length, 2), bool) for length in LENGTHS]
    costs = DynamicsMetric(places(), nothing, WEIGHTS).all_pairs()
    np.testing.assert_allclose(costs, PointCloudMetric(places(), WEIGHTS.mass).all_pairs(), atol=1e-8)


def test_each_frame_of_a_window_brings_its_own_friction():
    clips = [clip[:LENGTH] for clip in places((30, 30))]
    held = [np.zeros((LENGTH, 2), bool) for _ in clips]
    held[0][3, 0] = held[1][8, 1] = True
    cost = DynamicsMetric(clips, held, WEIGHTS).all_pairs()[LENGTH // 2, LENGTH + LENGTH // 2]
    weights = np.tile(WEIGHTS.mass, (LENGTH, 1))
    weights[3] += WEIGHTS.friction[0]
    weights[8] += WEIGHTS.friction[1]
    flat = (window_weights()[:, None] * weights).ravel()
    expected = align(clips[0].reshape(-1, 3), clips[1].reshape(-1, 3), flat).square / UNIT**2
    assert cost == pytest.approx(expected, abs=1e-9)


def test_moving_a_clip_on_the_ground_changes_nothing(costs):
    clips = places()
    x, z = turn(clips[1][..., 0], clips[1][..., 2], 2.2)
    clips[1] = np.stack([x + 40.0, clips[1][..., 1], z - 25.0], axis=-1)
    np.testing.assert_allclose(DynamicsMetric(clips, stepping(), WEIGHTS).all_pairs(), costs, atol=1e-8)


def test_a_lift_costs_by_what_is_lifted_and_stands():
    clip = places((30,))[0]
    costs = []
    for held in ((False, False), (True, False), (True, True)):
        feet = [np.tile(held, (30, 1))] * 2
        lifted = DynamicsMetric([clip, clip + np.array([0.0, UNIT, 0.0])], feet, WEIGHTS).all_pairs()
        costs.append(lifted[10, 40])
    a_leg = WEIGHTS.friction[0].sum()
    assert costs == pytest.approx([1.0, 1.0 + 2.0 * a_leg, 1.0 + 4.0 * a_leg])


def test_the_alignment_moves_one_window_onto_the_other():
    clip, held = places((40,))[0], stepping((40,))[0]
    x, z = turn(clip[..., 0], clip[..., 2], -1.1)
    moved = np.stack([x + 2.0, clip[..., 1], z + 3.0], axis=-1)
    found = DynamicsMetric([moved, clip], [held, held], WEIGHTS).align(12, 40 + 12)
    np.testing.assert_allclose([found.theta, found.x0, found.z0], [[-1.1], [2.0], [3.0]], atol=1e-9)


@pytest.mark.parametrize(
    ("clips", "held", "says"),
    [
        ([], [], "no clips"),
        ([np.zeros((4, 20, 3))], [np.zeros((4, 2))], "20 points, expected 21"),
        ([np.zeros((4, 21, 3))], [], "contacts of 0 clips, expected 1"),
        ([np.zeros((4, 21, 3))], [np.zeros((3, 2))], "contacts of clip 0 has shape"),
        ([np.zeros((4, 21, 3))], [np.zeros((4, 1))], "contacts of clip 0 has shape"),
        ([np.full((4, 21, 3), np.inf)], [np.zeros((4, 2))], "is inf"),
    ],
)
def test_what_cannot_be_compared_is_refused(clips, held, says):
    with pytest.raises(InputError, match=says):
        DynamicsMetric(clips, held, WEIGHTS)


def test_windows_that_do_not_fit_are_refused():
    windows, held = np.zeros((2, 3, LENGTH, 21, 3)), np.zeros((3, LENGTH, 2))
    with pytest.raises(InputError, match="second contacts has shape"):
        align_pair_windows(windows[0], windows[1], held, held[:, :4], WEIGHTS)
