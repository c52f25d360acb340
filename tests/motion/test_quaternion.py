"""Quaternions against scipy's rotations on random input."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from footwork.motion import quaternion

seeds = st.integers(0, 2**32 - 1)
vectors = arrays(np.float64, 3, elements=st.floats(-3.0, 3.0))


def random_turns(seed: int, count: int = 5) -> np.ndarray:
    return Rotation.random(count, rng=np.random.default_rng(seed)).as_quat()


def same_turn(a: np.ndarray, b: np.ndarray) -> bool:
    return np.allclose(np.abs(np.sum(a * b, axis=-1)), 1.0, atol=1e-9)


@given(seeds)
def test_multiply_and_rotate_agree_with_scipy(seed):
    a, b = random_turns(seed), random_turns(seed + 1)
    v = np.random.default_rng(seed).normal(size=(5, 3))
    assert same_turn(quaternion.multiply(a, b), (Rotation.from_quat(a) * Rotation.from_quat(b)).as_quat())
    assert np.allclose(quaternion.rotate(a, v), Rotation.from_quat(a).apply(v))
    assert np.allclose(quaternion.rotate(quaternion.conjugate(a), quaternion.rotate(a, v)), v)


@given(vectors)
def test_rotation_vectors_agree_with_scipy(vector):
    q = quaternion.from_rotation_vector(vector)
    assert same_turn(q, Rotation.from_rotvec(vector).as_quat())
    back = quaternion.to_rotation_vector(q)
    assert np.allclose(back, Rotation.from_quat(q).as_rotvec(), atol=1e-9)


def test_tiny_rotation_vectors_come_back():
    tiny = np.array([[0.0, 0.0, 0.0], [1e-15, 0.0, 0.0], [0.0, 1e-9, 1e-9]])
    assert np.allclose(quaternion.to_rotation_vector(quaternion.from_rotation_vector(tiny)), tiny, rtol=1e-9, atol=0)


@given(seeds, st.floats(0.0, 1.0))
def test_slerp_goes_the_shorter_way_at_even_speed(seed, share):
    a, b = random_turns(seed)[:2]
    whole = Rotation.from_quat(a).inv() * Rotation.from_quat(b)
    expected = Rotation.from_quat(a) * Rotation.from_rotvec(share * whole.as_rotvec())
    assert same_turn(quaternion.slerp(a, -b, share), expected.as_quat())


def test_positive_yaw_turns_left():
    assert np.allclose(quaternion.rotate(quaternion.from_yaw(np.pi / 2), [0.0, 0.0, 1.0]), [1.0, 0.0, 0.0])


@given(seeds)
def test_between_turns_one_direction_onto_another(seed):
    a, b = np.random.default_rng(seed).normal(size=(2, 4, 3))
    turned = quaternion.rotate(quaternion.between(a, b), quaternion.normalise(a))
    assert np.allclose(turned, quaternion.normalise(b), atol=1e-9)


def test_between_opposite_directions_is_a_half_turn():
    axes = np.eye(3)
    assert np.allclose(quaternion.rotate(quaternion.between(axes, -axes), axes), -axes)


def test_unroll_keeps_neighbours_in_one_hemisphere():
    turns = quaternion.from_yaw(np.linspace(0.0, 20.0, 200))[:, None]
    flipped = turns * np.random.default_rng(0).choice([-1.0, 1.0], size=(200, 1, 1))
    smooth = quaternion.unroll(flipped)
    assert (np.sum(smooth[1:] * smooth[:-1], axis=-1) > 0).all()
    assert same_turn(smooth, turns)
