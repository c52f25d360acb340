import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.body import default_body
from footwork.motion.pair_weights import PairWeights, body_weights, dynamics_weights, limb_inward
from footwork.motion.skeleton import Skeleton

# A trunk of 50 kg with a head of 10 and two legs: thigh 10, foot 5 with its ball, on one side; shank 15, foot 10 on
# the other, where the thigh is a joint without mass.
SMALL = Skeleton(
    names=("hips", "head", "thigh", "foot", "ball", "other_thigh", "other_shank", "other_foot", "other_ball"),
    parents=np.array([-1, 0, 0, 2, 3, 0, 5, 6, 7]),
    offsets=np.zeros((9, 3)),
    masses=np.array([50.0, 10.0, 10.0, 5.0, 0.0, 0.0, 15.0, 10.0, 0.0]),
    feet=np.array([[3, 4], [7, 8]]),
)


def test_mass_is_what_moves_with_a_body_as_a_share_of_the_whole():
    mass, _ = body_weights(SMALL)
    np.testing.assert_allclose(mass, [1.0, 0.1, 0.15, 0.05, 0.0, 0.0, 0.25, 0.1, 0.0], atol=1e-15)


def test_friction_is_for_a_standing_foot_and_what_lies_inward_in_its_leg():
    _, friction = body_weights(SMALL)
    np.testing.assert_allclose(friction[0], [0, 0, 0.85, 0.95, 0, 0, 0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(friction[1], [0, 0, 0, 0, 0, 0, 0.75, 0.9, 0], atol=1e-15)


def test_a_pair_sums_mass_and_the_friction_of_both_frames_and_a_foot_is_halved_between_its_points():
    weights, total = dynamics_weights(SMALL), 1.65  # 1 + 0.1 + 0.15 + 0.05 + 0.25 + 0.1
    one_foot = np.array([1.0, 0.1, 0.15 + 0.85, 0.025 + 0.475, 0.025 + 0.475, 0.0, 0.25, 0.05, 0.05])
    np.testing.assert_allclose(weights.of_pairs([True, False], [False, False]), one_foot / total, atol=1e-15)
    twice = one_foot + np.array([0, 0, 0.85, 0.475, 0.475, 0, 0, 0, 0])
    np.testing.assert_allclose(weights.of_pairs([True, False], [True, False]), twice / total, atol=1e-15)
    # no halving in double support
    both = one_foot + np.array([0, 0, 0, 0, 0, 0, 0.75, 0.45, 0.45])
    np.testing.assert_allclose(weights.of_pairs([True, True], [False, False]), both / total, atol=1e-15)
    np.testing.assert_allclose(weights.of_pairs([False, False], [False, False]).sum(), 1.0, atol=1e-15)


def test_the_weights_do_not_depend_on_kilograms():
    heavier = Skeleton(SMALL.names, SMALL.parents, SMALL.offsets, masses=2.0 * SMALL.masses, feet=SMALL.feet)
    np.testing.assert_allclose(dynamics_weights(heavier).friction, dynamics_weights(SMALL).friction)


def test_the_common_body_has_the_printed_weights():
    body = default_body()
    weights, frictions = body_weights(body)
    mass, friction = dict(zip(body.names, weights, strict=True)), dict(zip(body.names, frictions[0], strict=True))
    printed = {"hips": 1.0, "spine": 0.536, "head": 0.081, "left_upper_arm": 0.050, "left_forearm": 0.022}
    printed |= {"left_hand": 0.006, "left_thigh": 0.161, "left_shank": 0.061, "left_foot": 0.0145}
    assert {name: mass[name] for name in printed} == pytest.approx(printed)
    standing = {"left_foot": 0.9855, "left_shank": 0.939, "left_thigh": 0.839}
    assert {name: weight for name, weight in friction.items() if weight} == pytest.approx(standing)


def test_a_leg_ends_before_the_tree_forks():
    body = default_body()
    limb = [body.names[joint] for joint in limb_inward(body, body.index("right_foot"))]
    assert limb == ["right_foot", "right_shank", "right_thigh"]
    chain = Skeleton(("root", "a", "b"), np.array([-1, 0, 1]), np.zeros((3, 3)))
    assert limb_inward(chain, 2) == [2, 1]


def test_a_body_without_feet_has_its_masses_alone():
    footless = Skeleton(SMALL.names, SMALL.parents, SMALL.offsets, masses=SMALL.masses)
    weights = dynamics_weights(footless)
    assert weights.friction.shape == (0, 9)
    np.testing.assert_array_equal(weights.of_pairs(np.zeros((4, 0)), np.zeros((4, 0))), np.tile(weights.mass, (4, 1)))


def test_a_body_without_masses_is_refused():
    weightless = Skeleton(SMALL.names, SMALL.parents, SMALL.offsets, feet=SMALL.feet, where="light.bvh")
    with pytest.raises(InputError, match=r"light.bvh.*no masses"):
        dynamics_weights(weightless)


@pytest.mark.parametrize(
    ("mass", "friction", "says"),
    [
        ([0.5, 0.4], [[0.0, 0.0]], "sums to 0.9, expected 1"),
        ([0.0, 0.0], [[1.0, 0.0]], "sums to 0, expected 1"),
        ([1.5, -0.5], [[0.0, 0.0]], "negative"),
        ([0.5, 0.5], [[np.nan, 0.0]], "nan"),
        ([0.5, 0.5], [[0.0, 0.0, 1.0]], "shape"),
    ],
)
def test_weights_that_cannot_be_are_refused(mass, friction, says):
    with pytest.raises(InputError, match=says):
        PairWeights(np.array(mass), np.array(friction))
