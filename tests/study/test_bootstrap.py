import numpy as np
import pytest

from footwork.study.bootstrap import NOTHING, Estimate, ratio, relative_difference


def bounds(estimate: Estimate) -> tuple[float, float]:
    assert estimate.low is not None
    assert estimate.high is not None
    return estimate.low, estimate.high


def test_the_interval_of_a_mean_covers_it_as_often_as_it_should():
    rng = np.random.default_rng(0)
    covered = 0
    for trial in range(120):
        sample = rng.normal(3.0, 1.0, 40)
        found = ratio(sample, np.ones(40), trial)
        low, high = bounds(found)
        covered += low <= 3.0 <= high
        assert found.value == pytest.approx(sample.mean())
    assert 0.89 <= covered / 120 <= 0.99


def test_its_width_is_that_of_the_normal_distribution():
    sample = np.random.default_rng(1).normal(0.0, 2.0, 400)
    low, high = bounds(ratio(sample, np.ones(400)))
    assert high - low == pytest.approx(2 * 1.96 * sample.std() / 20, rel=0.05)


def test_a_ratio_weighs_things_by_their_count():
    found = ratio([10.0, 2.0], [5.0, 1.0])
    assert found == pytest.approx((2.0, 2.0, 2.0))


def test_without_counts_there_is_no_estimate():
    assert ratio([0.0, 0.0], [0.0, 0.0]) == NOTHING
    assert relative_difference([1.0], [1.0], [0.0], [0.0]) == NOTHING
    assert NOTHING.words() == "–"


def test_what_both_have_in_common_does_not_widen_the_difference():
    amount = np.random.default_rng(2).gamma(1.0, 5.0, 50)
    same = relative_difference(0.7 * amount, np.ones(50), amount, np.ones(50))
    assert same == pytest.approx((-0.3, -0.3, -0.3))
    zeros, ones = np.zeros(50), np.ones(50)
    apart = relative_difference(
        np.concatenate([0.7 * amount, zeros]),
        np.concatenate([ones, zeros]),
        np.concatenate([zeros, amount]),
        np.concatenate([zeros, ones]),
    )
    assert apart.value == pytest.approx(-0.3)
    low, high = bounds(apart)
    assert low < -0.45
    assert high > -0.1


def test_the_same_seed_draws_the_same():
    assert ratio(range(9), np.ones(9)) == ratio(range(9), np.ones(9))
    assert ratio(range(9), np.ones(9)).words(1, "cm").startswith("4.0 (")
