"""How many segments each state of the fighting capture has, how long they are, and how soon a strike can begin."""

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

import numpy as np

from footwork.motion.annotation import Annotation
from footwork.motion.bundle import Bundle
from footwork.motion.graph import MotionGraph
from footwork.study.contact_sheet import contact_sheet
from footwork.study.graph_paths import path_clip
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
from footwork.study.reproduction.state_annotated import MACHINE, MOVING, PAPER, STATES
from footwork.study.reproduction.words import joined_words
from footwork.study.reproduction.workbench import Workbench
from footwork.study.state_paths import path_through_states
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

SET = "fighting"
AT_KNEE = "at the knee"
THRESHOLD: float | Literal["auto"] = "auto"
OTHERS = (3.0, 5.0, 10.0)
FAR_BELOW = 0.5  # of a mean locomotion segment
GO_ON = 45  # ticks in each state of the picture, at most
SHORT_AND_MANY = "Locomotion nodes are short and many: shorter and more than those of attack and of evade."
QUICK = "The delay to a strike or an evasion is far below one locomotion node: under half of the mean one."
REACHED = "From every locomotion node every attack and every evade can be reached over frames of these states alone."
Report = Mapping[str, Any]


def run(bench: Workbench) -> Result:
    """Build the annotated graph at the knee and at other thresholds, and count."""
    if not (bench.motions.folder / SET).is_dir():
        reason = f"The motions have no folder {SET}."
        return Result([unjudged(claim, reason, Cause.DATA) for claim in (SHORT_AND_MANY, QUICK, REACHED)])
    bundle, report = _built(bench, GraphOptions(graph="annotated", threshold=THRESHOLD))
    found = {AT_KNEE: report}
    if not bench.quick:
        mirrored = GraphOptions(graph="annotated", threshold=report["threshold"], mirror=True)
        found[f"{AT_KNEE}, mirrored"] = _built(bench, mirrored)[1]
        for threshold in OTHERS:
            found[f"at {threshold:g}"] = _built(bench, GraphOptions(graph="annotated", threshold=threshold))[1]
    return Result(
        judgements=[_short_and_many(report), _quick(found), _reached(found)],
        tables=[_table(report), _by_threshold(found), _steps(report)],
        figures=[_sheet(bundle.graph, bundle.annotation)] if bundle.annotation else [],
        numbers=found,
        notes=[
            "A node of the paper is a segment of ours: a stretch of a clip without a branch. Its delays leave open "
            "whether they are to every attack or to the nearest one; both are given. They count the segments between "
            "the two only, as the published ones are shorter than a mean locomotion node.",
            "The paper labels whole files, ours are labelled by the frame. Stances that only lead into a strike, or "
            "out of one, count as its wind-up or recovery; the published steps would delete them, and the strikes with "
            "them (last line of the last table).",
            "In all from a frame: until the nearest segment begins, from locomotion frames drawn evenly, the rest of "
            "their own segment included.",
        ],
    )


def _built(bench: Workbench, options: GraphOptions) -> tuple[Bundle, Report]:
    bench.tell(f"{SET}, states at {options.threshold}", 0.0)
    return build_bundle(bench.dataset(SET, whole=True), options, machine=MACHINE)


def _states(report: Report) -> dict[str, Report]:
    return {state["state"]: state for state in report["states"]}


def _delays(report: Report) -> dict[str, Report]:
    return {pair["to"]: pair for pair in report["at_once"]}


def _short_and_many(report: Report) -> Judgement:
    states = _states(report)
    moving, others = states[MOVING], [state for name, state in states.items() if name != MOVING]
    holds = all(
        moving["segments"] > state["segments"] and moving["mean_segment_s"] < state["mean_segment_s"]
        for state in others
    )
    reason = joined_words(
        [f"{state['segments']} of {name} of {state['mean_segment_s']:.2f} s" for name, state in states.items()]
    )
    return judged(SHORT_AND_MANY, holds, f"{AT_KNEE.capitalize()} {reason}.", Cause.DATA)


def _quick(found: Mapping[str, Report]) -> Judgement:
    said, holds = [], False
    for name, report in found.items():
        one = _states(report)[MOVING]["mean_segment_s"]
        near = [pair["nearest_s"] for pair in report["at_once"]]
        if name == AT_KNEE:
            holds = max(near) < FAR_BELOW * one
        said.append(f"{name} {joined_words([f'{seconds:.2f} s' for seconds in near])} against {one:.2f} s")
    reason = f"To the nearest {' and '.join(_delays(found[AT_KNEE]))}: {', '.join(said)}."
    more = " Our capture has a ninth of the paper's attack, in a few long takes: few stances are like a strike's first."
    return judged(QUICK, holds, reason if holds else reason + more, Cause.DATA)


def _reached(found: Mapping[str, Report]) -> Judgement:
    missing = [
        f"{name}: {pair['pairs_without_way']} of {pair['pairs']} pairs to {pair['to']}"
        for name, report in found.items()
        for pair in report["at_once"]
        if pair["pairs_without_way"]
    ]
    counts = [f"{pair['pairs']:,} pairs to {pair['to']}" for pair in found[AT_KNEE]["at_once"]]
    reason = f"Without a way are {joined_words(missing)}." if missing else f"All {joined_words(counts)} have a way."
    return judged(REACHED, not missing, reason, Cause.DATA)


def _table(report: Report) -> Table:
    columns = [Column("state"), Column("nodes", "", PUBLISHED), Column("mean length", "s", PUBLISHED)]
    columns += [Column("delay", "s", PUBLISHED), Column("nodes", "", OURS), Column("mean length", "s", OURS)]
    columns += [Column("delay to all", "s", OURS), Column("to the nearest", "s", OURS)]
    columns += [Column("longest", "s", OURS, 1), Column("in all from a frame", "s", OURS)]
    lines: list[list[Cell]] = []
    for name, theirs in STATES.items():
        state, pair = _states(report)[name], _delays(report).get(name, {})
        delays = [pair.get(key) for key in ("mean_s", "nearest_s", "longest_s", "from_frames_s")]
        lines.append([name, *theirs.values(), state["segments"], state["mean_segment_s"], *delays])
    return Table(f"States at the knee of the costs, s < {report['threshold']:.2f}", columns, lines)


def _by_threshold(found: Mapping[str, Report]) -> Table:
    columns = [Column("graph"), Column("frames kept", "%", OURS, 1)]
    for name in STATES:
        columns += [Column(f"{name} nodes", "", OURS), Column(f"mean {name}", "s", OURS)]
    for name in _delays(found[AT_KNEE]):
        columns += [Column(f"to all {name}s", "s", OURS), Column(f"nearest {name}", "s", OURS)]
    lines: list[list[Cell]] = []
    for name, report in found.items():
        line: list[Cell] = [name, 100.0 * report["scc_fraction"]]
        for state in STATES:
            line += [_states(report)[state][key] for key in ("segments", "mean_segment_s")]
        for pair in _delays(report).values():
            line += [pair["mean_s"], pair["nearest_s"]]
        lines.append(line)
    return Table("By threshold", columns, lines)


def _steps(report: Report) -> Table:
    names = [state["state"] for state in report["states"]]
    columns = [Column("step"), Column("frames", "", OURS), *(Column(name, "", OURS) for name in names)]
    lines: list[list[Cell]] = [
        [step["step"], step["nodes"], *(step[name] for name in names)] for step in report["steps"]
    ]
    published = report["as_published"]
    lines.append(["as published, nothing handed over", published["nodes"], *(published[name] for name in names)])
    return Table("Frames that each step leaves at the knee", columns, lines)


def _sheet(graph: MotionGraph, notes: Annotation) -> Figure:
    names = (MOVING, "attack", MOVING, "evade", MOVING)
    numbers = [MACHINE.names.index(name) for name in names]
    longest = notes.of_state(numbers[0])
    start = int(notes.first[longest[np.argmax(notes.length[longest])]])
    clip = path_clip(graph, path_through_states(graph, notes, start, numbers[1:], GO_ON), f"{SET}: {', '.join(names)}")
    with TemporaryDirectory() as folder:
        png = contact_sheet(Path(folder) / "path.png", clip).read_bytes()
    return Figure(
        caption=f"{joined_words(names).capitalize()} by the quickest ways. The strip under the poses has the labels of "
        "the capture, so a wind-up shows as locomotion.",
        alt=f"Poses along a path through {joined_words(names)}",
        png=png,
    )


ROW = Row(
    name="A-T1",
    order=10,
    paper=PAPER,
    place="Table 1",
    title="States and delays",
    claim="76 attack nodes of 2.57 s, 54 evade nodes of 1.30 s and 702 locomotion nodes of 0.19 s; from locomotion an "
    "attack is 0.04 s away on average, an evade 0.05 s.",
    published=STATES,
    run=run,
)
