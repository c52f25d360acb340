"""How long it takes from one frame to another on average, by threshold."""

from itertools import pairwise

import numpy as np

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.charts import STANDARD, WELL, Axis, Series, line_charts
from footwork.study.reproduction.row import (
    OURS,
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
from footwork.study.reproduction.trends import Line, fitted
from footwork.study.reproduction.workbench import MG, WCMG, Workbench

SET = "dataset3"
STANDARD_AT = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0, 3.0, 5.0)
WELL_AT = (0.2, 0.4, 0.6, 0.8)
LITTLE = 0.02  # a rise by less than this share of the time is none
GOOD_FIT = 0.9  # R2
PAPER_UP_TO = 1.4  # the highest threshold of the paper's comparisons of times


def run(bench: Workbench) -> Result:
    """The mean transition time between captured frames of dataset3, both graphs, over thresholds."""
    found = {
        kind: {at: survey for at in thresholds if (survey := bench.survey(kind, SET, at))}
        for kind, thresholds in ((MG, STANDARD_AT), (WCMG, WELL_AT))
    }
    times = {kind: {at: one.times.mean or np.nan for at, one in surveys.items()} for kind, surveys in found.items()}
    fits = {kind: _fit(line) for kind, line in times.items() if len(line) > 2}
    lines = [[at, *_cells(found[MG].get(at)), *_cells(found[WCMG].get(at))] for at in STANDARD_AT]
    columns = [Column("threshold s", digits=1)]
    for kind in (MG, WCMG):
        columns += [Column(f"{kind} time", "s", OURS), Column(f"{kind} frames", "%", OURS, 1)]
    return Result(
        judgements=[_falls(times), _equal(times), _exponential(fits)],
        tables=[Table(f"Mean shortest way between the captured frames of the largest part of {SET}", columns, lines)],
        figures=[_figure(times)],
        numbers={
            "mean_s": times,
            "fit": {kind: {"slope": fit.slope, "r2": fit.r2} for kind, fit in fits.items()},
        },
        notes=[
            "Published numbers: the standard graph at 1.4 is as quick as the well-connected one at 0.2; the curves "
            "themselves are only drawn in the paper.",
            "Shortest ways in frames, over all pairs of captured frames of the largest part (from a sample of them in "
            "large graphs). A part that grows takes in frames that are far from all others, so times may rise there.",
            *bench.notes,
        ],
    )


def _fit(times: dict[float, float]) -> Line:
    """The line through the logarithms of the times at the thresholds that the paper looks at."""
    near = {at: seconds for at, seconds in times.items() if at <= PAPER_UP_TO}
    return fitted(list(near), np.log(list(near.values())))


def _cells(survey: Survey | None) -> list[Cell]:
    """Mean time and share of the frames connected."""
    return [survey.times.mean, 100.0 * survey.share] if survey else [None, None]


def _falls(times: dict[str, dict[float, float]]) -> Judgement:
    rises = []
    for kind, line in times.items():
        values = list(line.values())
        rises += [
            f"{kind} from {early:.2f} to {late:.2f} s"
            for early, late in pairwise(values)
            if late > early * (1.0 + LITTLE)
        ]
    ends = ", ".join(
        f"{kind} {line[min(line)]:.2f} s at {min(line):g} to {line[max(line)]:.2f} s at {max(line):g}"
        for kind, line in times.items()
        if line
    )
    reason = f"{ends}." + (f" Rises: {'; '.join(rises)}." if rises else "")
    return judged("The mean transition time falls as the threshold rises.", not rises, reason, Cause.CONVENTION)


def _equal(times: dict[str, dict[float, float]]) -> Judgement:
    claim = "The well-connected graph at 0.2 is as quick as the standard graph at 1.4: seven times the threshold."
    well = times[WCMG].get(zhao_safonova.TRANSITION_TIME_EQUAL[WCMG])
    if well is None:
        return unjudged(claim, "The well-connected graph of dataset3 was not built.")
    as_quick = [at for at, seconds in times[MG].items() if seconds <= well]
    if not as_quick:
        return judged(claim, True, f"{well:.2f} s at 0.2, which the standard graph does not reach at any threshold.")
    reason = f"{well:.2f} s at 0.2; the standard graph first at {as_quick[0]:g}: {as_quick[0] / 0.2:.0f} times."
    return judged(claim, as_quick[0] > 0.2, reason, Cause.DATA)


def _exponential(fits: dict[str, Line]) -> Judgement:
    claim = "The curves are exponential: the logarithm of the time is a straight line over the threshold."
    if not fits:
        return unjudged(claim, "Too few thresholds.")
    reason = ", ".join(f"{kind} R² = {fit.r2:.2f}, slope {fit.slope:.2f}" for kind, fit in fits.items())
    reason += f" up to {PAPER_UP_TO:g}; from there on the curve flattens"
    return judged(claim, all(fit.r2 >= GOOD_FIT for fit in fits.values()), f"{reason}.", Cause.CLAIM)


def _figure(times: dict[str, dict[float, float]]) -> Figure:
    series = [
        Series(words, list(times[kind]), list(times[kind].values()), graph)
        for words, kind, graph in (("well-connected", WCMG, WELL), ("standard", MG, STANDARD))
        if times[kind]
    ]
    seconds = [value for line in times.values() for value in line.values()]
    ticks = [tick for tick in (0.3, 0.5, 1.0, 2.0, 3.0) if 0.8 * min(seconds) <= tick <= 1.2 * max(seconds)]
    return Figure(
        caption=f"Mean time from one captured frame of {SET} to another, on a logarithmic scale: a straight line would "
        "be exponential.",
        alt="Mean transition time against threshold for both graphs",
        svg=line_charts([("", series, Axis("threshold s"), Axis("mean time, s", log=True, ticks=ticks))]),
    )


ROW = Row(
    name="Z-F7",
    order=40,
    paper=zhao_safonova.PAPER,
    place="Figure 7",
    title="Mean transition time",
    claim="The mean transition time falls exponentially with the threshold; the well-connected graph at 0.2 is as "
    "quick as the standard graph at 1.4.",
    published=zhao_safonova.TRANSITION_TIME_EQUAL,
    run=run,
)
