"""All measures of one motion graph, as figures for people and machines (JSON-able)."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph
from footwork.motion.metric import UNIT
from footwork.study.behaviour_times import behaviour_times
from footwork.study.maneuverability import maneuverability
from footwork.study.path_quality import path_quality, pose_jumps, windowed_costs
from footwork.study.responsiveness import evenly
from footwork.study.tour import tour, tour_labels
from footwork.study.transition_times import TransitionTimes, transition_times

SAMPLED_SOURCES = 512
_EXACT_WORK = 1_000_000_000  # sources times edges: what a few seconds are enough for
_JUMPS = 1024


def graph_report(graph: MotionGraph, frames: int | None = None) -> dict[str, Any]:
    """Connectivity, transition times, maneuverability, times between kinds of motion, jumps, and a tour of it all.

    Args:
        graph: any motion graph.
        frames: how many frames were captured, where the graph holds but a part of them.
    """
    times = frame_times(graph)
    return {
        "connectivity": _connectivity(graph, times, frames),
        "transition_time": times.summary(),
        **_maneuverability(graph),
        **_kind_times(graph),
        "transition_jumps": _jumps(graph),
        "tour": _tour(graph),
    }


def frame_times(graph: MotionGraph) -> TransitionTimes:
    """Times between the captured frames of a graph; of a large one from SAMPLED_SOURCES of them."""
    frames = np.flatnonzero(graph.original)
    exact = len(frames) * graph.edge_count <= _EXACT_WORK
    return transition_times(graph.edge_start, graph.target, frames, sources=None if exact else SAMPLED_SOURCES)


def kinds_of(graph: MotionGraph) -> dict[str, tuple[NDArray, Sequence[str]]]:
    """The two ways to tell kinds of motion apart: index of each node (N,) and words, by name."""
    return {"label": (graph.label, graph.labels), "behaviour": (graph.behaviour, graph.behaviours)}


def _connectivity(graph: MotionGraph, times: TransitionTimes, frames: int | None) -> dict[str, float | None]:
    """Of all ordered pairs of captured frames, those inside the graph count as far as they are connected in it."""
    inside = int(graph.original.sum())
    pairs = inside * (inside - 1) * times.reachable_share
    return {
        "scc_fraction": inside / frames if frames else None,
        "closure_share": pairs / (frames * (frames - 1)) if frames and frames > 1 else None,
        "reachable_share": times.reachable_share,
        "edges_per_node": graph.edge_count / graph.node_count,
    }


def _maneuverability(graph: MotionGraph) -> dict[str, Any]:
    report: dict[str, Any] = {"maneuverability_s": {}}
    for name, (kind, words) in kinds_of(graph).items():
        plain = maneuverability(graph.edge_start, graph.target, kind, words)
        again = maneuverability(graph.edge_start, graph.target, kind, words, reentry=True)
        captured = np.flatnonzero(graph.original)
        even = maneuverability(graph.edge_start, graph.target, kind, words, frames=captured)
        report["maneuverability_s"] |= {
            f"{name}s": plain.mean,
            f"{name}s_entered_anew": again.mean,
            f"{name}s_from_captured_frames": even.mean,
        }
        anew = again.by_kind()
        report[f"maneuverability_by_{name}"] = [
            {name: word or "none", "seconds": seconds, "entered_anew_seconds": anew[word]}
            for word, seconds in plain.by_kind().items()
        ]
    return report


def _kind_times(graph: MotionGraph) -> dict[str, Any]:
    """Times between labels and between behaviours in both readings, a row for each that is left."""
    report = {}
    for name, (kind, words) in kinds_of(graph).items():
        times = behaviour_times(graph.edge_start, graph.target, kind, words, np.flatnonzero(graph.original))
        for reading, table in times.tables().items():
            rows = [
                {"from": start or "none"} | {end or "none": value for end, value in row.items()}
                for start, row in table.items()
            ]
            report[f"{name}_times_{reading}"] = rows
    return report


def _jumps(graph: MotionGraph) -> dict[str, Any] | None:
    """How far transitions jump, of up to 1,024 of them, and how well their costs agree with the poses."""
    edges = evenly(np.flatnonzero(~graph.natural), _JUMPS).astype(np.int64) if not graph.natural.all() else None
    if edges is None:
        return None
    cost, jump = graph.cost[edges], 100.0 * pose_jumps(graph, edges)
    again = windowed_costs(graph, edges)
    known = np.isfinite(again)
    return {
        "sampled": len(edges),
        "worst_s": float(cost.max()),
        "mean_s": float(cost.mean()),
        "worst_cm": float(100.0 * UNIT * np.sqrt(cost.max())),
        "worst_pose_jump_cm": float(jump.max()),
        "mean_pose_jump_cm": float(jump.mean()),
        "costs_computed_anew": int(known.sum()),
        "greatest_difference_s": float(np.abs(again - cost)[known].max()) if known.any() else None,
    }


def _tour(graph: MotionGraph) -> dict[str, Any] | None:
    edges = tour(graph)
    return None if edges is None else {"through": tour_labels(graph)} | path_quality(graph, edges)
