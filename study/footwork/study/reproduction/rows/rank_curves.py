"""Costs by rank, and where their knee is."""

from collections.abc import Mapping
from typing import Any

from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.charts import STANDARD, WELL, Axis, Series, line_charts
from footwork.study.reproduction.compared_metrics import (
    METRICS,
    RESAMPLED,
    MetricSet,
    none_there,
    ranking_of,
    sets_of,
)
from footwork.study.reproduction.full_rate_bench import COMPARED, at_full_rate, full_rate
from footwork.study.reproduction.row import (
    OURS,
    PUBLISHED,
    Cause,
    Cell,
    Column,
    Figure,
    Judgement,
    Result,
    Row,
    Table,
    judged,
)
from footwork.study.reproduction.words import joined_words
from footwork.study.reproduction.workbench import Workbench
from footwork.study.transition_picks import Ranking

CLAIM = "The metrics have their knees at about the same rank"
SHOWN = 160  # ranks
NEAR = 0.2  # knees within this share of the largest are about equal
FULL = "fighting, one sequence, every frame of the capture"
COLOURS = {"uniform": STANDARD, "dynamics": WELL, "torso": "ink", "joints": "faint"}
Rankings = Mapping[str, Ranking]


def run(bench: Workbench) -> Result:
    """Rank curves and knees of all metrics."""
    sets = sets_of(bench)
    if not sets:
        return none_there(f"{CLAIM}.")
    found: dict[str, tuple[Rankings, MetricSet]] = {
        one.name: ({name: ranking_of(bench, one, name) for name in METRICS}, one) for one in sets
    }
    capture = full_rate(bench)
    if capture is not None:
        found[FULL] = {name: at_full_rate(bench, capture, name)[0] for name in COMPARED}, sets[0]
    columns = [Column("set"), Column("metric"), Column("knee", "", PUBLISHED), Column("knee", "", OURS)]
    columns += [Column("Kneedle", "", OURS), Column("broken stick", "", OURS), Column("of ranks", "", OURS)]
    columns += [Column("threshold s", "", OURS), Column("in medians", "", OURS, 3), Column("median s", "", OURS)]
    lines: list[list[Cell]] = [
        [where, name, one.count, *_line(ranking)]
        for where, (ranked, one) in found.items()
        for name, ranking in ranked.items()
    ]
    return Result(
        judgements=[_judged(where, ranked) for where, (ranked, _) in found.items()],
        tables=[Table("Knees of the rank-ordered costs", columns, lines)],
        figures=[_figure(where, ranked) for where, (ranked, _) in found.items()],
        numbers={
            where: {name: _numbers(ranking) for name, ranking in ranked.items()} for where, (ranked, _) in found.items()
        },
        notes=[
            "Local minima of the matrix from the cheapest on, without those within 0.25 s of a cheaper one in both "
            "frames. Knee: the smaller rank of Kneedle and of two joined straight lines, over the first ranks, a tenth "
            "as many as there are frames at 30 Hz.",
            "A threshold of the dynamics metric takes in fewer medians than one of the others at the same rank: its "
            "best places stand out more.",
            RESAMPLED,
        ],
    )


def _line(ranking: Ranking) -> list[Cell]:
    knee = ranking.knee
    if knee is None:
        return [None, None, None, len(ranking.ranked.i), None, None, ranking.median]
    ranks: list[Cell] = [knee.rank, knee.kneedle, knee.broken_stick, len(knee.costs)]
    return [*ranks, knee.threshold, knee.threshold / ranking.median, ranking.median]


def _numbers(ranking: Ranking) -> dict[str, Any]:
    names = ("knee", "kneedle", "broken_stick", "ranks", "threshold", "threshold_in_medians", "median")
    curve = (ranking.ranked.cost / ranking.median)[:SHOWN]
    return {**dict(zip(names, _line(ranking), strict=True)), "curve": [round(float(cost), 5) for cost in curve]}


def _judged(where: str, ranked: Rankings) -> Judgement:
    knees = {name: ranked[name].knee_rank for name in COMPARED}
    spread = 1.0 - min(knees.values()) / max(knees.values())
    words = joined_words([f"{name} {rank}" for name, rank in knees.items()])
    reason = f"{words}: {100 * spread:.0f} % apart."
    return judged(f"{CLAIM} ({where}).", spread <= NEAR, reason.capitalize(), Cause.CONVENTION)


def _figure(where: str, ranked: Rankings) -> Figure:
    series = []
    for name, ranking in ranked.items():
        curve = (ranking.ranked.cost / ranking.median)[:SHOWN]
        series.append(Series(name, range(1, len(curve) + 1), curve, COLOURS[name], marks=False))
        rank = ranking.knee_rank
        if ranking.knee and rank <= len(curve):
            series.append(Series("its knee", [rank], [curve[rank - 1]], COLOURS[name]))
    return Figure(
        caption=f"{where.capitalize()}: costs by rank, in medians of all pairs of frames.",
        alt=f"Rank-ordered costs of {where} by metric, with knees",
        svg=line_charts([("", series, Axis("rank"), Axis("cost, medians", limits=(0, None)))], height=2.7),
    )


ROW = Row(
    name="M-F4",
    order=40,
    paper=matsunaga_zordan.PAPER,
    place="Figure 4",
    title="Costs by rank and their knee",
    claim="Costs by rank rise steeply and then flatten at about the same rank for all metrics: at 67 in the fighting, "
    "at 30 in the reactions.",
    published=matsunaga_zordan.KNEES,
    run=run,
)
