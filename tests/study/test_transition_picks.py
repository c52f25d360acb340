import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.alignment import turn
from footwork.motion.kinematics import clip_places
from footwork.motion.metric import UNIT
from footwork.motion.metrics import metric_of
from footwork.motion.window import RADIUS, window_weights
from footwork.study.alternative_costs import centre_aligned, positions_and_orientations
from footwork.study.blends import inside
from footwork.study.full_rate import FullRate, full_rate_ranking, phases_of
from footwork.study.transition_picks import median_of_pairs, partners, ranked_by, ranking
from footwork.training.knee import APART
from footwork.training.transitions import Minima
from motion_samples import sample_clip, sample_clips


@pytest.fixture(scope="module")
def clips():
    return sample_clips(3, 90)


def test_picks_are_the_cheapest_places_with_room_for_a_blend(clips):
    lengths = [90, 90, 90]
    found = ranked_by(metric_of("uniform", clips), lengths, 40)
    assert (np.diff(found.ranked.cost) >= 0).all()
    assert inside(lengths, found.ranked.i).all()
    assert inside(lengths, found.ranked.j).all()
    assert len(found.picks.i) == found.knee_rank
    assert len(found.first(10).i) == 10


def test_costs_without_a_knee_have_none():
    found = ranking(np.ones((60, 60)), [60], 5)
    assert found.knee is None
    assert found.knee_rank == len(found.ranked.i)


def test_the_median_leaves_frames_beside_themselves_out():
    costs = np.full((3, 3), 2.0) - 2.0 * np.eye(3)
    assert median_of_pairs(costs) == 2.0


def test_partners_are_near_in_both_frames():
    mine = Minima(np.array([10, 50]), np.array([100, 150]), np.zeros(2))
    others = Minima(np.array([10 + APART, 50]), np.array([100 - APART, 150 + APART + 1]), np.zeros(2))
    assert partners(mine, others).tolist() == [0, -1]
    nothing = Minima(np.array([], int), np.array([], int), np.array([]))
    assert partners(mine, nothing).tolist() == [-1, -1]


def test_laid_by_the_middle_frame_a_pair_costs_what_a_plain_sum_says(clips):
    costs, best = centre_aligned(clips), metric_of("uniform", clips).all_pairs()
    assert (costs >= best - 1e-9).all()
    np.testing.assert_array_equal(costs, costs.T)
    places = np.concatenate([clip_places(clip)[0] for clip in clips])
    i, j = 40, 130
    p, q = places[i - RADIUS : i + RADIUS + 1], places[j - RADIUS : j + RADIUS + 1]
    a, b = (frame - frame.mean(axis=0) * [1, 0, 1] for frame in (p[RADIUS], q[RADIUS]))
    yaws = np.linspace(-np.pi, np.pi, 200_001)
    same, across = np.sum(a[:, [0, 2]] * b[:, [0, 2]]), np.sum(a[:, 0] * b[:, 2] - a[:, 2] * b[:, 0])
    yaw = yaws[np.argmax(same * np.cos(yaws) + across * np.sin(yaws))]
    q = q - q[RADIUS].mean(axis=0) * [1, 0, 1]
    x, z = turn(q[..., 0], q[..., 2], yaw)
    gap = np.stack([x, q[..., 1], z], axis=-1) - (p - p[RADIUS].mean(axis=0) * [1, 0, 1])
    expected = window_weights() @ np.mean(np.sum(gap**2, axis=-1), axis=-1) / UNIT**2
    assert costs[i, j] == pytest.approx(expected, rel=1e-6)


def test_orientations_add_the_square_of_their_angle(clips):
    base = metric_of("uniform", clips).all_pairs()
    np.testing.assert_allclose(positions_and_orientations(clips, 0.0), base, atol=1e-8)
    reach, (i, j) = 0.1, (40, 130)
    turns = np.concatenate([clip_places(clip)[1] for clip in clips])
    theta = metric_of("uniform", clips).align([i], [j]).theta[0]
    offsets = np.arange(-RADIUS, RADIUS + 1)
    yawed = quaternion.multiply(quaternion.from_yaw(np.array(theta)), turns[j + offsets])
    gap = quaternion.multiply(yawed, quaternion.conjugate(turns[i + offsets]))
    angles = np.linalg.norm(quaternion.to_rotation_vector(gap), axis=-1)
    expected = base[i, j] + reach**2 * (window_weights() @ np.mean(angles**2, axis=-1)) / UNIT**2
    assert positions_and_orientations(clips, reach)[i, j] == pytest.approx(expected, rel=1e-6)


def test_at_full_rate_frames_come_in_their_order_in_time():
    clip = sample_clip(frames=401)
    phases = [clip.cut(0, 101), clip.cut(0, 100), clip.cut(0, 100), clip.cut(0, 100)]
    order = FullRate(phases).in_time()
    assert order[:5].tolist() == [0, 101, 201, 301, 1]
    assert sorted(order) == list(range(401))


def test_at_full_rate_picks_are_those_of_the_capture_seen_at_once():
    whole = sample_clip(frames=480)
    every = [type(whole)(**{**vars(whole), **_every_fourth(whole, phase)}) for phase in range(4)]
    capture = FullRate(every)
    costs = metric_of("uniform", every).all_pairs()
    found = full_rate_ranking(costs, capture, 8)
    np.testing.assert_allclose(costs[found.ranked.i, found.ranked.j], found.ranked.cost)
    back = np.argsort(capture.in_time())
    i, j = back[found.ranked.i], back[found.ranked.j]
    assert (np.abs(i - j) >= 60).all()
    slow = ranked_by(metric_of("uniform", every[:1]), [120], 8)
    assert found.ranked.cost[0] <= slow.ranked.cost[0]


def _every_fourth(clip, phase):
    names = ("root_position", "rotations", "contacts", "labels")
    return {name: getattr(clip, name)[phase::4] for name in names}


@pytest.mark.parametrize(("rate", "phases"), [(120.0, 4), (60.0, 2), (30.0, 1), (100.0, 1), (24.0, 1)])
def test_only_multiples_of_thirty_have_phases(rate, phases):
    assert phases_of(rate) == phases
