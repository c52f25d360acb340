"""Best paths through chosen poses, as contact sheets."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.study.contact_sheet import contact_sheet
from footwork.study.graph_paths import best_path_through, path_clip
from footwork.study.path_quality import path_quality
from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.playing import slide_inside
from footwork.study.reproduction.reduced import MU, well_connected_motion_graph
from footwork.study.reproduction.row import (
    OURS,
    Cause,
    Column,
    Figure,
    Judgement,
    Result,
    Row,
    Table,
    judged,
)
from footwork.study.reproduction.slides import slide_judgements, slides_of_interpolation
from footwork.study.reproduction.words import joined_words
from footwork.study.reproduction.workbench import BUILT_AT, LARGE, Workbench
from footwork.study.tour import middles, tour_labels

STEPS = "dataset1"
THROUGH = ("walk", "run", "jump", "duck")
GO_ON = 15  # frames to go on naturally at each stop


def run(bench: Workbench) -> Result:
    """Paths from the slowest walk to the fastest and back, and through four behaviours."""
    paths = [("short steps, long steps, short steps", STEPS, *_steps(bench))]
    missing: list[str] = []
    if not bench.quick:
        graph = well_connected_motion_graph(bench, LARGE)
        there = [label for label in THROUGH if label in tour_labels(graph)]
        missing = [label for label in THROUGH if label not in there]
        if len(there) > 1:
            paths.append((", ".join(there), LARGE, graph, _behaviours(graph, there)))
    quality = [_quality(graph, edges) for _, _, graph, edges in paths]
    names = [name for name, _, _, _ in paths]
    return Result(
        judgements=[_smooth(names, quality), *slide_judgements(dict(zip(names, map(_slides, quality), strict=True)))],
        tables=[_table(names, quality)],
        figures=[_sheet(*path) for path in paths],
        numbers=dict(zip(names, quality, strict=True)),
        notes=[
            f"Well-connected graphs at a threshold of {BUILT_AT}, reduced at mu = {MU:g}. A path is the cheapest that "
            f"comes through the middle of a captured stretch of each kind, and goes on there for {GO_ON} frames. Poses "
            "are shown as they are in the graph: nothing is blended, smoothed or held to the ground.",
            "The frames of a path between two captured ones are labelled as the heavier one.",
            "Slide between jumps is above that of all source clips where a path comes through captured frames that "
            "slide more than others. The last two columns are of all interpolated frames of the graph.",
            *([f"Not in the largest part of {LARGE}: {joined_words(missing)}."] if missing else []),
            *bench.notes,
        ],
    )


def _steps(bench: Workbench) -> tuple[MotionGraph, NDArray[np.int64]]:
    """From the slowest clip of one walker to the fastest and back: step length and speed go together in walking."""
    graph = well_connected_motion_graph(bench, STEPS)
    clips = bench.dataset(STEPS).clips
    speed = [np.linalg.norm((clip.root_position[-1] - clip.root_position[0])[[0, 2]]) / clip.seconds for clip in clips]
    slow, fast = (_middle(graph, number) for number in (int(np.argmin(speed)), int(np.argmax(speed))))
    return graph, best_path_through(graph, [slow, fast, slow], ticks=GO_ON)


def _middle(graph: MotionGraph, clip: int) -> NDArray[np.intp]:
    nodes = np.flatnonzero(graph.original & (graph.clip == clip))
    return nodes[len(nodes) // 2 : len(nodes) // 2 + 1]


def _behaviours(graph: MotionGraph, labels: Sequence[str]) -> NDArray[np.int64]:
    stops = [middles(graph, label) for label in labels]
    return best_path_through(graph, [stops[0][:1], *stops[1:]], ticks=GO_ON)


def _quality(graph: MotionGraph, edges: NDArray[np.int64]) -> dict[str, Any]:
    between = {"slide_between_jumps_cm_s": slide_inside(graph, edges).cm_per_second}
    return path_quality(graph, edges) | between | slides_of_interpolation(graph)


def _slides(quality: dict[str, Any]) -> dict[str, float | None]:
    made = {name: quality[f"slide_{name}_cm_s"] for name in ("interpolated", "made_of")}
    return made | {"slide": quality["foot_slide_cm_s"], "source": quality["source_foot_slide_cm_s"]}


def _smooth(names: Sequence[str], quality: Sequence[dict[str, Any]]) -> Judgement:
    limit = zhao_safonova.SMOOTH_UNDER
    worst = [one["transition_s"]["worst"] if one["transition_s"] else 0.0 for one in quality]
    reason = ", ".join(f"{name}: {cost:.2f}" for name, cost in zip(names, worst, strict=True))
    claim = f"No transition on the paths reaches {limit}, under which no discontinuity is seen."
    return judged(claim, max(worst) < limit, f"Worst s on {reason}.", Cause.CONVENTION)


def _table(names: Sequence[str], quality: Sequence[dict[str, Any]]) -> Table:
    columns = [Column("path")] + [
        Column(name, unit, OURS, digits)
        for name, unit, digits in (
            ("length", "s", 1),
            ("transitions", "", 0),
            ("worst s", "", 2),
            ("mean s", "", 2),
            ("worst pose jump", "cm", 1),
            ("slide", "cm/s", 1),
            ("slide between jumps", "cm/s", 1),
            ("slide of the source", "cm/s", 1),
            ("slide of interpolation", "cm/s", 1),
            ("of what it is made of", "cm/s", 1),
        )
    ]
    lines = []
    for name, one in zip(names, quality, strict=True):
        cost, jump = one["transition_s"] or {}, one["pose_jump_cm"] or {}
        costs = (cost.get("worst"), cost.get("mean"), jump.get("worst"))
        slides = (one["foot_slide_cm_s"], one["slide_between_jumps_cm_s"], one["source_foot_slide_cm_s"])
        made = (one["slide_interpolated_cm_s"], one["slide_made_of_cm_s"])
        lines.append([name, one["seconds"], one["transitions"], *costs, *slides, *made])
    return Table("The paths: s of their transitions, root mean square jump of the pose, foot slide", columns, lines)


def _sheet(name: str, set_name: str, graph: MotionGraph, edges: NDArray[np.int64]) -> Figure:
    clip = path_clip(graph, edges, f"{set_name}: {name}")
    with TemporaryDirectory() as folder:
        png = contact_sheet(Path(folder) / "path.png", clip).read_bytes()
    words = joined_words(sorted({str(label) for label in clip.labels}))
    return Figure(
        caption=f"{set_name}: {name}. Left limbs are blue, right ones orange; dots under the feet show which stand.",
        alt=f"Poses along a path through {words}",
        png=png,
    )


ROW = Row(
    name="Z-F1,2",
    order=110,
    paper=zhao_safonova.PAPER,
    place="Figures 1 and 2",
    title="Paths through chosen poses",
    claim="Paths from walking over running and jumping to ducking, and between short and long steps, are smooth; under "
    "a threshold of 0.6 no discontinuity is seen.",
    published={"smooth_under": zhao_safonova.SMOOTH_UNDER},
    run=run,
)
