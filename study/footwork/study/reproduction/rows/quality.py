"""Whether motion out of a graph needs work afterwards: foot slide and jerks, bare and as shown."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.study.foot_slide import slide_of_clip
from footwork.study.graph_paths import best_path_through
from footwork.study.path_quality import path_quality
from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.motion_sets import SETS
from footwork.study.reproduction.playing import jerkiness, played_clip, slide_inside
from footwork.study.reproduction.reduced import well_connected_motion_graph
from footwork.study.reproduction.row import OURS, Cause, Column, Judgement, Result, Row, Table, judged
from footwork.study.reproduction.slides import (
    NEAR_SOURCE,
    slide_judgement,
    slide_judgements,
    slides_of_interpolation,
)
from footwork.study.reproduction.workbench import BUILT_AT, LARGE, MG, WCMG, Workbench

THRESHOLDS = {MG: 1.0, WCMG: BUILT_AT}
STOPS = 24  # captured frames that a path comes through, drawn at random
CALM = 0.95  # quantile of jerkiness over the frames of a path


def run(bench: Workbench) -> Result:
    """Random tours of both graphs, bare and as the runtime shows them."""
    lines, numbers = [], {}
    for name in SETS:
        for kind in (MG, WCMG):
            if kind == WCMG and name == LARGE and bench.quick:
                continue
            found = _measured(_graph(bench, kind, name), bench, name)
            numbers[f"{name} {kind}"] = found
            lines.append([name, kind, THRESHOLDS[kind], *found.values()])
    columns = [Column("set"), Column("graph"), Column("threshold s", digits=1)] + [
        Column(words, unit, OURS, digits)
        for words, unit, digits in (
            ("length", "s", 0),
            ("worst jump", "cm", 1),
            ("slide", "cm/s", 1),
            ("slide between jumps", "cm/s", 1),
            ("slide, as shown", "cm/s", 1),
            ("slide of source", "cm/s", 1),
            ("slide of interpolation", "cm/s", 1),
            ("of what it is made of", "cm/s", 1),
            ("jerk", "mm", 1),
            ("jerk, as shown", "mm", 1),
            ("jerk of source", "mm", 1),
        )
    ]
    return Result(
        judgements=[*_slides(numbers), _jerk(numbers)],
        tables=[Table(f"Paths through {STOPS} captured frames drawn at random", columns, lines)],
        numbers=numbers,
        notes=[
            "Jump: root mean square distance of the joints between the pose left and the one gone on from. Jerk: how "
            "far a frame is off the middle of the frames before and after it, at the 95th percentile of frames. "
            "What is not said to be shown is as it is in the graph; the server shows it inertialised, with feet held.",
            *bench.notes,
        ],
    )


def _graph(bench: Workbench, kind: str, name: str) -> MotionGraph:
    if kind == MG:
        return bench.graphs(name).standard_motion_graph(THRESHOLDS[MG])
    return well_connected_motion_graph(bench, name)


def _measured(graph: MotionGraph, bench: Workbench, name: str) -> dict[str, Any]:
    edges = _tour(graph)
    bare, shown = (played_clip(graph, edges, as_shown=as_shown) for as_shown in (False, True))
    quality = path_quality(graph, edges)
    source = np.concatenate([jerkiness(clip) for clip in bench.dataset(name).clips])
    return {
        "seconds": quality["seconds"],
        "worst_jump_cm": (quality["pose_jump_cm"] or {}).get("worst"),
        "slide_cm_s": slide_of_clip(bare).cm_per_second,
        "slide_between_jumps_cm_s": slide_inside(graph, edges).cm_per_second,
        "slide_shown_cm_s": slide_of_clip(shown).cm_per_second,
        "slide_of_source_cm_s": quality["source_foot_slide_cm_s"],
        **slides_of_interpolation(graph),
        "jerk_mm": _calm(jerkiness(bare)),
        "jerk_shown_mm": _calm(jerkiness(shown)),
        "jerk_of_source_mm": _calm(source),
    }


def _tour(graph: MotionGraph) -> NDArray[np.int64]:
    frames = np.flatnonzero(graph.original)
    stops = np.random.default_rng(0).choice(frames, STOPS)
    return best_path_through(graph, [stops[:1], *stops[1:]])


def _calm(off: NDArray[np.float64]) -> float:
    return float(1000.0 * np.quantile(off, CALM))


def _slides(numbers: dict[str, dict[str, Any]]) -> list[Judgement]:
    names = {name: f"slide_{name}_cm_s" for name in ("interpolated", "made_of")}
    names |= {"slide": "slide_cm_s", "shown": "slide_shown_cm_s", "source": "slide_of_source_cm_s"}
    found = {name: {key: one[of] for key, of in names.items()} for name, one in _well(numbers)}
    shown = "As the server shows them, feet slide no more than in the captures."
    return [*slide_judgements(found), slide_judgement(shown, "shown", "source", found, None)]


def _jerk(numbers: dict[str, dict[str, Any]]) -> Judgement:
    claim = "Motion is no more jerky than in the captures."
    pairs = {name: (one["jerk_mm"], one["jerk_of_source_mm"]) for name, one in _well(numbers)}
    reason = ", ".join(f"{name} {ours:.1f} against {source:.1f} mm" for name, (ours, source) in pairs.items())
    holds = all(ours <= NEAR_SOURCE * source for ours, source in pairs.values())
    shown = ", ".join(f"{one['jerk_shown_mm']:.1f}" for _, one in _well(numbers))
    return judged(claim, holds, f"{reason}; {shown} mm as shown.", Cause.CLAIM)


def _well(numbers: dict[str, dict[str, Any]]) -> list[tuple[str, dict[str, Any]]]:
    return [(name.removesuffix(f" {WCMG}"), one) for name, one in numbers.items() if name.endswith(WCMG)]


ROW = Row(
    name="Z-Q",
    order=120,
    paper=zhao_safonova.PAPER,
    place="text",
    title="Motion without work afterwards",
    claim="Motion out of a well-connected graph needs no post-processing.",
    published={},
    run=run,
)
