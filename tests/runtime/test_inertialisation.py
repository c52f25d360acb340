import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from footwork.motion import quaternion
from footwork.motion.clip import Clip
from footwork.motion.moves import moves_along
from footwork.runtime.inertialisation import decay_weights, ticks_to_settle
from footwork.runtime.world import World
from toy_graphs import edge_between, graph_of, homogeneous, wandering_clip

CLIPS = [wandering_clip(1), wandering_clip(2)]
FRAMES = CLIPS[0].frame_count
JUMP = (10, FRAMES + 5)
GRAPH = graph_of(CLIPS, [JUMP, (FRAMES + 8, 3)])
PATH = [*range(8, 11), *range(FRAMES + 6, FRAMES + 9), *range(4, 8)]


def take(world: World, source: int, target: int) -> None:
    world.step(moves_along(world.graph, np.array([edge_between(world.graph, source, target)])))


def seen(world: World, fraction: float) -> tuple[np.ndarray, Rotation]:
    root, rotations = world.show(fraction)
    return root[0].astype(float), Rotation.from_quat(rotations[0].astype(float))


def jumped(**options) -> World:
    world = World(GRAPH, 1, **options)
    world.spawn(JUMP[0], 1.0, -2.0, 0.7)
    take(world, JUMP[0], JUMP[1] + 1)
    return world


@given(st.floats(0.0, 1.0), st.floats(0.02, 0.5), st.floats(-2.0, 2.0), st.floats(-20.0, 20.0))
@settings(max_examples=30, deadline=None)
def test_decay_solves_the_critically_damped_spring(seconds, halflife, x, v):
    y = 2.0 * np.log(2.0) / halflife
    a, b, c, d = decay_weights(seconds, halflife)
    solved = solve_ivp(lambda _, s: [s[1], -2 * y * s[1] - y * y * s[0]], (0, seconds), [x, v], rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose([a * x + b * v, c * x + d * v], solved.y[:, -1], atol=1e-6)


def test_decay_of_two_spans_is_the_decay_of_both():
    first, second, both = (np.reshape(decay_weights(s, 0.1), (2, 2)) for s in (0.02, 0.03, 0.05))
    np.testing.assert_allclose(second @ first, both, atol=1e-12)


def test_the_pose_shown_is_continuous_in_place_and_velocity_at_every_tick():
    world, small = World(GRAPH, 1), 1e-2
    world.spawn(PATH[0], 1.0, -2.0, 0.7)
    for source, target in itertools.pairwise(PATH):
        (root_0, turn_0), (root_1, turn_1) = seen(world, 1.0 - small), seen(world, 1.0)
        take(world, source, target)
        (root_2, turn_2), (root_3, turn_3) = seen(world, 1e-12), seen(world, small)
        np.testing.assert_allclose(root_2, root_1, atol=1e-6)
        assert (turn_2 * turn_1.inv()).magnitude().max() < 1e-6
        if target != source + 1:
            per_second = 30.0 / small
            np.testing.assert_allclose((root_3 - root_2) * per_second, (root_1 - root_0) * per_second, atol=0.02)
            before, after = (turn_1 * turn_0.inv()).as_rotvec(), (turn_3 * turn_2.inv()).as_rotvec()
            np.testing.assert_allclose(after * per_second, before * per_second, atol=0.06)


def test_without_inertialisation_the_jump_is_bare():
    world, bare = jumped(), jumped(inertialise=False)
    old = World(GRAPH, 1)
    old.spawn(JUMP[0], 1.0, -2.0, 0.7)
    _, before = seen(old, 1.0)
    _, smooth = seen(world, 1e-9)
    _, sharp = seen(bare, 1e-9)
    assert (smooth * before.inv()).magnitude().max() < 1e-6
    assert (sharp * before.inv()).magnitude().max() > 0.5
    root, rotations = bare.show(1.0)
    np.testing.assert_array_equal(rotations[0, 1:], GRAPH.rotations[JUMP[1] + 1, 1:])
    assert root[0, 1] == GRAPH.root_position[JUMP[1] + 1, 1]


@pytest.mark.parametrize("halflife", [0.02, 0.1, 0.5])
def test_offsets_that_are_dropped_were_too_small_to_see(halflife):
    a, b, _, _ = decay_weights(ticks_to_settle(halflife) / 30.0, halflife)
    assert 10.0 * a + 100.0 * b < 1e-6


def test_after_settling_the_pose_is_the_node_to_the_last_bit():
    clip = wandering_clip(3, frames=80)
    graph = graph_of([clip, wandering_clip(4)], [(90, 5)])
    world, bare = World(graph, 1), World(graph, 1, inertialise=False)
    for each in (world, bare):
        each.spawn(90, 0.0, 0.0, 0.0)
        take(each, 90, 6)
    for node in range(6, 6 + ticks_to_settle(0.1)):
        assert world.show(0.7)[1].tobytes() != bare.show(0.7)[1].tobytes()
        take(world, node, node + 1)
        take(bare, node, node + 1)
    assert world.show(0.7)[1].tobytes() == bare.show(0.7)[1].tobytes()
    assert world.show(0.7)[0].tobytes() == bare.show(0.7)[0].tobytes()


def test_offsets_die_away():
    world, bare = jumped(), jumped(inertialise=False)
    for node in range(JUMP[1] + 1, 2 * FRAMES - 1):
        take(world, node, node + 1)
        take(bare, node, node + 1)
    (root, turn), (bare_root, bare_turn) = seen(world, 1.0), seen(bare, 1.0)
    np.testing.assert_allclose(root, bare_root, atol=1e-3)
    assert (turn * bare_turn.inv()).magnitude().max() < 5e-3


@pytest.mark.parametrize("fraction", [0.25, 0.5, 1.0])
def test_the_pose_after_a_jump_is_what_scipy_makes_of_the_formula(fraction):
    """A second formulation in scipy's rotations: from rest offsets to the pose within the tick of the jump."""
    i, k = JUMP[0], JUMP[1] + 1
    edge = edge_between(GRAPH, i, k)
    old_place = homogeneous((1.0, -2.0, 0.7))
    new_place = old_place @ homogeneous(GRAPH.displacement[edge])
    a, b, _, _ = decay_weights(fraction / 30.0, 0.1)

    def motion(node, place, seconds):
        turn = Rotation.from_matrix(place[:3, :3])
        turns = Rotation.from_rotvec(GRAPH.angular_velocity[node] * seconds) * Rotation.from_quat(GRAPH.rotations[node])
        root = GRAPH.root_position[node] + GRAPH.root_velocity[node] * seconds
        spins = GRAPH.angular_velocity[node].astype(float)
        spins[0] = turn.apply(spins[0])
        turns = Rotation.concatenate([turn * turns[0], turns[1:]])
        return place[:3, :3] @ root + place[:3, 3], turns, turn.apply(GRAPH.root_velocity[node]), spins

    root_i, turn_i, speed_i, spin_i = motion(i, old_place, 0.0)
    root_j, turn_j, speed_k, spin_k = motion(k, new_place, -1.0 / 30.0)
    left = (turn_i * turn_j.inv()).as_rotvec()
    # The offset's rate by brute force: the x(t) that joins the old motion to the new, differenced around the jump.
    step = 1e-5
    ahead = Rotation.from_rotvec(spin_i * step) * turn_i * (Rotation.from_rotvec(spin_k * step) * turn_j).inv()
    back = Rotation.from_rotvec(-spin_i * step) * turn_i * (Rotation.from_rotvec(-spin_k * step) * turn_j).inv()
    rate = (ahead.as_rotvec() - back.as_rotvec()) / (2.0 * step)
    root_f, turn_f, _, _ = motion(k, new_place, -(1.0 - fraction) / 30.0)
    root, turn = seen(jumped(), fraction)
    np.testing.assert_allclose(root, root_f + a * (root_i - root_j) + b * (speed_i - speed_k), atol=1e-5)
    expected = Rotation.from_rotvec(a * left + b * rate) * turn_f
    assert (turn * expected.inv()).magnitude().max() < 1e-5


@given(st.floats(-3.0, 3.0), st.floats(-9.0, 9.0), st.floats(-9.0, 9.0))
@settings(max_examples=20, deadline=None)
def test_a_teleport_moves_what_is_shown_as_a_rigid_body(yaw, x, z):
    world, stayed = jumped(), jumped()
    moved = homogeneous((x, z, yaw)) @ np.linalg.inv(homogeneous(world.place[0]))
    world.correct(0, x, z, yaw)
    for node in range(JUMP[1] + 1, JUMP[1] + 4):
        (root, turn), (expected, expected_turn) = seen(world, 0.4), seen(stayed, 0.4)
        np.testing.assert_allclose(root, moved[:3, :3] @ expected + moved[:3, 3], atol=1e-5)
        lifted = Rotation.from_matrix(moved[:3, :3]) * expected_turn[0]
        assert (turn[0] * lifted.inv()).magnitude() < 2e-6
        assert (turn[1:] * expected_turn[1:].inv()).magnitude().max() < 1e-6
        take(world, node, node + 1)
        take(stayed, node, node + 1)


def swing_after_a_jump(sign: float) -> np.ndarray:
    """How far each joint has turned a tick after a jump to the same motion with one joint turned by 3.1 rad."""
    clip = wandering_clip(1)
    turned = clip.rotations.copy()
    turned[:, 3] = quaternion.multiply(quaternion.from_rotation_vector([0.0, 3.1, 0.0]), turned[:, 3])
    other = Clip("turned", clip.skeleton, clip.fps, clip.root_position, sign * turned)
    world = World(graph_of([clip, other], [(5, FRAMES + 5)]), 1)
    world.spawn(5, 0.0, 0.0, 0.0)
    _, before = seen(world, 1.0)
    take(world, 5, FRAMES + 6)
    _, after = seen(world, 1e-9)
    assert (after * before.inv()).magnitude().max() < 1e-6
    _, later = seen(world, 1.0)
    return (later * before.inv()).magnitude()


def test_a_turn_by_nearly_half_a_circle_goes_the_shorter_way_whatever_the_quaternions_signs():
    swing = swing_after_a_jump(1.0)
    assert swing[3] == pytest.approx(3.1 * (1.0 - decay_weights(1 / 30, 0.1)[0]), abs=0.35)
    np.testing.assert_allclose(swing_after_a_jump(-1.0), swing, atol=1e-5)
