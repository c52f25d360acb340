"""How well and how smoothly characters of both kinds of graph follow a player."""

from collections.abc import Mapping
from typing import Any

from footwork.controllers.steering import SteeringController
from footwork.motion.bundle import Bundle
from footwork.study.contender import Contender
from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.charts import STANDARD as ORANGE
from footwork.study.reproduction.charts import WELL as BLUE
from footwork.study.reproduction.charts import Axis, Series, line_charts
from footwork.study.reproduction.players import (
    NO_TRACES,
    QUICK_SET,
    STANDARD,
    WALK_JUMP_STOP,
    WELL_CONNECTED,
    Setting,
    bundle_of,
    motions_of,
    score_of,
    unseen,
)
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
from footwork.study.reproduction.workbench import LARGE, MG, WCMG, Workbench
from footwork.training.value_iteration import solve

SETTINGS = [(WCMG, Setting(WELL_CONNECTED, 0.2))] + [(MG, Setting(STANDARD, at)) for at in (0.2, 1.0, 5.0, 10.0)]
RATIO = 1.6  # of the published Totals: wcMG to the best MG
Line = tuple[str, float]
Found = Mapping[Line, dict[str, Any] | None]


def run(bench: Workbench) -> Result:
    """Build the five characters and let them follow the recorded players."""
    claims = ("The well-connected graph's Total is above every standard graph's.", "Control of MG rises with s.")
    if not bench.has_traces:
        return Result(judgements=[unjudged(claim, NO_TRACES) for claim in claims])
    motions = motions_of(bench, LARGE, WALK_JUMP_STOP)
    bundles = {(kind, setting.threshold): bundle_of(bench, motions, setting) for kind, setting in SETTINGS}
    found = {line: _lasting(bench, bundle) if bundle else None for line, bundle in bundles.items()}
    learned = {line: _followed(bench, bundle) if bundle else None for line, bundle in bundles.items()}
    return Result(
        judgements=[_total(claims[0], found), _control(claims[1], found)],
        tables=[
            _table("Following recorded players: walk, jump and stop", found),
            _table("The same, with policies that learned from other players how they change their mind", learned),
        ],
        figures=[_figure(found)],
        numbers={
            words: {f"{kind} {at:g}": _numbers(one) for (kind, at), one in scores.items() if one}
            for words, scores in (("lasting", found), ("learned", learned))
        },
        notes=[
            f"{len(unseen(bench))} recorded players of an action game, whom no policy learned from. Judged are the "
            "policies that take a command to last: those that expect players to change their mind find, on graphs that "
            "answer late, that standing still pays best. The published players were gentler, and the sigma of the "
            "published Transition is not known. Control and Transition are means over ticks, Total their product; "
            "intervals are bootstraps over players. Published SCC counts frames of theirs.",
            *([f"A quick run: {QUICK_SET} in place of the walk, jump, stop set, and few seconds."] * bench.quick),
        ],
    )


def _followed(bench: Workbench, bundle: Bundle, contender: Contender | None = None) -> dict[str, Any]:
    return score_of(bench, bundle, contender) | {"frames": int(bundle.graph.original.sum())}


def _lasting(bench: Workbench, bundle: Bundle) -> dict[str, Any]:
    graph = bundle.graph
    table = solve(graph, bundle.table("steering").task).require_converged()
    return _followed(bench, bundle, SteeringController(graph, table))


def _numbers(one: dict[str, Any]) -> dict[str, Any]:
    names = ("control", "transition", "transition_jumps", "total", "total_by_tick", "switch_share", "frames")
    return {name: one[name] for name in names} | {"intervals": one["intervals"], "foot_slide": one["foot_slide_cm_s"]}


def _standard(found: Found) -> dict[float, dict[str, Any]]:
    return {at: one for (kind, at), one in found.items() if kind == MG and one}


def _total(claim: str, found: Found) -> Judgement:
    well, others = found[WCMG, 0.2], _standard(found)
    if well is None or not others:
        return unjudged(claim, "A graph could not be walked without end.", Cause.DATA)
    best = max(others, key=lambda at: others[at]["total"])
    ratio = well["total"] / max(others[best]["total"], 1e-9)
    reason = (
        f"{well['total']:.2f} against {others[best]['total']:.2f} of MG at {best:g}: {ratio:.2f} times, "
        f"published {RATIO:g} times."
    )
    return judged(claim, ratio > 1.0, reason, Cause.DATA)


def _control(claim: str, found: Found) -> Judgement:
    others = _standard(found)
    if len(others) < 2:
        return unjudged(claim, "Fewer than two standard graphs.", Cause.DATA)
    controls = [others[at]["control"] for at in sorted(others)]
    reason = ", ".join(f"{control:.2f} at {at:g}" for at, control in zip(sorted(others), controls, strict=True))
    return judged(claim, controls == sorted(controls), f"{reason}.", Cause.DATA)


def _table(title: str, found: Found) -> Table:
    columns = [Column("graph"), Column("threshold s", digits=1)]
    columns += [Column(name, "", PUBLISHED, digits) for name, digits in _NAMES]
    columns += [Column(name, "", OURS, digits) for name, digits in _NAMES]
    columns += [Column("interval of Total", "", OURS), Column("switches", "% of ticks", OURS, 0)]
    columns += [Column("slide", "cm/s", OURS, 1)]
    rows = [[kind, at, *zhao_safonova.CONTROL[kind, at], *_cells(one)] for (kind, at), one in found.items()]
    return Table(title, columns, rows)


_NAMES = (("Control", 2), ("Transition", 2), ("Total", 2), ("frames", 0))


def _cells(one: dict[str, Any] | None) -> list[Cell]:
    if one is None:
        return [None] * 7
    interval = "–"
    if one["intervals"]:
        interval = "{:.2f} to {:.2f}".format(*one["intervals"]["total"])
    figures = [one[name] for name in ("control", "transition", "total", "frames")]
    return [*figures, interval, 100.0 * one["switch_share"], one["foot_slide_cm_s"]]


def _figure(found: Found) -> Figure:
    series = []
    for kind, words, colour in ((MG, "standard", ORANGE), (WCMG, "well-connected", BLUE)):
        ours = {at: one for (name, at), one in found.items() if name == kind and one}
        if ours:
            series.append(
                Series(
                    words, [one["transition"] for one in ours.values()], [o["control"] for o in ours.values()], colour
                )
            )
        theirs = [numbers for (name, _), numbers in zhao_safonova.CONTROL.items() if name == kind]
        series.append(
            Series(f"{words}, published", [line[1] for line in theirs], [line[0] for line in theirs], colour, True)
        )
    axes = Axis("Transition", limits=(0.5, 1.0)), Axis("Control", limits=(0.0, 1.0))
    return Figure(
        caption="Control against smoothness; lines join the thresholds of a kind of graph.",
        alt="Control against Transition, published and ours",
        svg=line_charts([("", series, *axes)], height=3.6),
    )


ROW = Row(
    name="Z-T6",
    order=95,
    paper=zhao_safonova.PAPER,
    place="Table 6",
    title="Following a player",
    claim="With the same control method the well-connected graph at 0.2 follows players better than the standard graph "
    "at any threshold, and more smoothly than those that come near.",
    published={f"{kind} {at:g}": numbers for (kind, at), numbers in zhao_safonova.CONTROL.items()},
    run=run,
)
