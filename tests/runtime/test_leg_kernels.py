import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.ik import leg, reach
from footwork.motion.kinematics import forward
from footwork.runtime.leg_kernels import bent_knee

BODY = default_body()
SPAN = 0.42, 0.41  # of the default body's thigh and shank


def bent(places, turns, limb, target, longest):
    hip, knee, ankle = (tuple(places[joint]) for joint in limb[:3])
    return bent_knee(hip, knee, ankle, tuple(turns[limb.upper]), tuple(target), SPAN, longest)


def ankle_of(places, limb, upper, lower):
    """Where rotations put before the thigh's and the shank's take the ankle, from the hip."""
    knee = quaternion.rotate(upper, places[limb.lower] - places[limb.upper])
    return knee + quaternion.rotate(lower, places[limb.tip] - places[limb.lower])


def random_pose(seed: int, spread: float = 0.5):
    random = np.random.default_rng(seed)
    rotations = quaternion.from_rotation_vector(random.normal(0.0, spread, (BODY.joint_count, 3)))
    return forward(BODY, random.normal(0.0, 1.0, 3), rotations), random


@given(st.integers(0, 10_000), st.floats(0.0, 0.4), st.sampled_from(["left", "right"]))
@settings(max_examples=60, deadline=None)
def test_the_kernel_bends_legs_as_the_array_form_does(seed, away, side):
    (places, turns), random = random_pose(seed)
    limb = leg(BODY, side)
    target = places[limb.tip] + away * random.normal(0.0, 1.0, 3)
    upper, lower = reach(places, turns, limb, target)
    before_upper, before_lower = bent(places, turns, limb, target, sum(SPAN))
    came_to = ankle_of(places, limb, before_upper, before_lower)
    way = target - places[limb.upper]
    distance = np.linalg.norm(way)
    np.testing.assert_allclose(came_to, way * min(1.0, sum(SPAN) / distance), atol=1e-9)
    # where a leg is all but straight, rounding decides which way its knee points
    assume(np.linalg.norm(places[limb.tip] - places[limb.upper]) < 0.999 * sum(SPAN))
    for found, own, expected in ((before_upper, limb.upper, upper), (before_lower, limb.lower, lower)):
        turned = quaternion.multiply(found, turns[own])
        assert abs(turned @ expected) == pytest.approx(1.0, abs=1e-9)


def test_a_leg_that_is_straight_bends_forward():
    places, turns = forward(BODY, [0.0, 0.94, 0.0], np.tile(quaternion.IDENTITY, (BODY.joint_count, 1)))
    limb = leg(BODY, "left")
    before, _ = bent(places, turns, limb, places[limb.tip] + [0.0, 0.1, 0.0], sum(SPAN))
    knee = quaternion.rotate(before, places[limb.lower] - places[limb.upper])
    assert knee[2] > 0.1
    assert knee[0] == pytest.approx(0.0, abs=1e-9)


@given(st.integers(0, 10_000), st.floats(0.5, 0.8))
@settings(max_examples=30, deadline=None)
def test_what_is_too_far_is_approached_along_its_own_direction(seed, longest):
    (places, turns), random = random_pose(seed)
    limb = leg(BODY, "right")
    way = quaternion.normalise(random.normal(0.0, 1.0, 3))
    upper, lower = bent(places, turns, limb, places[limb.upper] + 2.0 * way, longest)
    np.testing.assert_allclose(ankle_of(places, limb, upper, lower), longest * way, atol=1e-9)
