"""Configuration of fights: styles and rules in one TOML file."""

from dataclasses import dataclass, field
from pathlib import Path

from footwork.controllers.fighting_style import STYLES, FightingStyle, styles_in
from footwork.motion.toml_file import only_keys, read_toml
from footwork.runtime.match_rules import MatchRules, rules_in


@dataclass(frozen=True)
class FightConfig:
    """Styles by name, the usual ones among them, and the rules of a match."""

    styles: dict[str, FightingStyle] = field(default_factory=lambda: dict(STYLES))
    rules: MatchRules = field(default_factory=MatchRules)


def read_fight_config(path: str | Path | None) -> FightConfig:
    """The configuration of a file, or the usual one without any.

    Raises:
        InputError: for a file that cannot be read or is no TOML, unknown keys, and numbers out of range.
    """
    if path is None:
        return FightConfig()
    where = str(path)
    values = read_toml(Path(path), "styles and rules of a fight")
    only_keys(values, ("styles", "match"), where)
    return FightConfig(styles_in(values, where), rules_in(values, where))
