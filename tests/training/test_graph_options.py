"""What may be asked of a build."""

import math

import pytest

from footwork.errors import InputError
from footwork.training.graph_options import GraphOptions


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("threshold", 0.0),
        ("threshold", -1.0),
        ("threshold", math.inf),
        ("threshold", math.nan),
        ("mu", 0.99),
        ("mu", math.nan),
        ("mu", math.inf),
        ("weights", 0),
        ("weights", 100),
        ("graph", "best"),
        ("metric", "taxicab"),
        ("pairing", "all"),
        ("order", "sideways"),
    ],
)
def test_what_is_out_of_range_is_refused_by_name(option, value):
    with pytest.raises(InputError, match=f"--{option}: "):
        GraphOptions(**{option: value})


def test_a_standard_graph_records_nothing_of_the_well_connected_one():
    expected = {"graph": "standard", "threshold": 1.0, "metric": "uniform", "mirror": False, "bridges": 0}
    assert GraphOptions().record() == expected


@pytest.mark.parametrize(
    "given", [{"mu": 3.0}, {"weights": 4}, {"pairing": "plain"}, {"order": "random"}, {"mu": 1.0, "order": "reverse"}]
)
def test_options_of_the_well_connected_graph_are_refused_for_a_standard_one(given):
    named = ", ".join(f"--{name}" for name in given)
    with pytest.raises(InputError, match=rf"^{named}: a standard graph has no such option, .*--graph well-connected$"):
        GraphOptions(**given)
    assert GraphOptions(graph="well-connected", **given).record().items() >= given.items()


def test_an_unknown_name_is_met_by_those_there_are():
    with pytest.raises(
        InputError, match=r"^--graph: no graph 'foo', expected one of standard, well-connected, annotated$"
    ):
        GraphOptions(graph="foo")


def test_a_threshold_left_to_the_data_is_no_number_yet():
    with pytest.raises(ValueError, match="auto"):
        GraphOptions(threshold="auto").number  # noqa: B018
