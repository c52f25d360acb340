import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from footwork.motion.tick import TICK
from footwork.study.motion_matching.options import RootPull
from footwork.study.motion_matching.simulated_root import move_character, pull_to
from footwork.study.motion_matching.springs import angle_after, share_gone, velocity_after
from toy_graphs import homogeneous

number = st.floats(-4.0, 4.0)
halflives, times = st.floats(0.05, 1.0), st.floats(0.01, 1.0)
PULL = RootPull()


def integrated(start, wanted, halflife, seconds):
    """Value, rate and integral of a critically damped spring: x'' = -2 y x' - y^2 (x - wanted)."""
    y = 2.0 * math.log(2.0) / halflife

    def rates(_, now):
        return [now[1], -2.0 * y * now[1] - y * y * (now[0] - wanted), now[0]]

    return solve_ivp(rates, (0.0, seconds), [*start, 0.0], rtol=1e-9, atol=1e-10).y[:, -1]


@given(number, number, number, number, halflives, times)
@settings(max_examples=30, deadline=None)
def test_springs_are_those_of_their_differential_equation(place, value, rate, wanted, halflife, seconds):
    end, end_rate, gone = integrated((value, rate), wanted, halflife, seconds)
    after = angle_after(value, rate, wanted, halflife, seconds)
    assert after == pytest.approx((end, end_rate), rel=1e-6, abs=1e-6)
    after = velocity_after(place, value, rate, wanted, halflife, seconds)
    assert after == pytest.approx((place + gone, end, end_rate), rel=1e-6, abs=1e-6)


def test_half_is_gone_after_a_half_life():
    assert share_gone(0.2, 0.2) == pytest.approx(0.5)


@given(st.lists(number, min_size=8, max_size=8), st.tuples(number, number, number))
@settings(max_examples=50, deadline=None)
def test_a_root_stays_where_it_is_in_the_world_when_its_character_moves(root, step):
    seen = np.array(root)
    move_character(seen, step)
    before, after = homogeneous(root[:3]), homogeneous(step) @ homogeneous(seen[:3])
    np.testing.assert_allclose(after, before, atol=1e-9)
    for x, z in ((3, 4), (5, 6)):
        there = homogeneous((0.0, 0.0, step[2])) @ [seen[x], 0.0, seen[z], 1.0]
        np.testing.assert_allclose(there[[0, 2]], [root[x], root[z]], atol=1e-9)
    assert seen[7] == root[7]


@given(number, number, st.floats(-3.1, 3.1), st.floats(0.0, 5.0), st.floats(0.0, 3.0))
@settings(max_examples=80, deadline=None)
def test_a_pull_keeps_to_its_share_of_speed_and_to_its_limits(x, z, yaw, speed, spin):
    root = np.array([x, z, yaw, 0.0, 0.0, 0.0, 0.0, 0.0])
    by = pull_to(root, speed, spin, PULL)
    far, wide, go, turn = math.hypot(x, z), abs(yaw), math.hypot(by[0], by[1]), abs(by[2])
    assert by[0] * z == pytest.approx(by[1] * x, abs=1e-9)
    assert far - go <= PULL.farthest + 1e-9
    assert wide - turn <= PULL.widest + 1e-9
    if go > far - PULL.farthest + 1e-9:
        assert go == pytest.approx(min(far * share_gone(PULL.position_halflife, TICK), 0.5 * speed * TICK))
    if turn > wide - PULL.widest + 1e-9:
        assert turn == pytest.approx(min(wide * share_gone(PULL.rotation_halflife, TICK), 0.5 * spin * TICK))
    assert by[2] * yaw >= 0.0
