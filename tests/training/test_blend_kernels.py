import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.alignment import align
from footwork.motion.body import default_body
from footwork.motion.kinematics import forward
from footwork.training.blend_kernels import align_starts, blend, centres_of_mass, place_joints
from footwork.training.centre_of_mass import centre_of_mass, mass_shares, segment_centres

BODY = default_body()


def blended(turns, points, position, weight=0.3, move=(0.0, 0.0, 0.0), bounds=(0, 9, 0, 9)):
    """One row of one chain."""
    rotations, spots = np.empty((1, *turns.shape[1:])), np.empty((1, *points.shape[1:]))
    args = np.array([0]), np.array([position], float), np.array([bounds]), np.array([weight]), np.array([move], float)
    blend(turns, points, *args, rotations, spots)
    return rotations[0], spots[0]


@pytest.fixture
def curves():
    rng = np.random.default_rng(0)
    turns = quaternion.from_rotation_vector(rng.normal(0.0, 0.6, (10, 4, 3)))
    return turns, rng.normal(size=(10, 2, 3))


def test_rotations_are_mixed_by_slerp_and_points_linearly(curves):
    turns, points = curves
    yaw, x, z = 0.7, 2.0, -1.0
    rotations, spots = blended(turns, points, (2, 7), 0.3, (yaw, x, z))
    turn = quaternion.from_yaw(yaw)
    second = turns[7].copy()
    # the root and the one foot are given in the world, the two between them in their parents' frames
    second[[0, 3]] = quaternion.multiply(turn, second[[0, 3]])
    wanted = quaternion.slerp(second, turns[2], 0.3)
    np.testing.assert_allclose(np.abs(np.sum(rotations * wanted, axis=-1)), 1.0, atol=1e-12)
    moved = quaternion.rotate(turn, points[7]) + np.array([x, 0.0, z])
    np.testing.assert_allclose(spots, 0.3 * points[2] + 0.7 * moved, atol=1e-12)


def test_opposite_signs_are_the_same_rotation(curves):
    turns, points = curves
    flipped = turns.copy()
    flipped[5:] *= -1.0
    one, other = blended(turns, points, (2, 7))[0], blended(flipped, points, (2, 7))[0]
    np.testing.assert_allclose(np.abs(np.sum(one * other, axis=-1)), 1.0, atol=1e-12)


def test_equal_rotations_stay_as_they_are(curves):
    turns, points = curves
    same = blended(turns, points, (4, 4))[0]
    np.testing.assert_allclose(np.abs(np.sum(same * turns[4], axis=-1)), 1.0, atol=1e-12)


def test_between_frames_points_follow_a_parabola_exactly():
    time = np.arange(10.0)
    points = np.stack([3.0 + 2.0 * time - 0.5 * time**2] * 3, axis=-1)[:, None]
    turns = np.tile(quaternion.IDENTITY, (10, 1, 1))
    for position in (1.0, 2.25, 4.9, 7.999):
        spots = blended(turns, points, (position, position))[1]
        np.testing.assert_allclose(spots, 3.0 + 2.0 * position - 0.5 * position**2, atol=1e-12)


def test_between_frames_rotations_turn_evenly():
    turns = quaternion.from_rotation_vector(np.outer(np.arange(10.0), [0.1, 0.05, -0.1]))[:, None]
    rotation = blended(turns, np.zeros((10, 1, 3)), (4.5, 4.5))[0]
    wanted = quaternion.from_rotation_vector(np.array([0.45, 0.225, -0.45]))
    np.testing.assert_allclose(rotation[0], wanted, atol=1e-4)


def test_positions_outside_a_clip_are_held_at_its_ends(curves):
    turns, points = curves
    bounds = (0, 4, 5, 9)
    beyond, end = blended(turns, points, (-3.0, 12.0), bounds=bounds), blended(turns, points, (0, 9), bounds=bounds)
    for found, wanted in zip(beyond, end, strict=True):
        np.testing.assert_array_equal(found, wanted)


def test_joints_and_centre_of_mass_are_placed_as_by_forward_kinematics():
    rng = np.random.default_rng(1)
    local = quaternion.from_rotation_vector(rng.normal(0.0, 1.0, (20, BODY.joint_count, 3)))
    places, turns, centre = np.empty((20, BODY.joint_count, 3)), np.empty(local.shape), np.empty((20, 3))
    place_joints(np.arange(BODY.joint_count), BODY.parents, BODY.offsets, local, places, turns)
    centres_of_mass(segment_centres(BODY), mass_shares(BODY), places, turns, centre)
    wanted_places, wanted_turns = forward(BODY, np.zeros(3), local)
    np.testing.assert_allclose(places, wanted_places, atol=1e-12)
    np.testing.assert_allclose(turns, wanted_turns, atol=1e-12)
    np.testing.assert_allclose(centre, centre_of_mass(BODY, wanted_places, wanted_turns), atol=1e-12)


def test_a_standing_bodys_centre_of_mass_is_in_its_pelvis():
    places, turns = forward(BODY, np.zeros(3), np.tile(quaternion.IDENTITY, (BODY.joint_count, 1)))
    x, y, z = centre_of_mass(BODY, places, turns)
    assert (abs(x), abs(z)) < (1e-9, 0.03)
    assert -0.05 < y < 0.2


def test_starts_are_aligned_by_the_closed_form():
    rng = np.random.default_rng(5)
    places = rng.normal(size=(40, 21, 3)) + np.array([5.0, 1.0, -8.0])
    start, last = np.array([[2, 20], [14, 39]]), np.array([[15, 39], [15, 39]])
    move = np.empty((2, 3))
    align_starts(places, start, last, 5, move)
    frames = np.minimum(start[..., None] + np.arange(5), last[..., None])
    clouds = places[frames].reshape(2, 2, -1, 3)
    wanted = align(clouds[:, 0], clouds[:, 1], np.ones(clouds.shape[2]))
    np.testing.assert_allclose(move, np.stack([wanted.theta, wanted.x0, wanted.z0], axis=1), atol=1e-9)
