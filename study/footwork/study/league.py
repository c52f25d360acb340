"""Leagues: many matches between styles, on all cores, and what came of them."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from footwork.controllers.fighting_style import FightingStyle
from footwork.controllers.shadowing import TableShadowing
from footwork.runtime.match import FightGround, Match
from footwork.runtime.match_rules import MatchRules


@dataclass(frozen=True)
class Bout:
    """A match to be: the names of two styles, and a seed."""

    first: str
    second: str
    seed: int


@dataclass(frozen=True)
class Outcome:
    """What came of it: who won, 0 or 1, None for neither; hits and damage of each."""

    bout: Bout
    winner: int | None
    hits: tuple[int, int]
    dealt: tuple[float, float]


def bouts_of(names: Sequence[str], matches: int, seed: int) -> list[Bout]:
    """So many matches of every pair of styles, each style first in every other one; seeds from ``seed`` on."""
    pairs = [pair for _ in range(matches) for pair in combinations(names, 2)]
    turned = ((pair, number // max(len(pairs) // matches, 1) % 2) for number, pair in enumerate(pairs))
    return [Bout(pair[other], pair[1 - other], seed + number) for number, (pair, other) in enumerate(turned)]


def outcomes(
    ground: FightGround,
    styles: dict[str, FightingStyle],
    bouts: Sequence[Bout],
    ticks: int,
    *,
    rules: MatchRules,
    shadowing: TableShadowing | None = None,
    workers: int = 1,
) -> Iterator[Outcome]:
    """Fight matches out, in their order; the same however many workers there are.

    Args:
        ground: of the bundle.
        styles: by name.
        bouts: which.
        ticks: of each.
        rules: of all.
        shadowing: a table to shadow by, in place of the rule.
        workers: threads; ticks are made outside Python's lock.
    """

    def fought(bout: Bout) -> Outcome:
        match = Match(ground, [styles[bout.first], styles[bout.second]], bout.seed, rules=rules, shadowing=shadowing)
        match.play(ticks)
        of = match.tally.of
        hits, dealt = of["hits"].tolist(), of["dealt"].tolist()
        return Outcome(bout, match.winner, (hits[0], hits[1]), (dealt[0], dealt[1]))

    with ThreadPoolExecutor(workers) as pool:
        yield from pool.map(fought, bouts)


def standings(names: Sequence[str], results: Sequence[Outcome]) -> list[dict[str, Any]]:
    """JSON-able: of each style matches, wins, losses, draws, points (a win 1, a draw half), hits given and taken.

    In order of the share of points, then of the names as given.
    """
    rows = {name: dict.fromkeys(("matches", "won", "lost", "drawn", "hits", "hits_taken"), 0) for name in names}
    for result in results:
        for who, name in enumerate((result.bout.first, result.bout.second)):
            row = rows[name]
            row["matches"] += 1
            row["drawn" if result.winner is None else "won" if result.winner == who else "lost"] += 1
            row["hits"] += result.hits[who]
            row["hits_taken"] += result.hits[1 - who]
    table = [{"style": name} | row | {"points": row["won"] + 0.5 * row["drawn"]} for name, row in rows.items()]
    return sorted(table, key=lambda row: -row["points"] / max(row["matches"], 1))
