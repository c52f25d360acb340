"""Values as they are kept: how near sixteen bits come, and what they leave exactly as it was."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footwork.errors import InputError
from footwork.motion.coded_values import CodedValues, exact, quantised


def some_values(seed: int, size: float) -> np.ndarray:
    rng = np.random.default_rng(seed)
    rows = rng.normal(0.0, size, (7, 3, 1)) + rng.normal(0.0, rng.choice([0.0, 1e-3, 1.0, size]), (7, 3, 12))
    return rows.astype(np.float32)


@given(st.integers(0, 2**32 - 1), st.sampled_from([1e-3, 1.0, 50.0, 1e6]))
def test_values_come_back_within_half_a_step(seed, size):
    values = some_values(seed, size)
    kept = quantised(values)
    # beside half a step, a rounding of the result and of the step itself
    rounding = 2.0 * np.spacing(np.abs(values).max(axis=-1, keepdims=True).astype(np.float32)) + 1e-7 * np.ptp(values)
    assert (np.abs(kept.values - values.astype(np.float64)) <= 0.5 * kept.step[..., None] + rounding).all()
    assert kept.values.dtype == np.float32


def test_rows_that_are_alike_stay_alike_and_even_rows_stay_exact():
    values = some_values(0, 30.0)
    values[3] = values[0]
    values[4, 1] = 7.3
    kept = quantised(values).values
    np.testing.assert_array_equal(kept[3], kept[0])
    np.testing.assert_array_equal(kept[4, 1], values[4, 1])


def test_order_along_a_row_is_kept():
    values = np.sort(some_values(1, 10.0), axis=-1)
    assert (np.diff(quantised(values).values, axis=-1) >= 0.0).all()


def test_coding_again_what_was_coded_changes_nothing_to_speak_of():
    once = quantised(some_values(2, 20.0))
    np.testing.assert_allclose(quantised(once.values).values, once.values, atol=float(once.step.max()) / 4)


def test_a_row_of_36_headings_takes_little_more_than_half():
    values = np.random.default_rng(0).random((100, 4, 36), np.float32)
    assert quantised(values).nbytes < 0.56 * values.nbytes


def test_exact_values_are_kept_as_they_are():
    values = some_values(3, 20.0)
    np.testing.assert_array_equal(exact(values).values, values)
    kept = exact(values)
    np.testing.assert_array_equal(kept.low[..., None] + kept.step[..., None] * kept.codes, values)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"codes": np.zeros((7, 3, 12))}, "codes are float64, expected float32 or uint16"),
        ({"codes": np.zeros((7, 3, 11), np.uint16)}, r"values has shape \(7, 3, 11\)"),
        ({"low": np.zeros((7, 2), np.float32)}, r"low has shape \(7, 2\), expected \(7, 3\)"),
        ({"step": np.full((7, 3), np.nan, np.float32)}, "step.*nan"),
        ({"codes": np.full((7, 3, 12), np.inf, np.float32)}, "values.*inf"),
    ],
)
def test_what_does_not_fit_is_refused(change, said):
    kept: CodedValues = quantised(some_values(4, 1.0))
    with pytest.raises(InputError, match=said):
        kept._replace(**change).checked(3, 12, "table")
