"""From running to ducking: a time that the paper quotes from earlier work."""

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.row import OURS, PUBLISHED, Column, Result, Row, Table
from footwork.study.reproduction.workbench import MG, WCMG, Workbench

SET, START, END = "dataset3", "run", "duck"
THRESHOLDS = (0.2, 0.4, 0.8)


def run(bench: Workbench) -> Result:
    """Our times from running to ducking, for comparison."""
    lines, numbers = [], {}
    for at in THRESHOLDS:
        cells = []
        for survey in bench.surveys(SET, at):
            tables = survey.behaviour.tables() if survey else {}
            cells += [tables.get(reading, {}).get(START, {}).get(END) for reading in ("least_s", "mean_s")]
        lines.append([at, zhao_safonova.RUN_TO_DUCK, *cells])
        numbers[at] = dict(zip(("MG_least_s", "MG_mean_s", "wcMG_least_s", "wcMG_mean_s"), cells, strict=True))
    columns = [Column("threshold s", digits=1), Column("earlier work", "s", PUBLISHED, 1)]
    columns += [Column(f"{kind}, {words}", "s", OURS) for kind in (MG, WCMG) for words in ("nearest", "mean")]
    return Result(
        tables=[Table(f"From {START} to {END} in {SET}", columns, lines)],
        numbers=numbers,
        notes=["Context only: the earlier work used other motions and another graph.", *bench.notes],
    )


ROW = Row(
    name="Z-R1",
    order=70,
    paper=zhao_safonova.PAPER,
    place="quoted",
    title="From running to ducking",
    claim="In earlier work a character took 3.6 s from running to ducking.",
    published={"seconds": zhao_safonova.RUN_TO_DUCK},
    run=run,
)
