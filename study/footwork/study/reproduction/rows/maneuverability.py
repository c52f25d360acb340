"""How soon a character can begin another kind of motion, by threshold."""

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.charts import STANDARD, WELL, Axis, Series, line_charts
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
from footwork.study.reproduction.survey import Survey
from footwork.study.reproduction.words import joined_words
from footwork.study.reproduction.workbench import MG, WCMG, Workbench

SET = "dataset3"
PUBLISHED_LM = zhao_safonova.MANEUVERABILITY
THRESHOLDS = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4)
COMPARED_AT = 0.8


def run(bench: Workbench) -> Result:
    """Local maneuverability of both graphs of dataset3 over thresholds."""
    found = {
        kind: {at: bench.survey(kind, SET, at) for at in THRESHOLDS if bench.wanted(kind, SET, at)}
        for kind in (MG, WCMG)
    }
    times = {
        kind: {at: one.maneuver.mean for at, one in surveys.items() if one and one.maneuver.mean}
        for kind, surveys in found.items()
    }
    return Result(
        judgements=[_falls(kind, times[kind]) for kind in (MG, WCMG)] + [_low_threshold(times), _gain(times)],
        tables=[_table(found)],
        figures=[_figure(times)],
        numbers={kind: {at: _numbers(one) for at, one in found[kind].items() if one} for kind in found},
        notes=[
            "Each frame: every captured frame of the part is a start of its own instead of the end of a segment, which "
            "is alike for all graphs; the segments of the paper's measure are shorter the more a graph branches.",
            "Half a segment's duration plus the shortest motion from its end to the nearest frame of a label, 0 where "
            "it is of that label already; the mean over segments, then over labels, of the largest connected part.",
            "Labels of ours: "
            + joined_words(_labels(found))
            + ". The paper does not list its labels or say how frames "
            "between two captured ones are labelled: ours have that of the heavier one.",
            *bench.notes,
        ],
    )


def _labels(found: dict[str, dict[float, Survey | None]]) -> list[str]:
    return sorted(
        {kind for surveys in found.values() for one in surveys.values() if one for kind in one.maneuver.kinds}
    )


def _numbers(survey: Survey) -> dict[str, object]:
    return {
        "lm_s": survey.maneuver.mean,
        "each_frame_s": survey.from_frames.mean,
        "by_label_s": survey.maneuver.by_kind(),
        "frames": survey.part_frames,
    }


def _falls(kind: str, line: dict[float, float]) -> Judgement:
    claim = f"Local maneuverability falls as the threshold rises ({kind})."
    if len(line) < 2:
        return unjudged(claim, "Fewer than two thresholds.")
    values = list(line.values())
    return judged(claim, values == sorted(values, reverse=True), ", ".join(_words(line)) + ".", Cause.CONVENTION)


def _words(line: dict[float, float]) -> list[str]:
    return [f"{seconds:.2f} s at {at:g}" for at, seconds in line.items()]


def _low_threshold(times: dict[str, dict[float, float]]) -> Judgement:
    claim = "The well-connected graph at 0.2 is as quick as the standard graph at 1.4."
    well, standard = times[WCMG].get(0.2), times[MG].get(1.4)
    if well is None or standard is None:
        return unjudged(claim, "The well-connected graph of dataset3 was not built.")
    return judged(claim, well <= standard, f"{well:.2f} s against {standard:.2f} s.", Cause.DATA)


def _gain(times: dict[str, dict[float, float]]) -> Judgement:
    published = zhao_safonova.MANEUVERABILITY_GAIN
    claim = f"At {COMPARED_AT} the well-connected graph is three times as quick ({published:.2f})."
    shared = [at for at in times[WCMG] if at in times[MG]]
    if not shared:
        return unjudged(claim, "The well-connected graph of dataset3 was not built.")
    at = min(shared, key=lambda threshold: abs(threshold - COMPARED_AT))
    gain = times[MG][at] / times[WCMG][at]
    reason = f"At {at:g} {gain:.2f} times: {times[MG][at]:.2f} s standard, {times[WCMG][at]:.2f} s well-connected."
    return judged(claim, gain >= 2.0, reason, Cause.DATA)


def _table(found: dict[str, dict[float, Survey | None]]) -> Table:
    columns = [Column("threshold s", digits=1), Column("MG LM", "s", PUBLISHED), Column("wcMG LM", "s", PUBLISHED)]
    columns.append(Column("MG frames", "", PUBLISHED))
    for kind in (MG, WCMG):
        columns += [Column(f"{kind} LM", "s", OURS), Column("each frame", "s", OURS), Column("frames", "", OURS)]
    lines: list[list[Cell]] = [[at, *_published(at), *_cells(found, at)] for at in THRESHOLDS]
    return Table(f"Local maneuverability (LM) and captured frames in the largest part, {SET}", columns, lines)


def _published(at: float) -> list[Cell]:
    return [*(PUBLISHED_LM[kind].get(at) for kind in (MG, WCMG)), zhao_safonova.MANEUVERABILITY_NODES.get(at)]


def _cells(found: dict[str, dict[float, Survey | None]], at: float) -> list[Cell]:
    return [cell for kind in (MG, WCMG) for cell in _cell(found[kind].get(at))]


def _cell(survey: Survey | None) -> list[Cell]:
    return [survey.maneuver.mean, survey.from_frames.mean, survey.part_frames] if survey else [None, None, None]


def _figure(times: dict[str, dict[float, float]]) -> Figure:
    series = [
        Series(f"{words}{', published' if published else ''}", list(line), list(line.values()), graph, published)
        for words, kind, graph in (("well-connected", WCMG, WELL), ("standard", MG, STANDARD))
        for published, line in ((False, times[kind]), (True, PUBLISHED_LM[kind]))
        if line
    ]
    return Figure(
        caption="Local maneuverability: seconds until a character in the middle of some motion can begin another kind.",
        alt="Local maneuverability against threshold, published and ours",
        svg=line_charts([("", series, Axis("threshold s"), Axis("LM, s", limits=(0, None)))]),
    )


ROW = Row(
    name="Z-T3",
    order=50,
    paper=zhao_safonova.PAPER,
    place="Table 3",
    title="Local maneuverability",
    claim="The well-connected graph is about three times as quick to begin another kind of motion; at 0.2 "
    "it matches the standard graph at 1.4.",
    published=PUBLISHED_LM
    | {"MG_nodes": zhao_safonova.MANEUVERABILITY_NODES, "gain_at_0.8": zhao_safonova.MANEUVERABILITY_GAIN},
    run=run,
)
