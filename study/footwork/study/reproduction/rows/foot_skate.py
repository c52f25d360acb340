"""How much feet skate in the transitions that each metric chooses."""

from collections.abc import Mapping
from typing import Any

from footwork.study.bootstrap import Estimate
from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.compared_metrics import (
    ALIGNED,
    FIGHTS,
    INTERVALS,
    MAIN,
    METRICS,
    ONE_SOURCE,
    RESAMPLED,
    RIVALS,
    WALKING,
    MetricSet,
    clips_of,
    none_there,
    ranking_of,
    sets_of,
    slide_of,
)
from footwork.study.reproduction.contact_phases import phase_lines, phase_table
from footwork.study.reproduction.full_rate_bench import COMPARED, at_full_rate, full_rate
from footwork.study.reproduction.row import OURS, Cause, Cell, Column, Judgement, Result, Row, Table, judged
from footwork.study.reproduction.slide_tables import Figures, gains_table, in_percent, main_table, other_table
from footwork.study.reproduction.workbench import Workbench
from footwork.study.slide_figures import figures_of, gains
from footwork.study.transition_picks import partners

CLAIM = "The dynamics metric's transitions skate less than those of both heuristics"
PRINTED = ("start to end", "arc length")
CROSSED = ("uniform", "dynamics")
Gains = Mapping[str, Estimate]


def run(bench: Workbench) -> Result:
    """Foot skate of the picks at each metric's knee, and of as many picks of each."""
    sets = sets_of(bench, [*MAIN, FIGHTS, ONE_SOURCE, WALKING])
    if not set(sets) - {WALKING}:
        return none_there(f"{CLAIM}.")
    won = {one: {other: _gains(bench, one, other) for other in RIVALS} for one in sets}
    tables = [table for one in sets for table in _tables(bench, one)]
    lines = [(one.name, other, gain) for one in sets for other, gain in won[one].items()]
    tables.append(gains_table("Dynamics less the heuristic, equal numbers of picks", lines))
    numbers: dict[str, Any] = {one.name: _numbers(bench, one, won[one]) for one in sets}
    numbers |= _at_full_rate(bench, tables)
    tables += [_phases(bench, one) for one in sets if one in MAIN]
    tables += [_crossed(bench, one) for one in sets if one in MAIN]
    return Result(
        judgements=[*(_judged(one, won[one]) for one in sets if one is not WALKING), _longer(bench, sets)]
        + [_walking(won[one]) for one in sets if one is WALKING],
        tables=tables,
        numbers=numbers,
        notes=[
            "Start to end and arc length: over the ground, of the ball of each foot while it stands in the source or "
            "in the target; the paper does not say which feet, when, or over the ground. The mean over transitions and "
            "feet. Their sources: the same feet in the same frames of the two captures blended, while they stand.",
            "Arc of both feet: the sum over a transition's feet. Slide in contact: of feet that stand in both. Skating "
            "ratio: steps with a foot under 5 cm at over 0.5 m/s. Weighted by height: speed times 2 - 2^(h / 2.5 cm).",
            "Why: the dynamics metric weighs feet that stand in either motion, so it joins frames at which the same "
            "feet stand, and lays planted feet onto each other; choosing the places does more of it than laying them.",
            "Measures without contacts follow the motion too: where their sources skate as much, as in all of the "
            "fighting, the blends have added nothing.",
            "H1 and H2 stand beside uniform weights and extra weight on the torso; the paper does not print its own.",
            ALIGNED,
            INTERVALS + " A transition and its near repeat in the other metric's list are drawn together.",
            RESAMPLED,
        ],
    )


def _figures(bench: Workbench, one: MetricSet, count: int | None) -> dict[str, Figures]:
    return bench.once(
        ("foot skate", one, count),
        lambda: {name: figures_of(slide_of(bench, one, name, count)) for name in METRICS},
    )


def _tables(bench: Workbench, one: MetricSet) -> list[Table]:
    """The set's tables: at each metric's knee, with as many picks of each, and the other figures of the latter."""
    knees = {name: ranking_of(bench, one, name).knee_rank for name in METRICS}
    alike = {name: len(ranking_of(bench, one, name).first(one.count).i) for name in METRICS}
    found = _figures(bench, one, one.count)
    up_to_knee = main_table(f"{one.name}: picks up to each metric's knee", _figures(bench, one, None), knees, one.like)
    return [
        *([up_to_knee] if one.like else []),
        main_table(f"{one.name}: equal numbers of picks", found, alike, one.like),
        other_table(f"{one.name}: other measures of the same", found),
    ]


def _gains(bench: Workbench, one: MetricSet, other: str) -> Gains:
    ours, theirs = (ranking_of(bench, one, name).first(one.count) for name in ("dynamics", other))
    slide, against = (slide_of(bench, one, name, one.count) for name in ("dynamics", other))
    return gains(slide, against, partners(ours, theirs))


def _judged(one: MetricSet, won: Mapping[str, Gains]) -> Judgement:
    highs = [gain[name].high for gain in won.values() for name in PRINTED]
    holds = all(high is not None and high < 0.0 for high in highs)
    words = [f"against {other} {in_percent(gain['arc length'])} % in arc length" for other, gain in won.items()]
    return judged(f"{CLAIM} ({one.name}).", holds, f"{'; '.join(words)}.".capitalize() + _theirs(one), Cause.DATA)


def _theirs(one: MetricSet) -> str:
    if not one.like:
        return ""
    lengths = matsunaga_zordan.ARC_LENGTH[one.like]
    words = [f"{100 * (lengths['dynamics'] / lengths[name] - 1):+.0f} %" for name in ("H1", "H2")]
    return f" Published: {words[0]} and {words[1]}."


def _longer(bench: Workbench, sets: list[MetricSet]) -> Judgement:
    """No way is shorter than the line between its ends."""
    ratios = []
    for one in sets:
        for figures in _figures(bench, one, one.count).values():
            straight, arc = (figures[name][0].value for name in PRINTED)
            if straight and arc:
                ratios.append(arc / straight)
    reason = f"{min(ratios):.2f} to {max(ratios):.2f} times as long; published 1.11 to 1.21."
    return judged("The arc length is never shorter than from start to end.", min(ratios) >= 1.0, reason)


def _walking(won: Mapping[str, Gains]) -> Judgement:
    gain = won["uniform"]["arc length"]
    holds = gain.low is not None and gain.high is not None and gain.low <= 0.0 <= gain.high
    reason = f"{in_percent(gain)} % in arc length against uniform weights."
    return judged("For walking there is no difference between the metrics.", holds, reason, Cause.CONVENTION)


def _at_full_rate(bench: Workbench, tables: list[Table]) -> dict[str, Any]:
    """The single sequence again with every captured frame; adds its table."""
    capture = full_rate(bench)
    if capture is None:
        return {}
    found = {name: at_full_rate(bench, capture, name) for name in COMPARED}
    figures = {name: figures_of(slide) for name, (_, slide) in found.items()}
    counts = {name: len(slide.skating) // 2 for name, (_, slide) in found.items()}
    where = "fighting, one sequence, every frame of the capture"
    tables.append(main_table(f"{where}: equal numbers of picks", figures, counts, MAIN[0].like))
    (ours, slide), (theirs, other) = found["dynamics"], found["uniform"]
    ours, theirs = (ranking.first(MAIN[0].count) for ranking in (ours, theirs))
    tables.append(
        gains_table(
            "The same, dynamics less uniform", [(where, "uniform", gains(slide, other, partners(ours, theirs)))]
        )
    )
    return {where: {name: _json(of) for name, of in figures.items()}}


def _phases(bench: Workbench, one: MetricSet) -> Table:
    found = {}
    for name in METRICS:
        picks = ranking_of(bench, one, name).first(one.count)
        found[name] = phase_lines(clips_of(bench, one), picks, slide_of(bench, one, name, one.count))
    return phase_table(f"{one.name}: what the feet do at the two frames of a pick", found)


def _crossed(bench: Workbench, one: MetricSet) -> Table:
    """What choosing and what laying a transition by the dynamics metric does."""
    columns = [Column("picked by"), Column("laid by")] + [Column(name, "cm", OURS) for name in PRINTED]
    lines: list[list[Cell]] = []
    for picked in CROSSED:
        for laid in CROSSED:
            figures = figures_of(slide_of(bench, one, picked, one.count, laid))
            lines.append([picked, laid, *(figures[name][0].words() for name in PRINTED)])
    return Table(f"{one.name}: picking or laying?", columns, lines)


def _numbers(bench: Workbench, one: MetricSet, won: Mapping[str, Gains]) -> dict[str, Any]:
    return {
        "at_knee": {name: _json(of) for name, of in _figures(bench, one, None).items()},
        "equal_numbers": {name: _json(of) for name, of in _figures(bench, one, one.count).items()},
        "picks": one.count,
        "gain_of_dynamics": {
            other: {name: estimate._asdict() for name, estimate in gain.items()} for other, gain in won.items()
        },
    }


def _json(figures: Figures) -> dict[str, Any]:
    return {name: {"blend": blend._asdict(), "sources": own._asdict()} for name, (blend, own) in figures.items()}


ROW = Row(
    name="M-T1",
    order=50,
    paper=matsunaga_zordan.PAPER,
    place="Table 1",
    title="Foot skate of the chosen transitions",
    claim="From start to end 9.0 cm against 12.2 and 12.8 cm of the heuristics in the fighting, 8.2 cm against 16.8 "
    "and 17.0 cm in the reactions; along the way 10.6 against 14.0 and 14.2 cm, 9.9 against 19.8 and 19.3 cm. For "
    "walking there is no difference.",
    published={"start_to_end_cm": matsunaga_zordan.START_TO_END, "arc_length_cm": matsunaga_zordan.ARC_LENGTH},
    run=run,
)
