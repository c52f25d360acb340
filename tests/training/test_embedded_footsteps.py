import itertools
import math

import numpy as np
import pytest

from footwork.motion import quaternion
from footwork.motion.body import default_body
from footwork.motion.kinematics import forward
from footwork.motion.masses import mass_fractions
from footwork.training.embedded.balance import centre_of_mass
from footwork.training.embedded.footsteps import LEFT, RIGHT, RUN, WALK, Planner

BODY = default_body()


def walk(steps: int, turn: float = 0.0, ahead: float = 0.7):
    planner = Planner().stand(1.0)
    for step in range(steps):
        planner.step(step % 2, 0.5, ahead, turn=turn)
    return planner.stand(1.0).plan()


def test_a_plan_goes_as_far_as_its_steps_say():
    plan = walk(6)
    np.testing.assert_allclose(plan.path[0], 0.0)
    np.testing.assert_allclose(plan.path[-1], [0.0, 6 * 0.7], atol=1e-6)
    np.testing.assert_allclose(plan.heading, 0.0)
    assert len(plan.times) == len(plan.labels) == round((2.0 + 6 * 0.5) * 30) + 1


def test_a_turning_plan_ends_facing_the_sum_of_its_turns():
    plan = walk(6, turn=math.radians(15))
    assert plan.heading[-1] == pytest.approx(math.radians(90), abs=1e-6)
    # positive yaw turns left, and +x is to the left of +z
    assert plan.path[-1, 0] > 1.0


def test_a_step_to_the_left_goes_to_the_left_of_the_heading():
    planner = Planner().stand(0.6).go(0.6, turn=math.radians(90)).stand(0.6)
    plan = planner.step(LEFT, 0.5, left=0.4).step(RIGHT, 0.5).stand(0.6).plan()
    np.testing.assert_allclose(plan.path[-1], [0.0, -0.4], atol=1e-3)


def test_feet_alternate_and_stand_beside_the_path():
    plan = walk(6)
    assert [len(contacts) for contacts in plan.contacts] == [4, 4]
    for contacts, side in zip(plan.contacts, (1.0, -1.0), strict=True):
        for before, after in itertools.pairwise(contacts):
            assert before.end < after.start
            assert after.z > before.z
        assert all(contact.x * side > 0.0 for contact in contacts)


def test_a_walk_never_flies_and_a_run_flies_before_each_landing():
    assert walk(6).flights() == []
    planner = Planner().stand(1.0).step(LEFT, 0.5, 0.5)
    for foot in (RIGHT, LEFT, RIGHT):
        planner.step(foot, 0.36, 1.0, gait=RUN)
    flights = planner.step(LEFT, 0.5, 0.5, gait=WALK).step(RIGHT, 0.5, 0.2).stand(1.0).plan().flights()
    assert len(flights) == 3
    assert all(end - start == pytest.approx(0.25 * 0.36) for start, end in flights)


def test_a_clip_opens_and_closes_where_the_planner_says():
    plan = Planner().stand(1.0).open().step(LEFT, 0.5, 0.7).close().stand(1.0).plan()
    assert plan.shown == (30, 46)


def test_the_centre_of_mass_is_the_mean_of_the_segments():
    rng = np.random.default_rng(0)
    rotations = quaternion.normalise(rng.normal(size=(BODY.joint_count, 4)))
    root = rng.normal(size=3)
    places, turns = forward(BODY, root, rotations)
    total = np.zeros(3)
    for joint, share in enumerate(mass_fractions(BODY.names)):
        children = BODY.children(joint)
        tip = BODY.offsets[children[0]] if children else BODY.ends[joint]
        total += share * (places[joint] + 0.5 * quaternion.rotate(turns[joint], tip))
    np.testing.assert_allclose(centre_of_mass(BODY, root, rotations), total, atol=1e-12)
