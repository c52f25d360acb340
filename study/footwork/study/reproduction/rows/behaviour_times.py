"""How long it takes from each kind of motion to each other one, in both readings of the paper's table."""

import numpy as np
from numpy.typing import NDArray

from footwork.study.behaviour_times import BehaviourTimes
from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.row import (
    OURS,
    PUBLISHED,
    Cause,
    Column,
    Judgement,
    Result,
    Row,
    Table,
    judged,
    unjudged,
)
from footwork.study.reproduction.workbench import MG, WCMG, Workbench

SET = "dataset3"
THRESHOLD = 0.8
READINGS = {"least": "from the nearest frame", "mean": "mean over frames"}
PUBLISHED_TIMES = zhao_safonova.BEHAVIOUR_TIMES
OFF_DIAGONAL = "mean off the diagonal"


def run(bench: Workbench) -> Result:
    """Times between the labels of dataset3 in both graphs."""
    standard, well = (survey and survey.behaviour for survey in bench.surveys(SET, THRESHOLD))
    tables = [_against_published(standard, well)]
    tables += [_matrix(reading, standard, well) for reading in READINGS]
    return Result(
        judgements=[_dominance(reading, standard, well) for reading in READINGS],
        tables=tables,
        numbers={kind: times.tables() for kind, times in ((MG, standard), (WCMG, well)) if times},
        notes=[
            "Every published time is a whole number of frames and the diagonal is zero, so the published table very "
            "likely holds the time between the two nearest frames, not the mean that the text tells of: both are here.",
            "Our word for picking something up is pick; ducking is duck. Only ways within the largest part count.",
            *bench.notes,
        ],
    )


def _pairs(times: BehaviourTimes | None, reading: str) -> dict[tuple[str, str], float]:
    if times is None:
        return {}
    table: NDArray[np.float64] = getattr(times, reading)
    return {
        (start, end): float(table[row, column])
        for row, start in enumerate(times.kinds)
        for column, end in enumerate(times.kinds)
        if row != column and np.isfinite(table[row, column])
    }


def _dominance(reading: str, standard: BehaviourTimes | None, well: BehaviourTimes | None) -> Judgement:
    claim = f"The well-connected graph is at least as quick for every pair of behaviours ({READINGS[reading]})."
    ours, theirs = _pairs(well, reading), _pairs(standard, reading)
    if not ours:
        return unjudged(claim, f"The well-connected graph of {SET} was not built at {THRESHOLD}.")
    slower = [pair for pair in theirs if ours.get(pair, np.inf) > theirs[pair] + 1e-9]
    reason = (
        f"Quicker or as quick in {len(theirs) - len(slower)} of {len(theirs)} pairs; mean "
        f"{np.mean(list(ours.values())):.2f} s against {np.mean(list(theirs.values())):.2f} s."
    )
    if slower:
        start, end = max(slower, key=lambda pair: ours[pair] - theirs[pair])
        reason += f" Worst: {start} to {end} {ours[start, end]:.2f} s against {theirs[start, end]:.2f} s."
    return judged(claim, not slower, reason, Cause.CONVENTION)


def _against_published(standard: BehaviourTimes | None, well: BehaviourTimes | None) -> Table:
    columns = [Column("time")] + [Column(kind, "s", PUBLISHED) for kind in (MG, WCMG)]
    columns += [Column(f"{kind}, {words}", "s", OURS) for words in READINGS.values() for kind in (MG, WCMG)]
    found = {
        (kind, reading): _pairs(times, reading)
        for kind, times in ((MG, standard), (WCMG, well))
        for reading in READINGS
    }
    order = [(kind, reading) for reading in READINGS for kind in (MG, WCMG)]
    return Table(
        f"Times at threshold {THRESHOLD} for which the paper's numbers are at hand",
        columns,
        [
            ["run to idle", *(PUBLISHED_TIMES["run to idle"][kind] for kind in (MG, WCMG))]
            + [found[key].get(("run", "idle")) for key in order],
            [OFF_DIAGONAL, *(PUBLISHED_TIMES[OFF_DIAGONAL][kind] for kind in (MG, WCMG))]
            + [float(np.mean(list(found[key].values()))) if found[key] else None for key in order],
        ],
    )


def _matrix(reading: str, standard: BehaviourTimes | None, well: BehaviourTimes | None) -> Table:
    """Every pair of labels, as the standard graph's time and the well-connected one's."""
    before, after = _pairs(standard, reading), _pairs(well, reading)
    kinds = list(dict.fromkeys([*(standard.kinds if standard else ()), *(well.kinds if well else ())]))
    lines = [
        [start, *("" if start == end else _both(before.get((start, end)), after.get((start, end))) for end in kinds)]
        for start in kinds
    ]
    caption = f"From (down) to (across), s, {READINGS[reading]}: standard → well-connected, threshold {THRESHOLD}"
    return Table(caption, [Column("from"), *(Column(kind, group=OURS) for kind in kinds)], lines)


def _both(before: float | None, after: float | None) -> str:
    return " → ".join("–" if seconds is None else f"{seconds:.2f}" for seconds in (before, after))


ROW = Row(
    name="Z-T4",
    order=60,
    paper=zhao_safonova.PAPER,
    place="Table 4",
    title="From behaviour to behaviour",
    claim="At 0.8 the well-connected graph is quicker for every pair of behaviours: running to idling in 1.60 s "
    "against 2.70 s.",
    published=PUBLISHED_TIMES,
    run=run,
)
