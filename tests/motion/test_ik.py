import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.ik import Limb, arm, leg, place_limb, reach
from footwork.motion.kinematics import forward

BODY = default_body()
LIMBS = [leg(BODY, "left"), leg(BODY, "right"), arm(BODY, "left"), arm(BODY, "right")]
FRAMES = 20


def random_pose(seed):
    rng = np.random.default_rng(seed)
    rotations = quaternion.normalise(rng.normal(size=(FRAMES, BODY.joint_count, 4)))
    return rng, rng.normal(size=(FRAMES, 3)), rotations


def bone_lengths(limb):
    return np.linalg.norm(BODY.offsets[limb.lower]), np.linalg.norm(BODY.offsets[limb.tip])


def random_target(rng, places, limb, low, high):
    upper, lower = bone_lengths(limb)
    directions = quaternion.normalise(rng.normal(size=(FRAMES, 3)))
    shares = rng.uniform(low, high, size=(FRAMES, 1))
    return places[:, limb.upper] + directions * (abs(upper - lower) + shares * (upper + lower - abs(upper - lower)))


def plane_normal(places, limb):
    root, middle, tip = places[:, limb.upper], places[:, limb.lower], places[:, limb.tip]
    return quaternion.normalise(np.cross(middle - root, tip - middle))


def clearly_bent(places, limb):
    """Frames in which the limb is far enough from straight to have a plane of its own."""
    middle, tip = (places[:, joint] - places[:, limb.upper] for joint in (limb.lower, limb.tip))
    away = np.linalg.norm(np.cross(middle, quaternion.normalise(tip)), axis=-1)
    return away > 0.02 * np.linalg.norm(middle, axis=-1)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from(LIMBS))
def test_a_reachable_target_is_met_and_the_tip_keeps_its_rotation(seed, limb):
    rng, root, rotations = random_pose(seed)
    places, turns = forward(BODY, root, rotations)
    target = random_target(rng, places, limb, 0.0, 1.0)
    placed = place_limb(BODY, root, rotations, limb, target, pole=rng.normal(size=3))
    new_places, new_turns = forward(BODY, root, placed)
    np.testing.assert_allclose(new_places[:, limb.tip], target, atol=1e-9)
    np.testing.assert_allclose(np.abs(np.sum(new_turns[:, limb.tip] * turns[:, limb.tip], axis=-1)), 1.0, atol=1e-12)
    others = [joint for joint in range(BODY.joint_count) if joint not in limb[:3]]
    np.testing.assert_array_equal(placed[:, others], rotations[:, others])


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from(LIMBS))
def test_the_middle_joint_points_along_the_pole(seed, limb):
    rng, root, rotations = random_pose(seed)
    places, _ = forward(BODY, root, rotations)
    target = random_target(rng, places, limb, 0.1, 0.9)
    pole = rng.normal(size=(FRAMES, 3))
    new_places, _ = forward(BODY, root, place_limb(BODY, root, rotations, limb, target, pole))
    along = quaternion.normalise(target - places[:, limb.upper])
    middle = new_places[:, limb.lower] - places[:, limb.upper]
    bend = middle - np.sum(middle * along, axis=-1, keepdims=True) * along
    wanted = pole - np.sum(pole * along, axis=-1, keepdims=True) * along
    np.testing.assert_allclose(quaternion.normalise(bend), quaternion.normalise(wanted), atol=1e-6)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from(LIMBS))
def test_without_a_pole_a_target_in_the_bending_plane_keeps_the_plane(seed, limb):
    rng, root, rotations = random_pose(seed)
    places, _ = forward(BODY, root, rotations)
    normal = plane_normal(places, limb)
    along = quaternion.normalise(places[:, limb.tip] - places[:, limb.upper])
    angle = rng.uniform(-0.5, 0.5, size=(FRAMES, 1))
    turned = quaternion.rotate(quaternion.from_rotation_vector(angle * normal), along)
    target = places[:, limb.upper] + turned * 0.8 * sum(bone_lengths(limb))
    new_places, _ = forward(BODY, root, place_limb(BODY, root, rotations, limb, target))
    bent = clearly_bent(places, limb)
    np.testing.assert_allclose(plane_normal(new_places, limb)[bent], normal[bent], atol=1e-6)


@pytest.mark.parametrize("limb", LIMBS)
def test_a_target_where_the_tip_already_is_changes_nothing(limb):
    _, root, rotations = random_pose(3)
    places, _ = forward(BODY, root, rotations)
    placed = place_limb(BODY, root, rotations, limb, places[:, limb.tip])
    np.testing.assert_allclose(np.abs(np.sum(placed * rotations, axis=-1)), 1.0, atol=1e-9)


@pytest.mark.parametrize("limb", LIMBS)
@pytest.mark.parametrize("softness", [0.0, 0.05])
def test_a_target_out_of_reach_is_pointed_at_without_stretching(limb, softness):
    rng, root, rotations = random_pose(4)
    places, _ = forward(BODY, root, rotations)
    target = random_target(rng, places, limb, 1.5, 3.0)
    new_places, _ = forward(BODY, root, place_limb(BODY, root, rotations, limb, target, softness=softness))
    span = new_places[:, limb.tip] - new_places[:, limb.upper]
    np.testing.assert_allclose(
        quaternion.normalise(span), quaternion.normalise(target - places[:, limb.upper]), atol=1e-7
    )
    length = np.linalg.norm(span, axis=-1)
    full = sum(bone_lengths(limb))
    assert (length <= full + 1e-9).all()
    assert (length > full * (1.0 - 0.05)).all()


@pytest.mark.parametrize("limb", LIMBS)
def test_a_straight_limb_bends_the_way_its_joint_goes(limb):
    rest = np.zeros((1, BODY.joint_count, 4))
    rest[..., 3] = 1.0
    places, _ = forward(BODY, np.zeros((1, 3)), rest)
    root, tip = places[:, limb.upper], places[:, limb.tip]
    target = root + 0.8 * (tip - root)
    new_places, _ = forward(BODY, np.zeros((1, 3)), place_limb(BODY, np.zeros((1, 3)), rest, limb, target))
    middle = new_places[0, limb.lower] - 0.5 * (root + target)[0]
    assert middle @ np.array(limb.bend) > 0.05


def test_soft_reach_straightens_the_knee_without_a_jump_in_its_speed():
    limb = LIMBS[0]
    rest = np.zeros((400, BODY.joint_count, 4))
    rest[..., 3] = 1.0
    root = np.zeros((400, 3))
    places, _ = forward(BODY, root, rest)
    depth = np.linspace(0.70, 0.90, 400)
    target = places[:, limb.upper] - depth[:, None] * np.array([0.0, 1.0, 0.0])

    def worst_acceleration(softness):
        placed = place_limb(BODY, root, rest, limb, target, softness=softness)
        knee = 2.0 * np.arctan2(placed[:, limb.lower, 0], placed[:, limb.lower, 3])
        return np.abs(np.diff(knee, n=2)).max()

    assert worst_acceleration(0.03) < 0.1 * worst_acceleration(0.0)


def test_a_target_at_the_root_and_a_pole_along_the_limb_stay_finite():
    limb = Limb(*LIMBS[0][:3])
    _, root, rotations = random_pose(5)
    places, turns = forward(BODY, root, rotations)
    for turned in reach(places, turns, limb, places[:, limb.upper]):
        assert np.isfinite(turned).all()
    target = places[:, limb.upper] + np.array([0.0, -0.6, 0.0])
    for turned in reach(places, turns, limb, target, pole=np.array([0.0, -1.0, 0.0])):
        assert np.isfinite(turned).all()
