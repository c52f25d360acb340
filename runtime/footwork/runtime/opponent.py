"""Who fights the characters of players: styles, rules and a seed."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from footwork.controllers.fighting_style import STYLES, FightingStyle, style_named
from footwork.controllers.ranged_numbers import numbers_of, of_numbers
from footwork.runtime import recording as r
from footwork.runtime.fight_config import read_fight_config
from footwork.runtime.match_rules import MatchRules

PLAYER = "player"
"""The style whose numbers hold for those whom players steer, where a configuration has it."""
_STEERED = replace(STYLES["balanced"], rest=0.0, variety=0.0)


@dataclass(frozen=True)
class Opponent:
    """What all opponents in an arena are.

    Args:
        name: of the style, for people.
        style: by which they decide.
        player: the numbers of those whom they fight: what actions cost, and how far aiming helps.
        rules: of their matches.
        seed: of where they begin and what they make of chance.
        table: whether they keep distance by the bundle's table, where it has one, or by the rule.
    """

    name: str
    style: FightingStyle
    player: FightingStyle = _STEERED
    rules: MatchRules = field(default_factory=MatchRules)
    seed: int = 0
    table: bool = True

    def record(self, tick: int) -> r.Opposed:
        """What a recording says of them."""
        styles = numbers_of(self.player), numbers_of(self.style)
        return r.Opposed(tick, self.name, styles, numbers_of(self.rules), self.seed, self.table)


def opponent_named(name: str, config: str | Path | None = None, seed: int = 0) -> Opponent:
    """Opponents of a style.

    Args:
        name: of the style.
        config: a file with styles and rules.
        seed: of chance.

    Raises:
        InputError: for a style that there is not, and a configuration that is none.
    """
    settings = read_fight_config(config)
    style, player = style_named(name, settings.styles), settings.styles.get(PLAYER, _STEERED)
    return Opponent(name, style, player, settings.rules, seed)


def recorded_opponent(record: r.Opposed, where: str) -> Opponent:
    """The opponents of a recording.

    Raises:
        InputError: for numbers that no style or rule can have.
    """
    player, style = (of_numbers(FightingStyle, numbers, where) for numbers in record.styles)
    rules = of_numbers(MatchRules, record.rules, where)
    return Opponent(record.name, style, player, rules, record.seed, record.table)
