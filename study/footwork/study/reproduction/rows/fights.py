"""Whether simple rules make two characters circle, strike and evade; and what a table of costs to come adds to them."""

from collections.abc import Mapping

from footwork.runtime.match import table_of
from footwork.study.reproduction.fights import STYLE, Bout, bout, ground_of, without_fighting
from footwork.study.reproduction.row import OURS, Cause, Cell, Column, Judgement, Result, Row, Table, judged
from footwork.study.reproduction.state_annotated import PAPER
from footwork.study.reproduction.workbench import Workbench
from footwork.study.shadowing_trials import Trials, shadowing_trials

SECONDS, QUICK_SECONDS = 600.0, 120.0
FACED, HELD = 30.0, 1.0
STUCK = 5.0
SHADOWING = (
    f"By the rule fighters face one another to within {FACED:g} degrees and keep their distance to within {HELD:g} m "
    "while they shadow."
)
FIGHTING = "Strikes are thrown and land, and some are evaded."
GOING_ON = f"Nobody is ever stuck: a new stretch of motion begins every {STUCK:g} s at least, and hips keep apart."
BETTER = "A table of costs to come keeps distance and facing better than the rule, and recovers sooner from a push."
RULE, TABLE = "rule", "table"
NEAREST = 0.3


def run(bench: Workbench) -> Result:
    """A bout by the rule, one by the table, and trials of shadowing by both."""
    if missing := without_fighting(bench, (SHADOWING, FIGHTING, GOING_ON, BETTER)):
        return Result(missing)
    ground, seconds = ground_of(bench), QUICK_SECONDS if bench.quick else SECONDS
    tables = {RULE: None, TABLE: table_of(ground.bundle)}
    bouts = {name: bout(ground, seconds, table) for name, table in tables.items()}
    size = {"matches": 3, "pushes": 6, "seconds": 30.0} if bench.quick else {}
    trials = {
        (name, turn): shadowing_trials(ground, table, turn=turn, **size)
        for turn in (0.0, STYLE.turn)
        for name, table in tables.items()
    }
    return Result(
        judgements=[_shadowing(bouts[RULE]), _fighting(bouts[RULE]), _going_on(bouts), _better(trials)],
        tables=[_bouts(bouts), _trials(trials)],
        numbers={
            "bouts": {name: vars(one) for name, one in bouts.items()},
            "trials": {f"{name}, {turn:g} degrees": one.record() for (name, turn), one in trials.items()},
        },
        notes=[
            "The paper shows pictures, no numbers; the rules are its own, with thresholds that it leaves open.",
            "Errors of a bout are those of the usual style while fighters shadow. In trials both do nothing else, and "
            "nothing is left to chance; intervals are bootstraps over matches.",
            "The table expects the opponent to stand. In a bout a fighter takes any way now and then, or two who "
            "shadow by the table would find a stance and keep it, with no occasion to strike.",
        ],
    )


def _shadowing(one: Bout) -> Judgement:
    reason = f"{one.facing:.1f} degrees and {one.distance_error:.2f} m off, {one.distance:.2f} m apart on average."
    return judged(SHADOWING, one.facing < FACED and one.distance_error < HELD, reason, Cause.CONVENTION)


def _fighting(one: Bout) -> Judgement:
    counts = one.counts
    reason = (
        f"{counts['strikes']} strikes in {one.seconds:g} s, {counts['hits']} landed; {counts['evades']} evasions, "
        f"{counts['evaded']} strikes missed somebody who evaded."
    )
    return judged(FIGHTING, min(counts["hits"], counts["evades"], counts["evaded"]) > 0, reason, Cause.DATA)


def _going_on(bouts: Mapping[str, Bout]) -> Judgement:
    longest, nearest = max(one.longest for one in bouts.values()), min(one.nearest for one in bouts.values())
    reason = f"The longest stretch took {longest:.1f} s; hips came {nearest:.2f} m near."
    return judged(GOING_ON, longest < STUCK and nearest > NEAREST, reason, Cause.CLAIM)


def _better(trials: Mapping[tuple[str, float], Trials]) -> Judgement:
    said, holds = [], True
    for turn in dict.fromkeys(turn for _, turn in trials):
        rule, table = trials[RULE, turn], trials[TABLE, turn]
        for name in ("distance", "facing", "recovery"):
            ours, theirs = getattr(table, name), getattr(rule, name)
            holds = holds and (ours.value or 0.0) < (theirs.value or 0.0)
            said.append(f"{name} {ours.words(2)} against {theirs.words(2)}")
        said[-1] += f" with turns up to {turn:g} degrees a tick"
    return judged(BETTER, holds, "; ".join(said) + ".", Cause.DATA)


def _bouts(bouts: Mapping[str, Bout]) -> Table:
    columns = [Column("they shadow by"), Column("apart", "m", OURS), Column("distance off", "m", OURS)]
    columns += [Column("facing off", "degrees", OURS, 1)]
    columns += [Column(f"time in {name}", "%", OURS, 1) for name in bouts[RULE].share]
    columns += [Column("no choice", "%", OURS, 1), *(Column(name, "", OURS) for name in bouts[RULE].counts)]
    lines: list[list[Cell]] = [
        [
            name,
            one.distance,
            one.distance_error,
            one.facing,
            *(100.0 * share for share in one.share.values()),
            100.0 * one.forced,
            *one.counts.values(),
        ]
        for name, one in bouts.items()
    ]
    return Table(f"A bout of {bouts[RULE].seconds:g} s", columns, lines)


def _trials(trials: Mapping[tuple[str, float], Trials]) -> Table:
    columns = [Column("turns up to", "degrees a tick", digits=0), Column("they shadow by")]
    columns += [Column("distance off", "m", OURS), Column("95 %", "m", OURS), Column("facing off", "degrees", OURS)]
    columns += [Column("95 %", "degrees", OURS, 1), Column("over the ground", "m/s", OURS)]
    columns += [Column("recovery", "s", OURS), Column("recovered", "%", OURS, 0)]
    lines: list[list[Cell]] = [
        [
            turn,
            name,
            one.distance.words(2),
            one.distance_p95,
            one.facing.words(1),
            one.facing_p95,
            one.moving.words(2),
            one.recovery.words(1),
            100.0 * one.recovered,
        ]
        for (name, turn), one in trials.items()
    ]
    return Table("Shadowing alone, and after a push of 2 m and 90 degrees", columns, lines)


ROW = Row(
    name="A-C",
    order=30,
    paper=PAPER,
    place="text",
    title="Control by simple rules",
    claim="Simple rules for shadowing, attacking and evading, and a supervisor with priorities, make characters circle "
    "and then fight.",
    published={},
    run=run,
)
