"""What is in a bundle, or in clips before a bundle is made of them, as figures (JSON-able)."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.bundle_controller import bundle_controller
from footwork.motion.bundle import Bundle
from footwork.motion.clip import Clip
from footwork.motion.graph import ARRAYS
from footwork.motion.shadowing_table import ShadowingTable
from footwork.motion.table import PolicyTable
from footwork.study.foot_slide import Slide, slide_of_capture, slide_of_clip
from footwork.study.graph_report import graph_report
from footwork.study.responsiveness import responsiveness
from footwork.study.speed_response import speed_response
from footwork.training.state_report import state_report


def inspect_bundle(bundle: Bundle) -> dict[str, Any]:
    """Sizes, frames by label and behaviour, measures of the graph, responsiveness, tables, and where it all came from.

    ``connectivity`` has the shares of the captured frames that the graph keeps, of their ordered pairs that have a way
    in it, and of those pairs whose frames it keeps, and the mean number of edges from a node. Seconds between captured
    frames are ``transition_time``; those to and between kinds of motion are given for labels and for behaviours
    (``graph_report``). ``tour`` is a best path through all labels. ``responsiveness`` is that of the "steering" table,
    with ``speeds`` where some can be asked for (``speed_response``), None without one. A state-annotated graph has
    ``segments``, ``states`` and ``at_once`` too (``state_report``), and ``shadowing`` where one of its states is.
    """
    graph = bundle.graph
    sizes = {"graph": sum(getattr(graph, name).nbytes for name in ARRAYS)}
    sizes |= {f"table {name}": table.coded.nbytes for name, table in bundle.tables.items()}
    sizes |= {} if bundle.shadowing is None else {"table shadowing": bundle.shadowing.nbytes}
    steering = bundle.tables.get("steering")
    return {
        "digest": bundle.digest,
        "clips": len(np.unique(graph.clip[graph.original])),
        "nodes": graph.node_count,
        "captured_frames": int(graph.original.sum()),
        "edges": graph.edge_count,
        "transitions": int((~graph.natural).sum()),
        "bytes": sizes | {"total": sum(sizes.values())},
        "joints": graph.skeleton.joint_count,
        "labels": _counts(graph.labels, graph.label),
        "behaviours": _counts(graph.behaviours, graph.behaviour),
        **(state_report(bundle.annotation) if bundle.annotation else {}),
        **graph_report(graph, bundle.provenance.get("counts", {}).get("frames")),
        "source_foot_slide_cm_s": slide_of_capture(graph).cm_per_second,
        "responsiveness": _responsiveness(bundle, steering) if steering else None,
        "tables": {name: _table(table) for name, table in bundle.tables.items()},
        **({} if bundle.shadowing is None else {"shadowing": _shadowing(bundle.shadowing)}),
        "attribution": list(bundle.attribution),
        "provenance": dict(bundle.provenance),
    }


def _responsiveness(bundle: Bundle, table: PolicyTable) -> dict[str, Any]:
    graph, controller = bundle.graph, bundle_controller(bundle)
    report = responsiveness(graph, controller, table.task.turn_limit(graph.behaviour))
    return report | {"speeds": speed_response(graph, controller)} if controller.speeds else report


def inspect_clips(clips: Sequence[Clip]) -> dict[str, Any]:
    """How much motion there is, frames by label, share of frames in contact and foot slide, for each clip and all."""
    labels = np.concatenate([clip.labels for clip in clips]) if clips else np.empty(0, dtype=str)
    slides = [slide_of_clip(clip) for clip in clips]
    return {
        "clips": len(clips),
        "frames": len(labels),
        "seconds": sum(clip.seconds for clip in clips),
        "labels": _words(labels),
        "foot_slide_cm_s": sum(slides, Slide(0.0, 0.0)).cm_per_second,
        "each": [
            {
                "name": clip.name,
                "frames": clip.frame_count,
                "seconds": clip.seconds,
                "labels": _words(clip.labels),
                "contact_share": float(clip.contacts.mean()) if clip.contacts.size else None,
                "foot_slide_cm_s": slide.cm_per_second,
            }
            for clip, slide in zip(clips, slides, strict=True)
        ],
    }


def _counts(names: Sequence[str], index: NDArray) -> dict[str, int]:
    """How many entries each name has, and under "none" those with none or an empty name."""
    counts = {name or "none": int((index == number).sum()) for number, name in enumerate(names)}
    absent = int((index < 0).sum())
    return counts | ({"none": counts.get("none", 0) + absent} if absent else {})


def _words(labels: NDArray) -> dict[str, int]:
    words, counts = np.unique(labels, return_counts=True)
    return {str(word) or "none": int(count) for word, count in zip(words, counts, strict=True)}


def _table(table: PolicyTable) -> dict[str, Any]:
    task = table.task
    return {
        "behaviours": list(task.behaviours),
        "heading_bins": task.heading_bins,
        "states": int(table.values.size),
        "discount": task.discount,
        "heading_sigma_deg": float(np.degrees(task.heading_sigma)),
        "smoothness_sigma": task.smoothness_sigma,
        "transition_price": task.transition_price,
        "speeds_m_s": {name: list(levels) for name, levels in task.speeds.items()},
        "speed_sigma": task.speed_sigma,
        "speed_weight": task.speed_weight,
        "sweeps": table.sweeps,
        "residual": table.residual,
        "converged": table.converged,
        "greatest_value": float(table.values.max()),
    }


def _shadowing(table: ShadowingTable) -> dict[str, Any]:
    task = table.task
    return {
        "states": int(table.values.size),
        "distance_m": task.distance,
        "distance_scale_m": task.distance_scale,
        "facing_scale_deg": float(np.degrees(task.facing_scale)),
        "discount": task.discount,
        "farthest_m": task.farthest,
        "distance_bins": task.distance_bins,
        "bearing_bins": task.bearing_bins,
        "sweeps": table.sweeps,
        "residual": table.residual,
        "converged": table.converged,
    }
