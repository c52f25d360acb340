"""How fast two fighters run, and how long their graph takes to build."""

import time

from footwork.motion.tick import TICK_RATE
from footwork.runtime.match import FightGround, Match, table_of
from footwork.study.reproduction.fights import STYLE, fight_bundle, ground_of, without_fighting
from footwork.study.reproduction.row import OURS, PUBLISHED, Cause, Column, Judgement, Result, Row, Table, judged
from footwork.study.reproduction.state_annotated import PAPER
from footwork.study.reproduction.workbench import Workbench

FRAMES = 15.0  # a second, of two characters
BUILD_HOURS = 2.0  # "several"
TICKS, RUNS = 3000, 5
FASTER = "Two fighters run in real time, and faster than the published 15 frames a second."
BUILD = "The build takes less than the published several hours."


def run(bench: Workbench) -> Result:
    """Ticks a second of a match with poses, decisions included, on one processor; seconds of the build."""
    if missing := without_fighting(bench, (FASTER, BUILD)):
        return Result(missing)
    ground, report = ground_of(bench), fight_bundle(bench)[1]
    rate, decisions = _pace(ground)
    seconds = report["seconds"]["total"]
    columns = [Column("what"), Column("paper", "", PUBLISHED, 1), Column("here", "", OURS, 1)]
    return Result(
        judgements=[_faster(rate), _build(seconds)],
        tables=[
            Table(
                "Speed",
                columns,
                [
                    ["frames a second, two characters", FRAMES, rate],
                    ["times as fast as 30 a second", FRAMES / TICK_RATE, rate / TICK_RATE],
                    ["microseconds a decision, all that goes on between counted", None, 1e6 / decisions],
                    ["build, seconds", None, seconds],
                ],
            )
        ],
        numbers={"ticks_per_second": rate, "decisions_per_second": decisions, "build_s": seconds},
        notes=[
            "One processor, poses smoothed and feet held, the best of a few runs; the paper's was of its time.",
            "Nothing is searched for while they run: ways to strikes and evasions are looked up, and look-ahead is "
            "over one action.",
        ],
    )


def _pace(ground: FightGround) -> tuple[float, float]:
    """Ticks and decisions a second."""
    match = Match(ground, (STYLE, STYLE), 1, shadowing=table_of(ground.bundle))
    match.play(30, shown=True)
    best, made = 0.0, 0.0
    for _ in range(RUNS):
        before, started = int(match.tally.of["decisions"].sum()), time.perf_counter()
        match.play(TICKS, shown=True)
        taken = time.perf_counter() - started
        if TICKS / taken > best:
            best, made = TICKS / taken, (int(match.tally.of["decisions"].sum()) - before) / taken
    return best, made


def _faster(rate: float) -> Judgement:
    reason = f"{rate:,.0f} frames a second, {rate / TICK_RATE:,.0f} times real time at 30."
    return judged(FASTER, rate > max(FRAMES, TICK_RATE), reason, Cause.CLAIM)


def _build(seconds: float) -> Judgement:
    return judged(BUILD, seconds < 3600.0 * BUILD_HOURS, f"{seconds:.1f} s, reading left out.", Cause.CLAIM)


ROW = Row(
    name="A-R",
    order=20,
    paper=PAPER,
    place="text",
    title="Speed",
    claim="Two characters run at 15 frames a second without any search at run time; building takes several hours.",
    published={"frames_per_second": FRAMES, "build": "several hours"},
    run=run,
)
