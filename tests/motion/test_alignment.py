import numpy as np
import pytest
from scipy.optimize import minimize

from footwork.motion.alignment import align, turn


def moved(points, theta, x0, z0):
    x, z = turn(points[..., 0], points[..., 2], theta)
    return np.stack([x + x0, points[..., 1], z + z0], axis=-1)


def left_over(move, p, q, weights):
    return np.sum(weights * np.sum((p - moved(q, *move)) ** 2, axis=-1))


@pytest.mark.parametrize("seed", range(12))
def test_no_search_finds_a_better_alignment(seed):
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 20, 3)) + rng.normal(0.0, 4.0, (2, 1, 3))
    weights = rng.random(20)
    found = align(p, q, weights)
    searches = [minimize(left_over, [start, 0, 0], (p, q, weights)).fun for start in np.linspace(-3, 3, 6)]
    assert found.square == pytest.approx(min(searches), abs=1e-6)
    assert left_over((found.theta, found.x0, found.z0), p, q, weights) == pytest.approx(found.square, abs=1e-12)


def test_a_moved_cloud_is_moved_back():
    rng = np.random.default_rng(1)
    q = rng.normal(size=(7, 15, 3))
    theta, x0, z0 = rng.uniform(-3, 3, 7), rng.normal(0, 10, 7), rng.normal(0, 10, 7)
    p = moved(q, theta[:, None], x0[:, None], z0[:, None])
    found = align(p, q, np.ones(15))
    np.testing.assert_allclose([found.theta, found.x0, found.z0], [theta, x0, z0], atol=1e-12)
    np.testing.assert_allclose(found.square, 0.0, atol=1e-12)


def test_a_cloud_on_one_upright_line_has_no_yaw():
    p = np.array([[1.0, 0.0, 2.0], [1.0, 1.0, 2.0]])
    found = align(p, p + np.array([3.0, 0.5, 0.0]), np.array([0.5, 0.5]))
    assert found.theta == 0.0
    assert (found.x0, found.z0) == pytest.approx((-3.0, 0.0))
    assert found.square == pytest.approx(0.25)


def test_far_from_the_origin_nothing_is_lost():
    rng = np.random.default_rng(2)
    p, q = rng.normal(size=(2, 30, 3))
    near, far = align(p, q, np.ones(30)), align(p + np.array([1e4, 0, 1e4]), q - np.array([1e4, 0, 0]), np.ones(30))
    assert far.square == pytest.approx(near.square, abs=1e-8)
