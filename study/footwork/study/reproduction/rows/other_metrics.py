"""The point cloud against positions and orientations, and laying windows by all of their frames or the middle one."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.stats import rankdata

from footwork.study.alternative_costs import REACH, centre_aligned, positions_and_orientations
from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.charts import STANDARD, WELL, Axis, Series, line_charts
from footwork.study.reproduction.compared_metrics import (
    MAIN,
    RESAMPLED,
    MetricSet,
    clips_of,
    lengths_of,
    metric_for,
    none_there,
    sets_of,
)
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
from footwork.study.reproduction.workbench import Workbench
from footwork.study.transition_picks import Ranking, partners, ranking
from footwork.training.transitions import MIN_GAP

SPREADS = "A point cloud spreads the costs further than positions and orientations do"
ALIKE = "Laying windows by all of their frames or by the middle one gives about the same costs"
CLOUD, LEE, TURNED, CENTRE = "point cloud", "positions and orientations", "orientations count more", "middle frame"
STRONG = 1.0  # metres a radian, as where both are simply added up
RANKS = 100
CORRELATED = 0.95
Found = Mapping[str, tuple[Ranking, dict[str, float]]]  # ranking and measures by metric


def run(bench: Workbench) -> Result:
    """Spread of the costs and order of the pairs under each."""
    sets = sets_of(bench, MAIN)
    if not sets:
        return none_there(f"{SPREADS}.", f"{ALIKE}.")
    found = {one: _measured(bench, one) for one in sets}
    columns = [Column("set"), Column("metric"), Column("spread", "medians", OURS, 3)]
    columns += [Column("rank 1 to 67", "medians", OURS, 3), Column("Spearman's ρ with the cloud", "", OURS, 4)]
    columns += [Column("knee", "", OURS), Column("picks not of the cloud", "", OURS)]
    lines: list[list[Cell]] = [
        [one.name, name, *(of[key] for key in ("spread", "head", "spearman")), ranked.knee_rank, int(of["unique"])]
        for one in sets
        for name, (ranked, of) in found[one].items()
    ]
    judgements = [_spreads(one, found[one]) for one in sets] + [_alike(one, found[one]) for one in sets]
    return Result(
        judgements=judgements,
        tables=[Table("Costs under other ways to compare frames", columns, lines)],
        figures=[_figure(one, found[one]) for one in sets],
        numbers={
            one.name: {name: of | {"knee": ranked.knee_rank} for name, (ranked, of) in found[one].items()}
            for one in sets
        },
        notes=[
            "Spread: the standard deviation of all pairs' costs over their median, of frames half a second apart or "
            "more. Rank 1 to 67: how far the rank curve rises. Uniform weights throughout.",
            f"Positions and orientations: joints' places and turns in the world, a radian counting {REACH:g} m, which "
            f"is what it moves the ends of a segment; or {STRONG:g} m (orientations count more). The paper prints no "
            "weight.",
            RESAMPLED,
        ],
    )


def _measured(bench: Workbench, one: MetricSet) -> Found:
    clips, cloud = clips_of(bench, one), metric_for(bench, one, "uniform").all_pairs()
    bench.tell(f"{one.name}: {LEE}", 0.0)
    turned = positions_and_orientations(clips) - cloud
    makers = {
        CLOUD: lambda: cloud,
        LEE: lambda: cloud + turned,
        TURNED: lambda: cloud + (STRONG / REACH) ** 2 * turned,
        CENTRE: lambda: centre_aligned(clips),
    }
    lengths, base = lengths_of(bench, one), _pairs(cloud)
    first = ranking(cloud, lengths, RANKS)
    found = {}
    for name, make in makers.items():
        costs = make()
        found[name] = ranking(costs, lengths, RANKS), _measures(costs, base)
        picks = found[name][0].first(one.count)
        found[name][1]["unique"] = float((partners(picks, first.first(one.count)) < 0).sum())
        found[name][1]["head"] = _rise(found[name][0])
    return found


def _measures(costs: NDArray[np.float64], base: NDArray[np.float64]) -> dict[str, float]:
    pairs = _pairs(costs)
    correlation = np.corrcoef(rankdata(pairs), rankdata(base))[0, 1]
    return {"spread": float(pairs.std() / np.median(pairs)), "spearman": float(correlation)}


def _pairs(costs: NDArray[np.float64]) -> NDArray[np.float64]:
    return costs[np.triu_indices(len(costs), MIN_GAP)]


def _rise(ranked: Ranking) -> float:
    head = ranked.first(matsunaga_zordan.KNEES[matsunaga_zordan.FIGHTING]).cost
    return float((head[-1] - head[0]) / ranked.median)


def _spreads(one: MetricSet, found: Found) -> Judgement:
    spread = {name: of["spread"] for name, (_, of) in found.items()}
    reason = (
        f"{spread[CLOUD]:.3f} medians against {spread[LEE]:.3f}, and {spread[TURNED]:.3f} where orientations count "
        "more."
    )
    claim = f"{SPREADS} ({one.name})."
    if spread[LEE] < spread[CLOUD] < spread[TURNED]:
        return unjudged(claim, f"{reason} It depends on what a radian counts.", Cause.CONVENTION)
    return judged(claim, spread[CLOUD] >= max(spread[LEE], spread[TURNED]), reason, Cause.CONVENTION)


def _alike(one: MetricSet, found: Found) -> Judgement:
    of = found[CENTRE][1]
    reason = (
        f"Spearman's ρ of all pairs {of['spearman']:.4f}; spread {of['spread']:.3f} against "
        f"{found[CLOUD][1]['spread']:.3f}; {of['unique']:.0f} of {one.count} picks differ."
    )
    return judged(f"{ALIKE} ({one.name}).", of["spearman"] > CORRELATED, reason, Cause.DATA)


def _figure(one: MetricSet, found: Found) -> Figure:
    panels = []
    for title, names in (("point cloud?", (CLOUD, LEE, TURNED)), ("which alignment?", (CLOUD, CENTRE))):
        series = []
        for name, colour in zip(names, (WELL, STANDARD, "faint"), strict=False):
            ranked = found[name][0]
            curve = (ranked.ranked.cost / ranked.median)[:RANKS]
            series.append(Series(name, range(1, len(curve) + 1), curve, colour, marks=False))
        panels.append((title, series, Axis("rank"), Axis("cost, medians", limits=(0, None))))
    return Figure(
        caption=f"{one.name.capitalize()}: costs by rank in medians. The right-hand curves nearly hide each other.",
        alt=f"Rank curves of {one.name} under other ways to compare frames",
        svg=line_charts(panels),
    )


ROW = Row(
    name="M-F5a,b",
    order=60,
    paper=matsunaga_zordan.PAPER,
    place="Figure 5",
    title="Other ways to compare frames",
    claim="A point cloud spreads the costs further than positions and orientations do; laying windows by all frames or "
    "by the middle one makes about no difference.",
    published={},
    run=run,
)
