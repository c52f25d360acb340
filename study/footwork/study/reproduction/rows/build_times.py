"""How long building takes."""

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.graphs import Graphs
from footwork.study.reproduction.reduced import MU, reduction, reduction_of
from footwork.study.reproduction.row import OURS, PUBLISHED, Cell, Column, Result, Row, Table, judged
from footwork.study.reproduction.workbench import BUILT_AT, LARGE, WEIGHTS, Workbench

QUICK_SET = "dataset2"
MINUTE = 60.0
STAGES = {
    "interpolation": "interpolation",
    f"transitions at {BUILT_AT:g}": "transitions",
    f"reduction at {MU:g}": "reduction",
}


def run(bench: Workbench) -> Result:
    """Build one graph anew, step by step."""
    name = QUICK_SET if bench.quick else LARGE
    seconds = _seconds(bench, name)
    total = sum(seconds.values())
    theirs = zhao_safonova.BUILD_SECONDS
    least = sum(shortest for shortest, _ in theirs.values())
    frames = sum(clip.frame_count for clip in bench.dataset(name).clips)
    lines: list[list[Cell]] = [[step, _published(theirs[step]), seconds[step]] for step in seconds]
    return Result(
        judgements=[
            judged(
                "The build takes minutes where the paper's took five hours.",
                total < 10 * MINUTE,
                f"{total:.0f} s in all, {least / total:.0f} times as fast, for {frames:,} frames.",
            )
        ],
        tables=[
            Table(
                f"Building the well-connected graph of {name} ({frames:,} frames) at {BUILT_AT}, mu = {MU:g}",
                [Column("step"), Column("time", "s", PUBLISHED, 0), Column("time", "s", OURS, 1)],
                [*lines, ["in all", f"{least:,.0f} at least", total]],
            )
        ],
        numbers={"set": name, "frames": frames, "seconds": seconds | {"total": total}},
        notes=[
            f"The published times are for {zhao_safonova.SIZES[LARGE]:,} frames on a computer of 2008. Our search is "
            "exact as theirs, but rules out most pairs of frames without comparing them.",
            *bench.notes,
        ],
    )


def _seconds(bench: Workbench, name: str) -> dict[str, float]:
    """Time by step: of the build that other rows have used already if it is all there, of a new one otherwise."""
    reduction(bench, name, MU)
    graphs = bench.graphs(name)
    if not set(STAGES) <= set(graphs.stages.seconds):
        hops = BUILT_AT if name == LARGE else None
        graphs = Graphs(name, bench.dataset(name).clips, WEIGHTS, bench.tell, hops=hops)
        reduction_of(graphs, MU)
    return {step: graphs.stages.seconds[stage] for stage, step in STAGES.items()}


def _published(seconds: tuple[float, float]) -> str:
    return " to ".join(f"{one:,.0f}" for one in sorted(set(seconds)))


ROW = Row(
    name="Z-B",
    order=100,
    paper=zhao_safonova.PAPER,
    place="text",
    title="Build times",
    claim="For 2,721 frames interpolating took 7 s, finding transitions 4.5 h, and reduction half an hour to an hour.",
    published=zhao_safonova.BUILD_SECONDS,
    run=run,
)
