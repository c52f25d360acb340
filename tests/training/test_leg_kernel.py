import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.ik import leg, reach
from footwork.motion.kinematics import forward
from footwork.training.leg_kernel import reach_feet

BODY = default_body()
SIDES = ("left", "right")


def legs():
    return np.array([leg(BODY, side)[:3] for side in SIDES])


def reached(rotations, targets):
    """World rotations after the kernel and after ``motion.ik``, which works on one leg at a time."""
    places, turns = forward(BODY, np.zeros(3), rotations)
    ours, theirs = turns.copy(), turns.copy()
    reach_feet(legs(), np.array(leg(BODY, "left").bend), places, ours, targets)
    for foot, side in enumerate(SIDES):
        limb = leg(BODY, side)
        theirs[..., limb.upper, :], theirs[..., limb.lower, :] = reach(places, turns, limb, targets[:, foot])
    return ours, theirs


@pytest.mark.parametrize("spread", [0.02, 0.3, 2.0])
def test_legs_reach_as_those_of_inverse_kinematics(spread):
    rng = np.random.default_rng(7)
    rotations = quaternion.from_rotation_vector(rng.normal(0.0, 0.5, (200, BODY.joint_count, 3)))
    ankles = forward(BODY, np.zeros(3), rotations)[0][:, BODY.feet[:, 0]]
    ours, theirs = reached(rotations, ankles + rng.normal(0.0, spread, ankles.shape))
    same = np.abs(np.sum(ours * theirs, axis=-1))
    np.testing.assert_allclose(same, 1.0, atol=1e-12)


def test_straight_legs_bend_the_same_way():
    rotations = np.tile(quaternion.IDENTITY, (3, BODY.joint_count, 1))
    ankles = forward(BODY, np.zeros(3), rotations)[0][:, BODY.feet[:, 0]]
    # shortened, lengthened beyond reach, and brought to the hip itself
    targets = ankles.copy()
    targets[0, :, 1] += 0.2
    targets[1, :, 1] -= 0.2
    targets[2] = forward(BODY, np.zeros(3), rotations)[0][2, [leg(BODY, side).upper for side in SIDES]]
    ours, theirs = reached(rotations, targets)
    np.testing.assert_allclose(np.abs(np.sum(ours * theirs, axis=-1)), 1.0, atol=1e-12)


def test_other_joints_are_left_alone():
    rotations = np.tile(quaternion.IDENTITY, (1, BODY.joint_count, 1))
    places, turns = forward(BODY, np.zeros(3), rotations)
    before = turns.copy()
    reach_feet(legs(), np.array([0.0, 0.0, 1.0]), places, turns, np.zeros((1, 2, 3)))
    others = np.setdiff1d(np.arange(BODY.joint_count), legs()[:, :2])
    np.testing.assert_array_equal(turns[:, others], before[:, others])
