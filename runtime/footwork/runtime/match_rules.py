"""The rules of a match: bodies, hits, strength and rounds, read from TOML (conventions.md 13)::

[match]
round_seconds = 90
"""

from dataclasses import dataclass, field
from typing import Any, NamedTuple

from footwork.controllers.ranged_numbers import ranged_names, require_ranges, within
from footwork.errors import InputError
from footwork.motion.tick import TICK_RATE
from footwork.motion.toml_file import only_keys, shown


@dataclass(frozen=True)
class MatchRules:
    """What holds for both fighters. Metres and seconds.

    Args:
        round_seconds: after which a round ends.
        apart: how far hips keep from one another over the ground.
        push: how fast bodies that are nearer are pushed apart, metres a second each at most.
        limb: the radius of fist and foot.
        damage: how much of its health a strike of ``full_speed`` takes from the one who is hit.
        full_speed: from which on a strike takes no more, m/s.
        recovery: stamina that comes back in a second.
        start: how far apart fighters begin.

    Raises:
        InputError: for a number out of range, naming it and the range.
    """

    round_seconds: float = within(60.0, 1.0, 3600.0)
    apart: float = within(0.7, 0.0, 1.0)
    push: float = within(1.2, 0.0, 3.0)
    limb: float = within(0.07, 0.0, 0.2)
    damage: float = within(0.1, 0.0, 1.0)
    full_speed: float = within(5.0, 0.5, 20.0)
    recovery: float = within(0.06, 0.0, 1.0)
    start: float = within(2.0, 0.5, 10.0)
    where: str = field(default="match", compare=False)

    def __post_init__(self) -> None:
        require_ranges(self, self.where)


class Rules(NamedTuple):
    """The rules as kernels take them: times in ticks."""

    round_ticks: int
    apart: float
    push: float
    limb: float
    damage: float
    full_speed: float
    recovery: float


def rules_for_kernels(rules: MatchRules) -> Rules:
    """The numbers of rules as kernels take them."""
    return Rules(
        round(rules.round_seconds * TICK_RATE),
        rules.apart,
        rules.push / TICK_RATE,
        rules.limb,
        rules.damage,
        rules.full_speed,
        rules.recovery / TICK_RATE,
    )


def rules_in(values: dict[str, Any], where: str) -> MatchRules:
    """The rules of the table under ``match``, as usual where it says nothing.

    Raises:
        InputError: for what is no table, unknown keys and numbers out of range.
    """
    table = values.get("match", {})
    if not isinstance(table, dict):
        raise InputError(f"match is {shown(table)}, expected a table [match]", where)
    only_keys(table, ranged_names(MatchRules), f"{where}: match")
    return MatchRules(**table, where=f"{where}: match")
