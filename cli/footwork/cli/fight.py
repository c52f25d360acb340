"""``footwork fight``: two AI fighters, or a league of them, without a window."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from footwork.cli.output import emit, progress
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time it is imported where it is needed, so that --help loads no numerics
    from footwork.controllers.fighting_style import FightingStyle
    from footwork.controllers.shadowing import TableShadowing
    from footwork.runtime.match import FightGround, Match
    from footwork.runtime.match_rules import MatchRules

Off = Parameter(negative=())
_TICKS = 30
_LONGEST = 36_000.0
_MOST_MATCHES = 1_000_000
_SLIDE_SECONDS = 120.0
_DECISIONS = 2000


def fight(
    bundle: Path,
    /,
    *,
    seconds: float = 60.0,
    seed: int = 0,
    styles: str = "balanced,balanced",
    config: Path | None = None,
    shadow: Literal["table", "rule"] = "table",
    matches: int = 1,
    league: Annotated[bool, Off] = False,
    workers: int | None = None,
    record: Path | None = None,
    json: Annotated[bool, Off] = False,
) -> None:
    """Let two AI fighters fight, and say how it went; the same seed gives the same fight.

    Example: footwork fight fighters.footwork --seconds 120 --styles aggressive,evasive --json

    Args:
        bundle: A bundle built with --graph annotated, of a machine with the states attack and evade.
        seconds: How long each match takes.
        seed: Where fighters begin and what they make of chance; further matches take the seeds after it.
        styles: Two of balanced, aggressive, patient, evasive and those of --config; with --league two or more.
        config: Styles and rules of your own (TOML).
        shadow: Keep distance and facing by the bundle's table, where it has one, or by the rule.
        matches: How many matches; of more than one only the outcome is told.
        league: Let every style fight every other, so many matches each.
        workers: How many matches run at once; as many as there are processors where not given.
        record: Write a recording that `footwork replay` makes again.
        json: Print what came of it as one JSON object.
    """
    from footwork.controllers.fighting_style import style_named
    from footwork.motion.bundle import read_bundle
    from footwork.runtime.fight_config import read_fight_config
    from footwork.runtime.fight_recording import record_fight
    from footwork.runtime.match import Match, fight_ground, table_of

    _require_range("--seconds", seconds, 1.0 / _TICKS, _LONGEST)
    _require_range("--matches", matches, 1, _MOST_MATCHES)
    _require_range("--workers", 1 if workers is None else workers, 1, 1024)
    _require_range("--seed", seed, 0, 2**32)
    settings = read_fight_config(config)
    names = [name.strip() for name in styles.split(",")]
    many = league or matches > 1
    _require_names(names, league)
    if many and record is not None:
        raise InputError("one match alone can be recorded, expected neither --matches nor --league", "--record")
    chosen = {name: style_named(name, settings.styles) for name in names}
    ground = fight_ground(read_bundle(bundle))
    table = table_of(ground.bundle) if shadow == "table" else None
    if many:
        report = _league(ground, chosen, names, seed, seconds, matches, settings.rules, table, workers)
        emit(report, json, f"{bundle}")
        return

    def match() -> Match:
        return Match(ground, [chosen[name] for name in names], seed, rules=settings.rules, shadowing=table)

    if record is not None:
        record_fight(match(), round(seconds * _TICKS), record)
    emit(_one(match, names, seed, round(seconds * _TICKS)), json, f"{bundle}")


def _one(match: Any, names: list[str], seed: int, ticks: int) -> dict[str, Any]:
    """The report of one match; poses and decisions are looked at in matches of the same seed beside it."""
    from footwork.study.decision_pace import decision_pace
    from footwork.study.fight_report import counts_report, slide_report, timed

    with progress() as tell:
        tell("fighting", 0.1)
        bout = match()
        watched, wall = timed(bout, ticks)
        tell("looking at feet", 0.5)
        slide = slide_report(match(), min(ticks, round(_SLIDE_SECONDS * _TICKS)))
        tell("timing decisions", 0.8)
        decisions = decision_pace(match(), min(_DECISIONS, ticks))
    return {
        "seconds": ticks / _TICKS,
        "wall_s": wall,
        "ticks_per_second": ticks / wall,
        "times_real_time": ticks / _TICKS / wall,
        "decision_us": decisions,
        "styles": names,
        "seed": seed,
        **counts_report(bout),
        **watched.report(),
        **slide,
        "digest": bout.digest(),
    }


def _league(
    ground: FightGround,
    styles: dict[str, FightingStyle],
    names: list[str],
    seed: int,
    seconds: float,
    matches: int,
    rules: MatchRules,
    table: TableShadowing | None,
    workers: int | None,
) -> dict[str, Any]:
    """What came of many matches: the table, and how many are made in an hour."""
    from footwork.runtime.match import Match
    from footwork.study.league import Bout, bouts_of, outcomes, standings

    pair = len(names) == 2 and names[0] == names[1]
    bouts = [Bout(names[0], names[1], seed + n) for n in range(matches)] if pair else bouts_of(names, matches, seed)
    ticks, hands = round(seconds * _TICKS), workers or os.cpu_count() or 1
    Match(ground, [styles[name] for name in names[:2]], rules=rules, shadowing=table).play(0)  # compiles
    start, results = time.perf_counter(), []
    with progress() as tell:
        run = outcomes(ground, styles, bouts, ticks, rules=rules, shadowing=table, workers=hands)
        for number, outcome in enumerate(run, 1):
            results.append(outcome)
            tell("fighting", number / len(bouts))
    wall = time.perf_counter() - start
    return {
        "matches": len(bouts),
        "seconds": seconds,
        "workers": hands,
        "wall_s": wall,
        "matches_per_hour": 3600.0 * len(bouts) / wall,
        "times_real_time": len(bouts) * seconds / wall,
        "seed": seed,
        "table": standings(list(dict.fromkeys(names)), results),
    }


def _require_names(names: list[str], league: bool) -> None:
    if league and (len(names) < 2 or len(set(names)) < len(names)):
        raise InputError(f"{', '.join(names)}, expected two different styles or more for a league", "--styles")
    if not league and len(names) != 2:
        raise InputError(f"{len(names)} styles, expected two, such as aggressive,patient", "--styles")


def _require_range(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise InputError(f"{value:g}, expected {low:g} to {high:g}", name)
