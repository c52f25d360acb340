import numpy as np
import pytest

from footwork.training import path_cost
from footwork.training.path_cost import ROUGHNESS, UNIT, path_costs


def test_the_cost_is_one_frame_and_five_times_what_the_smoothness_lacks():
    s = np.array([0.0, 0.1, 0.2, 1.0, 5.0])
    expected = [round(UNIT * (1 + 5 * (1 - 2.718281828459045 ** (-x / 2.0)))) for x in s]
    assert path_costs(s, 2.0).tolist() == expected


@pytest.mark.parametrize("sigma", [0.1, 1.0, 10.0])
def test_costs_grow_with_the_distance_and_stay_within_their_bounds(sigma):
    costs = path_costs(np.linspace(0.0, 100.0, 500), sigma)
    assert np.all(np.diff(costs) >= 0)
    assert costs[0] == UNIT
    assert costs[-1] <= (1 + ROUGHNESS) * UNIT


def test_a_long_table_is_worked_through_in_parts(monkeypatch):
    s = np.random.default_rng(0).random(1000)
    whole = path_costs(s, 1.0)
    monkeypatch.setattr(path_cost, "_PART", 7)
    np.testing.assert_array_equal(path_costs(s, 1.0), whole)
