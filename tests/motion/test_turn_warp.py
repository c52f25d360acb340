from dataclasses import replace

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion.kinematics import forward
from footwork.motion.metric import UNIT
from footwork.motion.turn_warp import adjustment_cost, cost_of_adjustment, turn_about, turn_warp, turned
from footwork.motion.window import window_weights
from toy_graphs import edge_between, graph_of, homogeneous, wandering_clip

CLIPS = [wandering_clip(1), wandering_clip(2)]
FRAMES = CLIPS[0].frame_count
PLAIN = graph_of(CLIPS, [(10, FRAMES + 5), (FRAMES + 12, 4)])
STANDING = np.random.default_rng(5).random((PLAIN.node_count, 2)) < 0.5
GRAPH = replace(PLAIN, contacts=STANDING)
WARP = turn_warp(GRAPH)
PLACES = forward(GRAPH.skeleton, GRAPH.root_position, GRAPH.rotations)[0]
small = st.floats(-0.3, 0.3)
node = st.integers(0, GRAPH.node_count - 1)


def moved(points, place) -> np.ndarray:
    matrix = homogeneous(place)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def cost_by_brute_force(first: int, adjustment) -> float:
    """The window's later frames as points, adjusted, subtracted and summed."""
    total, at, place = 0.0, first, np.eye(4)
    for weight in window_weights()[5:]:
        points = PLACES[at] @ place[:3, :3].T + place[:3, 3]
        total += weight * np.mean(np.sum((moved(points, adjustment) - points) ** 2, axis=-1))
        if at not in (FRAMES - 1, 2 * FRAMES - 1):
            place = place @ homogeneous(GRAPH.displacement[edge_between(GRAPH, at, at + 1)].astype(float))
            at += 1
    return total / UNIT**2


@given(node, small, small, st.floats(-3.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_the_closed_form_is_what_moving_every_point_costs(first, x, z, yaw):
    found = adjustment_cost(WARP.moments[first], [x, z, yaw])
    assert found == pytest.approx(cost_by_brute_force(first, (x, z, yaw)), rel=1e-9, abs=1e-12)


@given(node, st.floats(-3.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_the_price_is_that_of_a_turn_about_the_pivot(first, yaw):
    found = adjustment_cost(WARP.moments[first], turned(WARP.pivot[first], yaw))
    assert found == pytest.approx(WARP.price[first] * 4.0 * np.sin(yaw / 2.0) ** 2, rel=1e-9, abs=1e-12)


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(-3.1, 3.1))
@settings(max_examples=60, deadline=None)
def test_a_turn_leaves_its_pivot_in_place(x, z, yaw):
    adjustment = turned([x, z], yaw)
    np.testing.assert_allclose(moved(np.array([x, 0.0, z]), adjustment), [x, 0.0, z], atol=1e-12)
    assert adjustment[2] == yaw


def test_turns_go_about_the_feet_that_stand():
    balls = PLACES[:, GRAPH.skeleton.feet[:, 1]][..., [0, 2]]
    for at, stands in enumerate(STANDING):
        if stands.any():
            np.testing.assert_allclose(WARP.pivot[at], balls[at][stands].mean(axis=0), atol=1e-12)


@given(node, small, small)
@settings(max_examples=60, deadline=None)
def test_in_flight_no_pivot_is_cheaper(first, x, z):
    if not STANDING[first].any():
        elsewhere = adjustment_cost(WARP.moments[first], turned(WARP.pivot[first] + [x, z], 0.1))
        assert WARP.price[first] * 4.0 * np.sin(0.05) ** 2 <= elsewhere + 1e-12


def test_compiled_callers_get_the_same_numbers():
    @numba.njit
    def compiled(m, x, z, yaw):
        return cost_of_adjustment(m[0], m[1], m[2], m[3], *turn_about(x, z, yaw))

    for at in range(0, GRAPH.node_count, 7):
        x, z = WARP.pivot[at]
        expected = adjustment_cost(WARP.moments[at], turned(WARP.pivot[at], 0.1))
        assert compiled(WARP.moments[at], x, z, 0.1) == pytest.approx(expected, rel=1e-12)


def test_arrays_are_read_only_and_broadcast():
    assert not any(array.flags.writeable for array in (WARP.pivot, WARP.moments, WARP.price))
    yaws = np.linspace(-0.1, 0.1, 5)
    assert turned(WARP.pivot[:, None], yaws).shape == (GRAPH.node_count, 5, 3)
    assert adjustment_cost(WARP.moments[:, None], turned(WARP.pivot[:, None], yaws)).shape == (GRAPH.node_count, 5)
