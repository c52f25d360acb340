"""The costs of all pairs of frames as pictures, by the uniform and by the dynamics metric."""

import numpy as np
from numpy.typing import NDArray

from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.compared_metrics import (
    MAIN,
    METRICS,
    ONE_SOURCE,
    RESAMPLED,
    MetricSet,
    metric_for,
    none_there,
    ranking_of,
    sets_of,
)
from footwork.study.reproduction.cost_pictures import contrast, cost_picture, middle_half
from footwork.study.reproduction.row import OURS, Cause, Cell, Column, Figure, Judgement, Result, Row, Table, judged
from footwork.study.reproduction.workbench import Workbench
from footwork.study.transition_picks import partners
from footwork.training.transitions import MIN_GAP, Minima

CLAIM = "The dynamics metric's matrix is crisper than the uniform one's"
MEASURES = {"contrast": contrast, "middle half": middle_half}
Contrasts = dict[str, dict[str, float]]  # by metric, by measure


def run(bench: Workbench) -> Result:
    """Matrices, their contrast, and where the two metrics differ."""
    sets = sets_of(bench, [*MAIN, ONE_SOURCE])
    if not sets:
        return none_there(f"{CLAIM}.")
    found = {one: _contrasts(bench, one) for one in sets}
    columns = [Column("set"), Column("metric")] + [Column(measure, "medians", OURS, 2) for measure in MEASURES]
    lines: list[list[Cell]] = [
        [one.name, name, *(found[one][name][measure] for measure in MEASURES)] for one in sets for name in METRICS
    ]
    return Result(
        judgements=[_crisper(one, found[one]) for one in sets],
        tables=[Table("Contrast of the matrices", columns, lines)],
        figures=[_figure(bench, one) for one in sets if one in MAIN],
        numbers={one.name: found[one] for one in sets},
        notes=[
            "Contrast: the standard deviation of the costs over their median. Middle half: the width of the middle "
            "half of the costs over their median, which a few very unlike frames do not widen. Frames at least half "
            "a second apart.",
            "Half of the reactions is going down, lying, rolling or getting up: so far from all upright frames "
            "that they set the standard deviation under every metric.",
            RESAMPLED,
        ],
    )


def _contrasts(bench: Workbench, one: MetricSet) -> Contrasts:
    found = {}
    for name in METRICS:
        costs = metric_for(bench, one, name).all_pairs()
        found[name] = {measure: of(costs, MIN_GAP) for measure, of in MEASURES.items()}
    return found


def _crisper(one: MetricSet, found: Contrasts) -> Judgement:
    ours, theirs = found["dynamics"], found["uniform"]
    words = [f"{measure} {ours[measure]:.2f} against {theirs[measure]:.2f} medians" for measure in MEASURES]
    holds = ours["contrast"] > theirs["contrast"]
    return judged(f"{CLAIM} ({one.name}).", holds, f"{'; '.join(words)}.".capitalize(), Cause.DATA)


def _figure(bench: Workbench, one: MetricSet) -> Figure:
    matrices = {name: _in_medians(bench, one, name) for name in ("uniform", "dynamics")}
    return Figure(
        caption=f"{one.name.capitalize()}: costs in medians (dark: alike), and the dynamics metric's less the uniform "
        f"one's (red: the dynamics metric finds them more unlike) with the {one.count} best places of each. Lines of "
        "little difference follow motions whose feet do the same.",
        alt=f"Cost matrices of {one.name} by the uniform and the dynamics metric, and their difference with picks",
        svg=cost_picture(list(matrices.items()), matrices["dynamics"] - matrices["uniform"], _picks(bench, one)),
    )


def _in_medians(bench: Workbench, one: MetricSet, name: str) -> NDArray[np.float64]:
    return metric_for(bench, one, name).all_pairs() / ranking_of(bench, one, name).median


def _picks(bench: Workbench, one: MetricSet) -> list[tuple[str, Minima]]:
    ours, theirs = (ranking_of(bench, one, name).first(one.count) for name in ("dynamics", "uniform"))
    shared, alone = partners(ours, theirs) >= 0, partners(theirs, ours) < 0
    return [("uniform", _some(theirs, alone)), ("dynamics", _some(ours, ~shared)), ("both", _some(ours, shared))]


def _some(picks: Minima, chosen: NDArray[np.bool_]) -> Minima:
    return Minima(picks.i[chosen], picks.j[chosen], picks.cost[chosen])


ROW = Row(
    name="M-F3",
    order=20,
    paper=matsunaga_zordan.PAPER,
    place="Figure 3",
    title="Matrices of costs",
    claim="The matrix of the dynamics-based metric is crisper than that of uniform weights: good and bad places for a "
    "transition are told apart more clearly.",
    published={},
    run=run,
)
