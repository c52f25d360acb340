"""Fighting styles as configuration: defaults, files, and what is out of range."""

import math

import pytest

from footwork.controllers.fighting_style import STYLE, STYLES, FightingStyle, style_named, styles_for_kernels, styles_in
from footwork.errors import InputError


def test_a_file_adds_styles_and_leaves_the_other_numbers_as_usual():
    styles = styles_in({"styles": {"careful": {"distance": 1.6, "eagerness": 0.2}}}, "fight.toml")
    assert styles["careful"] == FightingStyle(distance=1.6, eagerness=0.2)
    assert set(STYLES) < set(styles)


def test_kernels_get_radians_and_ticks():
    records = styles_for_kernels([FightingStyle(), FightingStyle(turn=6.0, horizon=2.0)])
    assert records.dtype == STYLE
    assert records["turn"][1] == pytest.approx(math.radians(6.0))
    assert records["horizon"].tolist() == [45.0, 60.0]


@pytest.mark.parametrize(
    ("table", "problem"),
    [
        ({"reach": 2.0}, "reach is 2.0, expected a number from 0 to 0.5"),
        ({"eagerness": "much"}, "eagerness is 'much', expected a number from 0 to 1"),
        ({"eagerness": True}, "eagerness is True, expected a number from 0 to 1"),
        ({"turn": float("nan")}, "turn is nan, expected a number from 0 to 6"),
        ({"courage": 1.0}, "unknown key 'courage', expected distance"),
        (3, "3, expected a table"),
    ],
)
def test_what_is_out_of_range_is_refused_with_its_place_and_range(table, problem):
    with pytest.raises(InputError, match=problem) as told:
        styles_in({"styles": {"mine": table}}, "fight.toml")
    assert "fight.toml: styles.mine" in str(told.value)


def test_an_unknown_style_is_refused_with_those_there_are():
    with pytest.raises(InputError, match="no style 'drunken', expected balanced, aggressive"):
        style_named("drunken", STYLES)


def test_styles_must_be_tables():
    with pytest.raises(InputError, match="styles is 3, expected tables"):
        styles_in({"styles": 3}, "fight.toml")
