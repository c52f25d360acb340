"""Bundles as the command line names them."""

from pathlib import Path

import pytest

from footwork.cli.named_bundles import named_bundles
from footwork.errors import InputError


@pytest.mark.parametrize(
    ("text", "name", "path"),
    [
        ("some/walker.footwork", "walker", "some/walker.footwork"),
        ("slow=some/walker.footwork", "slow", "some/walker.footwork"),
        ("./a=b.footwork", "a_b", "./a=b.footwork"),
        ("two words (1).footwork", "two_words__1_", "two words (1).footwork"),
        ("x" * 70 + ".footwork", "x" * 64, "x" * 70 + ".footwork"),
        ("slow=", "slow_", "slow="),
    ],
)
def test_a_file_has_its_own_name_or_the_one_it_is_given(text, name, path):
    assert named_bundles([text]) == {name: Path(path)}


def test_the_first_stays_the_first():
    assert list(named_bundles(["b.footwork", "a.footwork", "c=b.footwork"])) == ["b", "a", "c"]


def test_none_and_two_of_one_name_are_refused():
    with pytest.raises(InputError, match="expected the file of at least one"):
        named_bundles([])
    with pytest.raises(InputError, match="both called a, expected NAME=FILE"):
        named_bundles(["x/a.footwork", "y/a.footwork"])
