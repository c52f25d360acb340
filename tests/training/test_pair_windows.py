import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.motion.body import default_body
from footwork.motion.dynamics_metric import align_pair_windows
from footwork.motion.metric import UNIT
from footwork.motion.pair_weights import PairWeights, dynamics_weights
from footwork.motion.window import LENGTH, window_weights
from footwork.training.pair_windows import PRODUCTS, pair_cost, pair_products, standing_of


def laid_out(windows, weights: PairWeights, lanes: int = 8):
    """Windows (n, LENGTH, P, 3) as frames in a row, scaled, and the root weights."""
    points = len(weights.mass)
    root = np.zeros(-(-points // lanes) * lanes)
    root[:points] = np.sqrt(weights.mass)
    flat = windows.reshape(-1, points, 3) * (root[:points, None] / UNIT)
    frames = np.zeros((len(flat), 3, len(root)))
    frames[..., :points] = flat.transpose(0, 2, 1)
    return frames, root


def cost_of(first, second, contacts, weights) -> float:
    frames, root = laid_out(np.stack([first, second]), weights)
    standing = standing_of(np.concatenate(contacts), weights, root)
    products = np.empty((LENGTH, PRODUCTS))
    for k in range(LENGTH):
        pair_products(frames, standing, k, LENGTH + k, products[k])
    return pair_cost(products, window_weights())


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), feet=st.integers(0, 3))
def test_the_cost_is_that_of_the_alignment(seed, feet):
    rng = np.random.default_rng(seed)
    first, second = rng.normal(0.0, 0.4, (2, LENGTH, 5, 3)) + rng.normal(0.0, 2.0, (2, 1, 1, 3))
    contacts = rng.random((2, LENGTH, feet)) < 0.5
    weights = PairWeights(rng.dirichlet(np.ones(5)), rng.random((feet, 5)))
    want = align_pair_windows(first, second, contacts[0], contacts[1], weights).square / UNIT**2
    assert cost_of(first, second, contacts, weights) == pytest.approx(float(want), rel=1e-9, abs=1e-8)


def test_joints_without_weight_count_nothing():
    weights, rng = dynamics_weights(default_body()), np.random.default_rng(0)
    assert (weights.mass == 0.0).any()
    first, second = rng.normal(0.0, 0.4, (2, LENGTH, 21, 3))
    contacts = rng.random((2, LENGTH, 2)) < 0.5
    want = align_pair_windows(first, second, contacts[0], contacts[1], weights).square / UNIT**2
    assert cost_of(first, second, contacts, weights) == pytest.approx(float(want), rel=1e-9)


def test_equal_windows_that_stand_alike_cost_nothing():
    weights, rng = dynamics_weights(default_body()), np.random.default_rng(1)
    window, contacts = rng.normal(0.0, 0.4, (LENGTH, 21, 3)), rng.random((LENGTH, 2)) < 0.5
    assert cost_of(window, window, np.stack([contacts, contacts]), weights) == pytest.approx(0.0, abs=1e-9)
