"""What the suboptimality scalar buys: a smaller graph for a slower character."""

from dataclasses import dataclass
from itertools import pairwise

from footwork.study.maneuverability import maneuverability
from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.charts import WELL, Axis, Series, line_charts
from footwork.study.reproduction.flat_graph import FlatGraph
from footwork.study.reproduction.graph_bytes import BytesEach, bytes_each
from footwork.study.reproduction.reduced import reduced_graph, reduction
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
)
from footwork.study.reproduction.workbench import BUILT_AT, LARGE, Workbench
from footwork.study.transition_times import transition_times

QUICK_SET = "dataset2"
SCALARS = tuple(zhao_safonova.SUBOPTIMALITY)
SMALL = 5.0  # nodes fall at least so many times from the first scalar to the last
SLOWER = 1.1  # local maneuverability up to a scalar of 2, against that of the best paths


@dataclass(frozen=True)
class Reduced:
    """A graph after reduction: sizes, what its largest part can do, and how long reducing took."""

    nodes: int
    edges: int
    frames: int
    lm: float | None
    time: float
    megabytes: float
    seconds: float


def run(bench: Workbench) -> Result:
    """Reduce one graph with each scalar."""
    name = QUICK_SET if bench.quick else LARGE
    standard = bench.graphs(name).standard_motion_graph(BUILT_AT)
    each = bytes_each(standard)
    found = {mu: _reduced(bench, name, mu, each) for mu in SCALARS}
    frames = bench.graphs(name).chains.original_count
    return Result(
        judgements=[_size(found), _slow(found)],
        tables=[_table(name, found, frames)],
        figures=[_figure(name, found, frames)],
        numbers={mu: vars(one) for mu, one in found.items()},
        notes=[
            f"The largest part of the standard graph ({standard.node_count:,} frames) takes "
            f"{each.megabytes(standard.node_count, standard.edge_count):.1f} MB, in single precision. "
            "The paper does not say what it stores.",
            "Way: the mean shortest way between captured frames. Frames are those in the largest part.",
            "Frames are sources in their own order, one after the other, so what is kept depends on what came before.",
            *bench.notes,
        ],
    )


def _reduced(bench: Workbench, name: str, mu: float, each: BytesEach) -> Reduced:
    whole = reduced_graph(bench, name, mu)
    part = whole.connected()
    return Reduced(
        nodes=whole.node_count,
        edges=whole.edge_count,
        frames=len(part.frames),
        lm=_maneuverability(part),
        time=transition_times(part.edge_start, part.target, part.frames).mean or 0.0,
        megabytes=each.megabytes(whole.node_count, whole.edge_count),
        seconds=reduction(bench, name, mu).seconds,
    )


def _maneuverability(part: FlatGraph) -> float | None:
    """Seconds; None for a graph of one label, where there is nothing to change to."""
    found = maneuverability(part.edge_start, part.target, part.kind, part.kinds)
    return found.mean if len(found.kinds) > 1 else None


def _size(found: dict[float, Reduced]) -> Judgement:
    first, last = found[SCALARS[0]], found[SCALARS[-1]]
    falls = all(after.nodes <= before.nodes for before, after in pairwise(found.values()))
    reason = (
        f"{first.nodes:,} nodes at {SCALARS[0]:g}, {found[5.0].nodes:,} at 5, {last.nodes:,} at {SCALARS[-1]:g}: "
        f"{first.nodes / last.nodes:.1f} times fewer (published {_published_fall():.1f}), "
        f"{'falling' if falls else 'not falling'} throughout."
    )
    return judged("The size falls fast as the scalar rises.", falls and first.nodes >= SMALL * last.nodes, reason)


def _published_fall() -> float:
    nodes = [nodes for nodes, _, _ in zhao_safonova.SUBOPTIMALITY.values()]
    return nodes[0] / nodes[-1]


def _slow(found: dict[float, Reduced]) -> Judgement:
    claim = "Local maneuverability rises slowly at first, then fast."
    if found[1.0].lm is None:
        claim = "The mean transition time (there is one label only) rises slowly at first, then fast."
    times = {mu: one.time if one.lm is None else one.lm for mu, one in found.items()}
    reason = ", ".join(f"{times[mu]:.2f} s at {mu:g}" for mu in (1.0, 2.0, 5.0, SCALARS[-1])) + "."
    holds = times[2.0] <= SLOWER * times[1.0] and times[SCALARS[-1]] >= times[1.0]
    return judged(claim, holds, reason, Cause.CONVENTION)


def _table(name: str, found: dict[float, Reduced], frames: int) -> Table:
    columns = [Column("mu", digits=1)]
    columns += [Column("nodes", "", PUBLISHED), Column("per frame", "", PUBLISHED, 1), Column("LM", "s", PUBLISHED)]
    columns += [Column("size", "MB", PUBLISHED), Column("nodes", "", OURS), Column("edges", "", OURS)]
    columns += [Column("per frame", "", OURS, 1), Column("LM", "s", OURS), Column("way", "s", OURS)]
    columns += [Column("size", "MB", OURS, 1), Column("frames", "", OURS), Column("reduction", "s", OURS, 1)]
    lines = [_line(mu, one, frames) for mu, one in found.items()]
    caption = f"Well-connected graph of {name} at {BUILT_AT} after reduction, against {LARGE} of the paper"
    return Table(caption, columns, lines)


def _line(mu: float, one: Reduced, frames: int) -> list[Cell]:
    nodes, lm, megabytes = zhao_safonova.SUBOPTIMALITY[mu]
    published = [nodes, nodes / zhao_safonova.SIZES[LARGE], lm, megabytes]
    ours = [one.nodes, one.edges, one.nodes / frames, one.lm, one.time, one.megabytes, one.frames, one.seconds]
    return [mu, *published, *ours]


def _figure(name: str, found: dict[float, Reduced], frames: int) -> Figure:
    published = zhao_safonova.SUBOPTIMALITY
    theirs = [nodes / zhao_safonova.SIZES[LARGE] for nodes, _, _ in published.values()]
    mu = Axis("suboptimality scalar", log=True, ticks=(1, 2, 5, 10, 20, 50, 100))
    nodes = [
        Series("ours", SCALARS, [one.nodes / frames for one in found.values()], WELL),
        Series("published", SCALARS, theirs, WELL, published=True),
    ]
    times = [
        Series("ours", SCALARS, [one.time if one.lm is None else one.lm for one in found.values()], WELL),
        Series("published", SCALARS, [lm for _, lm, _ in published.values()], WELL, published=True),
    ]
    title = "local maneuverability" if found[1.0].lm is not None else "mean time (ours), local maneuverability"
    return Figure(
        caption=f"Nodes for each captured frame, and local maneuverability, after reducing {name}.",
        alt="Size and local maneuverability against the suboptimality scalar",
        svg=line_charts(
            [
                ("size", nodes, mu, Axis("nodes per frame", log=True, ticks=(1, 2, 5, 10, 20, 50))),
                (
                    title,
                    times,
                    mu,
                    Axis("s", limits=(0.0, None)),
                ),
            ]
        ),
    )


ROW = Row(
    name="Z-T5",
    order=90,
    paper=zhao_safonova.PAPER,
    place="Table 5",
    title="Size against suboptimality",
    claim="Allowing paths to cost a little more than the best ones makes the graph many times smaller: local "
    "maneuverability rises slowly, with a knee near 5.",
    published={**zhao_safonova.SUBOPTIMALITY, "standard": zhao_safonova.STANDARD_SIZE},
    run=run,
)
