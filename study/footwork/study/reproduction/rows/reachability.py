"""Which frames can be reached from which: the transitive closure as pictures."""

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.charts import matrix_panels
from footwork.study.reproduction.motion_sets import SETS
from footwork.study.reproduction.row import OURS, Cause, Column, Figure, Result, Row, Table, judged, unjudged
from footwork.study.reproduction.survey import Survey
from footwork.study.reproduction.workbench import MG, WCMG, Workbench

THRESHOLD = zhao_safonova.CLOSURE_THRESHOLD
ALMOST_WHITE = 0.8


def run(bench: Workbench) -> Result:
    """The closure of both graphs of each set at one threshold."""
    found = {(name, kind): bench.survey(kind, name, THRESHOLD) for name in SETS for kind in (MG, WCMG)}
    shares = {key: 100.0 * survey.reached if survey else None for key, survey in found.items()}
    claim = "At 0.4 the closure of the well-connected graph is almost white, that of the standard graph in blocks."
    pairs = [(shares[name, MG] or 0.0, shares[name, WCMG] or 0.0) for name in SETS if found[name, WCMG]]
    judgement = unjudged(claim, "No well-connected graph was built.")
    if pairs:
        reason = "Reachable pairs, standard to well-connected: " + ", ".join(
            f"{name} {shares[name, MG]:.0f} to {shares[name, WCMG]:.0f} %" for name in SETS if found[name, WCMG]
        )
        holds = all(well > standard and well >= 100.0 * ALMOST_WHITE for standard, well in pairs)
        judgement = judged(claim, holds, reason + ".", Cause.DATA)
    columns = [Column("set"), Column("standard", "%", OURS, 1), Column("well-connected", "%", OURS, 1)]
    return Result(
        judgements=[judgement],
        tables=[
            Table(
                "Ordered pairs of captured frames with a way from the first to the second",
                columns,
                [[name, shares[name, MG], shares[name, WCMG]] for name in SETS],
            )
        ],
        figures=[_figure(found)],
        numbers={name: {kind: shares[name, kind] for kind in (MG, WCMG)} for name in SETS},
        notes=["The paper prints pictures only: the shares are ours alone.", *bench.notes],
    )


def _figure(found: dict[tuple[str, str], Survey | None]) -> Figure:
    words = {MG: "standard", WCMG: "well-connected"}
    panels = [
        (f"{name}, {words[kind]}", survey.picture)
        for kind in (MG, WCMG)
        for name in SETS
        if (survey := found[name, kind])
    ]
    return Figure(
        caption=f"Transitive closure at s = {THRESHOLD}: white where a way leads from the captured frame (down) to the "
        "other (across). Frames are in the order of their clips.",
        alt="Closure matrices of the three sets for standard and well-connected graphs",
        svg=matrix_panels(panels, len(SETS), "to frame", "from frame"),
    )


ROW = Row(
    name="Z-F6",
    order=30,
    paper=zhao_safonova.PAPER,
    place="Figure 6",
    title="What can be reached from where",
    claim="At a threshold of 0.4 nearly every frame can be reached from every other in the well-connected graph; "
    "in the standard graph people and behaviours are islands.",
    published={"threshold": THRESHOLD},
    run=run,
)
