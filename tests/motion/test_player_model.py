"""The player model: what it refuses, and its expectation against sums written out."""

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.player_model import PlayerModel, TraceFile, persistent_player

BEHAVIOURS = ("stop", "walk", "run")
BINS = 8


def any_model(seed: int = 0) -> PlayerModel:
    change = np.random.default_rng(seed).random((3, 3, BINS))
    return PlayerModel(BEHAVIOURS, change / change.sum(axis=(1, 2), keepdims=True))


def test_the_matrix_is_row_stochastic_and_the_same_whichever_way_the_player_looks():
    matrix = any_model().matrix
    np.testing.assert_allclose(matrix.sum(axis=1), 1.0)
    grid = matrix.reshape(3, BINS, 3, BINS)
    turned = np.roll(grid, (3, 3), axis=(1, 3))
    np.testing.assert_array_equal(turned, grid)


def test_the_expectation_is_the_sum_over_what_may_come():
    model = any_model()
    values = np.random.default_rng(1).normal(size=(5, 3, BINS))
    expected = model.expected(values)
    for behaviour, heading in ((0, 0), (1, 5), (2, 7)):
        by_hand = sum(
            model.change[behaviour, after, jump] * values[:, after, (heading + jump) % BINS]
            for after in range(3)
            for jump in range(BINS)
        )
        np.testing.assert_allclose(expected[:, behaviour, heading], by_hand)


def test_a_persistent_player_expects_what_is():
    values = np.random.default_rng(1).normal(size=(5, 3, BINS))
    np.testing.assert_array_equal(persistent_player(BEHAVIOURS, BINS).expected(values), values)


def test_a_model_is_read_only_and_remembers_what_it_learned_from():
    model = PlayerModel(BEHAVIOURS, any_model().change, [TraceFile("a.csv", "0" * 64)])  # type: ignore[arg-type]
    assert model.learned_from == (TraceFile("a.csv", "0" * 64),)
    with pytest.raises(ValueError, match="read-only"):
        model.change[0, 0, 0] = 1.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (np.zeros((3, 2, BINS)), "expected \\(3, 3, any\\)"),
        (np.full((3, 3, BINS), np.nan), "expected a finite number"),
        (np.ones((3, 3, BINS)), "probabilities after stop sum to 24.0, expected 1"),
        (persistent_player(BEHAVIOURS, BINS).change * 3.0 - 2.0 / (3 * BINS), "expected probabilities"),
        (np.zeros((3, 3, 0)), "sum to 0.0"),
    ],
)
def test_what_are_no_probabilities_is_refused(change, said):
    with pytest.raises(InputError, match=said):
        PlayerModel(BEHAVIOURS, change)
