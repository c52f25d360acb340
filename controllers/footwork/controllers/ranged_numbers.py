"""Dataclasses of numbers that a person may set, each with the range that makes sense."""

from dataclasses import field, fields
from typing import Any, TypeVar

from footwork.errors import InputError
from footwork.motion.toml_file import shown

Kind = TypeVar("Kind")


def within(usual: float, low: float, high: float) -> Any:
    """A field with a default and a range."""
    return field(default=usual, metadata={"low": low, "high": high})


def ranged_names(kind: type) -> list[str]:
    """The fields of a dataclass that have a range."""
    return [one.name for one in fields(kind) if "low" in one.metadata]


def numbers_of(ranged: Any) -> dict[str, float]:
    """The numbers of a dataclass that have a range, by name."""
    return {name: float(getattr(ranged, name)) for name in ranged_names(type(ranged))}


def of_numbers(kind: type[Kind], numbers: dict[str, float], where: str) -> Kind:
    """The dataclass of ``numbers_of``.

    Raises:
        InputError: for other names than it has, and numbers out of range.
    """
    if sorted(numbers) != sorted(ranged_names(kind)):
        raise InputError(f"damaged: the numbers of a {kind.__name__} are not those it has", where)
    return kind(**numbers | {"where": where})


def require_ranges(numbers: Any, where: str) -> None:
    """Raise InputError, naming the first of a dataclass's numbers that is out of its range, and the range."""
    for one in fields(numbers):
        if "low" in one.metadata:
            _require(one.name, getattr(numbers, one.name), one.metadata["low"], one.metadata["high"], where)


def _require(name: str, value: Any, low: float, high: float, where: str) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (number and low <= value <= high):
        raise InputError(f"{name} is {shown(value)}, expected a number from {low:g} to {high:g}", where)
