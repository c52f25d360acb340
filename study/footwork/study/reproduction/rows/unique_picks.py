"""Which transitions the dynamics metric chooses that the heuristics do not."""

from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.compared_metrics import (
    RESAMPLED,
    RIVALS,
    MetricSet,
    none_there,
    ranking_of,
    sets_of,
)
from footwork.study.reproduction.row import (
    OURS,
    PUBLISHED,
    Cause,
    Cell,
    Column,
    Judgement,
    Result,
    Row,
    Table,
    judged,
)
from footwork.study.reproduction.workbench import Workbench
from footwork.study.transition_picks import partners
from footwork.training.knee import APART

CLAIM = "Some of the dynamics metric's transitions, but less than half, are found by it alone"
KNEE, ALIKE = "at each one's knee", "as many as the paper"
Counts = dict[str, int]


def run(bench: Workbench) -> Result:
    """Count the picks without a near one among those of the others."""
    sets = sets_of(bench)
    if not sets:
        return none_there(f"{CLAIM}.")
    found = {one: {KNEE: _counts(bench, one, None), ALIKE: _counts(bench, one, one.count)} for one in sets}
    columns = [Column("set"), Column("taken"), Column("picks", "", PUBLISHED), Column("unique", "", PUBLISHED)]
    columns += [Column("picks", "", OURS)] + [Column(f"not of {name}", "", OURS) for name in RIVALS]
    columns += [Column("of neither", "", OURS), Column("torso not of uniform", "", OURS)]
    lines: list[list[Cell]] = [
        [one.name, taken, *_published(one), *counts.values()] for one in sets for taken, counts in found[one].items()
    ]
    return Result(
        judgements=[_judged(one, found[one][ALIKE]) for one in sets],
        tables=[Table("Picks of the dynamics metric that the heuristics do not have", columns, lines)],
        numbers={one.name: found[one] for one in sets},
        notes=[
            f"Two picks are the same where both of their frames lie within {APART} frames, 0.25 s, of each other.",
            "The two heuristics agree with each other on nearly all picks: what differs is where feet stand.",
            RESAMPLED,
        ],
    )


def _published(one: MetricSet) -> list[Cell]:
    return [one.count, matsunaga_zordan.UNIQUE[one.like]]


def _counts(bench: Workbench, one: MetricSet, count: int | None) -> Counts:
    ranked = {name: ranking_of(bench, one, name) for name in (*RIVALS, "dynamics")}
    picks = {name: ranking.picks if count is None else ranking.first(count) for name, ranking in ranked.items()}
    alone = {name: partners(picks["dynamics"], picks[name]) < 0 for name in RIVALS}
    first, second = RIVALS
    return {
        "picks": len(picks["dynamics"].i),
        **{name: int(unique.sum()) for name, unique in alone.items()},
        "neither": int((alone[first] & alone[second]).sum()),
        "torso not of uniform": int((partners(picks[second], picks[first]) < 0).sum()),
    }


def _judged(one: MetricSet, counts: Counts) -> Judgement:
    reason = f"{counts['neither']} of {counts['picks']} are near no pick of either heuristic"
    published = f"; published {matsunaga_zordan.UNIQUE[one.like]} of {one.count}."
    holds = 0 < counts["neither"] < counts["picks"] / 2
    return judged(f"{CLAIM} ({one.name}).", holds, reason + published, Cause.CONVENTION)


ROW = Row(
    name="M-U",
    order=30,
    paper=matsunaga_zordan.PAPER,
    place="text",
    title="Transitions that only the dynamics metric finds",
    claim="11 of 67 transitions in the fighting and 14 of 30 in the reactions are the dynamics metric's own: no other "
    "metric has one within 0.25 s.",
    published={"unique": matsunaga_zordan.UNIQUE, "picks": matsunaga_zordan.KNEES},
    run=run,
)
