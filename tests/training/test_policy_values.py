import numpy as np
import pytest

from footwork.training.policy_values import settle
from footwork.training.sweeps import Policy

NODES, HEADINGS, BEHAVIOURS, DISCOUNT = 12, 5, 2, 0.95


def random_policy(rng: np.random.Generator, nodes_led_to: int = NODES) -> Policy:
    """Some actions come to a heading exactly."""
    shape = NODES, HEADINGS, BEHAVIOURS
    node, heading = rng.integers(0, nodes_led_to, shape), rng.integers(0, HEADINGS, shape)
    place = (node * (HEADINGS + 1) + heading) * BEHAVIOURS + np.arange(BEHAVIOURS)
    share = np.where(rng.random(shape) < 0.5, 0.0, rng.random(shape))
    return Policy(place.ravel().astype(np.int32), share.ravel(), rng.random(shape).ravel())


def solved(policy: Policy, wanted: int) -> np.ndarray:
    """By a dense solve.  # (N, H)"""
    place, share, reward = (np.reshape(each, (NODES, HEADINGS, BEHAVIOURS))[..., wanted].ravel() for each in policy)
    node, heading = np.divmod(place // BEHAVIOURS, HEADINGS + 1)
    chance, states = np.zeros((NODES * HEADINGS,) * 2), np.arange(NODES * HEADINGS)
    chance[states, node * HEADINGS + heading] += 1.0 - share
    chance[states, node * HEADINGS + (heading + 1) % HEADINGS] += share
    return np.linalg.solve(np.eye(len(states)) - DISCOUNT * chance, reward).reshape(NODES, HEADINGS)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("nodes_led_to", [1, 3, NODES])
def test_a_settled_policy_is_worth_what_a_dense_solve_says(seed, nodes_led_to):
    rng = np.random.default_rng(seed)
    policy = random_policy(rng, nodes_led_to)
    copies = rng.random((2, NODES, HEADINGS + 1, BEHAVIOURS))
    others = copies.copy()
    settle(policy, DISCOUNT, 1, 1e-12, 10_000, copies, 0)
    np.testing.assert_allclose(copies[0, :, :-1, 1], solved(policy, 1), atol=1e-9)
    np.testing.assert_array_equal(copies[0, :, -1, 1], copies[0, :, 0, 1])
    np.testing.assert_array_equal(copies[0, ..., 0], others[0, ..., 0])
    np.testing.assert_array_equal(copies[1], others[1])


def test_a_policy_without_cycles_but_one_takes_one_sweep():
    """Every node leads to the one before, the first to itself: the core is node 0, whatever it is worth at first."""
    node, heading, wanted = np.indices((NODES, HEADINGS, BEHAVIOURS))
    place = (np.maximum(node - 1, 0) * (HEADINGS + 1) + heading) * BEHAVIOURS + wanted
    policy = Policy(place.ravel().astype(np.int32), np.zeros(place.size), np.ones(place.size))
    copies = np.zeros((1, NODES, HEADINGS + 1, BEHAVIOURS))
    copies[0, 0] = 1.0 / (1.0 - DISCOUNT)
    settle(policy, DISCOUNT, 0, 1e-9, 1, copies, 0)
    np.testing.assert_allclose(copies[0, ..., 0], 1.0 / (1.0 - DISCOUNT))
