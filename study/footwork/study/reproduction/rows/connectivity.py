"""How much of the capture each graph connects, by threshold."""

from collections.abc import Mapping

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.charts import STANDARD, WELL, Axis, Series, line_charts
from footwork.study.reproduction.motion_sets import SETS
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
    unjudged,
)
from footwork.study.reproduction.words import joined_words
from footwork.study.reproduction.workbench import MG, WCMG, Workbench

Shares = Mapping[float, float | None]  # percent by threshold
Needed = Mapping[str, float | None]  # threshold by graph
GOAL = 0.9
GOALS = (0.8, GOAL)


def run(bench: Workbench) -> Result:
    """The share of the captured frames in the largest strongly connected part, over thresholds."""
    shares = {name: {kind: _shares(bench, kind, name) for kind in (WCMG, MG)} for name in SETS}
    needed = {name: {goal: _needed(bench, name, shares[name], goal) for goal in GOALS} for name in SETS}
    tables = [_table(name, shares[name]) for name in SETS]
    return Result(
        judgements=[_monotone(shares), _ahead(shares), *(_ratio(name, needed[name][GOAL]) for name in SETS)],
        tables=[*tables, _needed_table(needed)],
        figures=[_figure(shares)],
        numbers={name: {**shares[name], "thresholds": needed[name]} for name in SETS},
        notes=[
            "The first frames of a clip, before any transition leads into it, and the last ones, after all have left, "
            "are in no part of any graph. Short clips have many of them, so 80 % compares better than 90 %.",
            *bench.notes,
        ],
    )


def _needed(bench: Workbench, name: str, shares: Mapping[str, Shares], goal: float) -> Needed:
    """The lowest threshold of each graph that connects a share of the frames."""
    enough = [at for at, share in shares[WCMG].items() if share is not None and share >= 100.0 * goal]
    graphs = bench.graphs(name)
    well = graphs.well_connected_threshold(goal, min(enough)) if enough and min(enough) <= bench.up_to(name) else None
    return {MG: graphs.standard_threshold(goal), WCMG: well}


def _shares(bench: Workbench, kind: str, name: str) -> dict[float, float | None]:
    thresholds = zhao_safonova.CONNECTIVITY[name][kind]
    shares = {threshold: bench.share(kind, name, threshold) for threshold in thresholds}
    return {threshold: None if share is None else 100.0 * share for threshold, share in shares.items()}


def _monotone(shares: Mapping[str, Mapping[str, Shares]]) -> Judgement:
    falls = []
    for name in SETS:
        for kind in (WCMG, MG):
            known = [share for share in shares[name][kind].values() if share is not None]
            if known != sorted(known):
                falls.append(f"{kind} of {name}")
    return judged(
        "Both graphs connect more frames at a higher threshold.",
        not falls,
        f"The share falls for {joined_words(falls)}." if falls else "No share falls anywhere in the tables.",
        Cause.CONVENTION,
    )


def _ahead(shares: Mapping[str, Mapping[str, Shares]]) -> Judgement:
    gains = [
        (share - (shares[name][MG][threshold] or 0.0), name, threshold)
        for name in SETS
        for threshold, share in shares[name][WCMG].items()
        if share is not None
    ]
    claim = "The well-connected graph connects at least as many frames as the standard one at every threshold."
    if not gains:
        return unjudged(claim, "No well-connected graph was built.")
    least, most = min(gains), max(gains)
    reason = (
        f"Over {len(gains)} pairs it is ahead by {least[0]:.1f} points ({least[1]}, {least[2]:g}) "
        f"to {most[0]:.1f} points ({most[1]}, {most[2]:g})."
    )
    return judged(claim, least[0] >= 0.0, reason, Cause.CONVENTION)


def _ratio(name: str, needed: Mapping[str, float | None]) -> Judgement:
    published = zhao_safonova.RATIO_FOR_90[name]
    claim = f"{name}: for 90 % of the frames the standard graph needs {published:g} times the threshold."
    standard, well = needed[MG], needed[WCMG]
    if well is None:
        return unjudged(claim, "No well-connected graph that was built connects 90 %.")
    if standard is None:
        return judged(claim, True, f"Well-connected from {well:.3g}; the standard graph never does.")
    reason = f"Standard from s = {standard:.3g}, well-connected from {well:.3g}: {standard / well:.1f} times."
    return judged(claim, standard > well, reason, Cause.DATA)


def _table(name: str, shares: Mapping[str, Shares]) -> Table:
    published = zhao_safonova.CONNECTIVITY[name]
    columns = [Column("threshold s", digits=1)]
    columns += [Column(kind, "%", PUBLISHED, 0) for kind in (MG, WCMG)]
    columns += [Column(kind, "%", OURS, 1) for kind in (MG, WCMG)]
    lines: list[list[Cell]] = [
        [float(at), *(table[kind][at] for table in (published, shares) for kind in (MG, WCMG))]
        for at in published[WCMG]
    ]
    return Table(f"{name}: frames in the largest connected part", columns, lines)


def _needed_table(needed: Mapping[str, Mapping[float, Needed]]) -> Table:
    columns = [Column("set"), Column("share", "%"), Column("ratio", "", PUBLISHED, 1)]
    columns += [Column(f"{kind} threshold", "", OURS, 3) for kind in (MG, WCMG)] + [Column("ratio", "", OURS, 1)]
    lines: list[list[Cell]] = []
    for name, goals in needed.items():
        for goal, found in goals.items():
            standard, well = found[MG], found[WCMG]
            published = zhao_safonova.RATIO_FOR_90[name] if goal == GOAL else None
            lines.append(
                [name, round(100 * goal), published, standard, well, standard / well if standard and well else None]
            )
    return Table("Threshold from which a share of the frames is connected", columns, lines)


def _figure(shares: Mapping[str, Mapping[str, Shares]]) -> Figure:
    panels = []
    for name in SETS:
        series = [
            Series(f"{words}{', published' if published else ''}", list(line), list(line.values()), graph, published)
            for words, kind, graph in (("well-connected", WCMG, WELL), ("standard", MG, STANDARD))
            for published, line in ((False, shares[name][kind]), (True, zhao_safonova.CONNECTIVITY[name][kind]))
        ]
        ticks = (0.2, 0.5, 1, 2, 5) if name != SETS[-1] else (0.2, 0.4, 0.6, 1)
        panels.append((name, series, Axis("threshold s", log=True, ticks=ticks), Axis("% of frames", limits=(0, 103))))
    return Figure(
        caption="Captured frames in the largest strongly connected part, by threshold. s = 1 is a root mean square "
        "distance of 5.6 cm.",
        alt="Share of connected frames against threshold for three sets, published and ours",
        svg=line_charts(panels),
    )


ROW = Row(
    name="Z-T2",
    order=20,
    paper=zhao_safonova.PAPER,
    place="Table 2",
    title="Frames in the largest connected part",
    claim="Well-connected graphs connect most of the capture at thresholds at which standard graphs connect little: "
    "for 90 % of the frames a standard graph needs 3 to 12 times the threshold.",
    published=zhao_safonova.CONNECTIVITY | {"ratio_for_90": zhao_safonova.RATIO_FOR_90},
    run=run,
)
