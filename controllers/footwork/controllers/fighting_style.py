"""Fighting styles: the numbers in the rules by which fighters decide, read from TOML (conventions.md 13).

A file has a table for each style, with any of its numbers; the others are as usual::

    [styles.careful]
    distance = 1.6
    eagerness = 0.2
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.ranged_numbers import ranged_names, require_ranges, within
from footwork.errors import InputError
from footwork.motion.tick import TICK_RATE
from footwork.motion.toml_file import only_keys, shown


@dataclass(frozen=True)
class FightingStyle:
    """How a fighter decides. Metres, seconds, degrees.

    Args:
        distance: what shadowing keeps to the opponent.
        distance_scale: an error in it that weighs as much as ``facing_scale``.
        facing_scale: an error in facing the opponent that weighs as much, degrees.
        roam: the chance at each decision to shadow along any way, lest fighters settle down opposite each other.
        turn: how far shadowing and aiming turn the body beyond its capture, degrees a tick at most.
        reach: how far from the surface of a target a strike may be predicted to end and still be thrown.
        lunge: how far aiming carries a strike beyond its capture, metres a second at most.
        horizon: how soon a strike must make contact to be thrown.
        eagerness: the chance at each decision that a strike which may be thrown is.
        attack_cost: stamina that an attack takes.
        rest: segments of footwork between two attacks.
        near: an opponent nearer than this is evaded.
        warning: how soon an opponent's strike must be predicted to land to be evaded.
        readiness: the chance at each decision that what may be evaded is.
        evade_cost: stamina that an evasion takes.
        variety: how much worse than the best a choice may be taken by chance: metres, or as much of shadowing's error.

    Raises:
        InputError: for a number out of range, naming it and the range.
    """

    distance: float = within(1.2, 0.6, 5.0)
    distance_scale: float = within(0.3, 0.01, 5.0)
    facing_scale: float = within(30.0, 1.0, 180.0)
    roam: float = within(0.1, 0.0, 1.0)
    turn: float = within(3.0, 0.0, 6.0)
    reach: float = within(0.15, 0.0, 0.5)
    lunge: float = within(0.3, 0.0, 1.0)
    horizon: float = within(1.5, 0.2, 3.0)
    eagerness: float = within(0.5, 0.0, 1.0)
    attack_cost: float = within(0.2, 0.0, 1.0)
    rest: float = within(1.0, 0.0, 1000.0)
    near: float = within(0.6, 0.0, 3.0)
    warning: float = within(1.0, 0.0, 3.0)
    readiness: float = within(0.5, 0.0, 1.0)
    evade_cost: float = within(0.1, 0.0, 1.0)
    variety: float = within(0.05, 0.0, 1.0)
    where: str = field(default="style", compare=False)

    def __post_init__(self) -> None:
        require_ranges(self, self.where)


STYLES = {
    "balanced": FightingStyle(),
    "aggressive": FightingStyle(distance=1.0, eagerness=1.0, readiness=0.15, near=0.5, attack_cost=0.15),
    "patient": FightingStyle(distance=1.5, eagerness=0.3, readiness=0.8, horizon=1.2),
    "evasive": FightingStyle(distance=1.7, readiness=1.0, near=0.8, evade_cost=0.05),
}
"""The styles that need no file, by name."""


STYLE = np.dtype([(name, "f8") for name in ranged_names(FightingStyle)])
"""The numbers of a style for kernels: angles in radians and times in ticks."""
_FACTORS = {
    "facing_scale": math.pi / 180.0,
    "turn": math.pi / 180.0,
    "lunge": 1.0 / TICK_RATE,
    "horizon": float(TICK_RATE),
    "warning": float(TICK_RATE),
}


def styles_for_kernels(styles: Sequence[FightingStyle]) -> NDArray[np.void]:
    """The numbers of styles as kernels take them.  # (n,) STYLE"""
    records = np.zeros(len(styles), dtype=STYLE)
    for name in STYLE.names or ():
        records[name] = [getattr(style, name) * _FACTORS.get(name, 1.0) for style in styles]
    records.flags.writeable = False
    return records


def styles_in(values: dict[str, Any], where: str) -> dict[str, FightingStyle]:
    """STYLES and those of the tables under ``styles``, by name.

    Raises:
        InputError: for what is no table, unknown keys and numbers that are missing their range.
    """
    tables = values.get("styles", {})
    if not isinstance(tables, dict):
        raise InputError(f"styles is {shown(tables)}, expected tables [styles.NAME]", where)
    return STYLES | {name: _style(table, f"{where}: styles.{name}") for name, table in tables.items()}


def _style(table: Any, where: str) -> FightingStyle:
    if not isinstance(table, dict):
        raise InputError(f"{shown(table)}, expected a table", where)
    only_keys(table, ranged_names(FightingStyle), where)
    return FightingStyle(**table, where=where)


def style_named(name: str, styles: dict[str, FightingStyle]) -> FightingStyle:
    """One of the styles.

    Raises:
        InputError: for a name that is none of theirs, listing them.
    """
    if name not in styles:
        raise InputError(f"no style {name!r}, expected {', '.join(styles)}", "styles")
    return styles[name]
