"""Measures of the poses that are shown: foot slide, skating, and how hard velocities jump at switches.

Convention: a shown foot stands where the frame shown says so and its ball is no higher above where balls stand than one
that stands may be (conventions.md 3): a foot in the air does not slide. The capture is measured alike.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.contacts import GROUND_PERCENTILE, OFF_HEIGHT
from footwork.motion.graph import MotionGraph
from footwork.motion.kinematics import clip_places, forward
from footwork.motion.tick import TICK_RATE
from footwork.study.foot_slide import Slide, slide_of_capture, slide_of_frames, soles
from footwork.study.graph_clips import clip_of_graph, clips_of_graph
from footwork.study.skating import skating_steps


@dataclass(frozen=True, eq=False)
class Shown:
    """What came of one run of poses.

    Args:
        slide: of the feet while they stand.
        skating: whether each foot skates at each step (``skating.skating_steps``).  # (F - 1, feet)
        switches: by how much the velocity of each joint changes at the frames before and after a switch, m/s.
        elsewhere: the same at all other frames.
    """

    slide: Slide
    skating: NDArray[np.bool_]
    switches: NDArray[np.float64]
    elsewhere: NDArray[np.float64]


def shown(
    graph: MotionGraph, nodes: NDArray, switched: NDArray, root: NDArray, rotations: NDArray, ground: float
) -> Shown:
    """Measure the poses of a run.

    Args:
        graph: what was moved on.
        nodes: the node shown at each tick.  # (K,)
        switched: whether the tick left the order of the capture.  # (K,)
        root: of the poses shown.  # (K, 3)
        rotations: of the poses shown.  # (K, J, 4)
        ground: ``ground_of``.
    """
    places = forward(graph.skeleton, root, rotations)[0]
    balls = places[:, graph.skeleton.feet[:, 1]]
    standing = graph.contacts[nodes] & (balls[..., 1] <= ground + OFF_HEIGHT)
    # The frame that a switch leads to and the one before it: its jump is in the velocity between them.
    hard = switched[1:-1] | switched[2:]
    changes = np.linalg.norm(np.diff(places, n=2, axis=0), axis=-1) * TICK_RATE
    return Shown(
        slide=slide_of_frames(soles(graph.skeleton, places), standing, TICK_RATE),
        skating=skating_steps(balls, ground),
        switches=changes[hard].ravel(),
        elsewhere=changes[~hard].ravel(),
    )


def ground_of(graph: MotionGraph) -> float:
    """Height of a ball that stands: a low percentile over the captured frames, metres."""
    balls = graph.joint_places[graph.original][:, graph.skeleton.feet[:, 1], 1]
    return float(np.percentile(balls, GROUND_PERCENTILE))


def shown_report(parts: Sequence[Shown]) -> dict[str, Any]:
    """Figures of several runs together (JSON-able).

    ``foot_slide_cm_s`` in cm a second of contact, ``skating_ratio`` the share of steps at which a foot skates, and the
    95th percentile of the joints' changes of velocity, at switches and elsewhere.
    """
    slide = sum((part.slide for part in parts), Slide(0.0, 0.0))
    skating = np.concatenate([part.skating.ravel() for part in parts])
    return {
        "foot_slide_cm_s": slide.cm_per_second,
        "skating_ratio": float(skating.mean()) if skating.size else None,
        "velocity_jump_m_s": {
            "at_switches_p95": _p95([part.switches for part in parts]),
            "elsewhere_p95": _p95([part.elsewhere for part in parts]),
        },
    }


def source_report(graph: MotionGraph) -> dict[str, Any]:
    """What the captured frames themselves slide and skate, the floor of both figures."""
    ground, feet = ground_of(graph), graph.skeleton.feet[:, 1]
    skating = [skating_steps(clip_places(clip)[0][:, feet], ground).ravel() for clip in clips_of_graph(graph)]
    steps = np.concatenate(skating) if skating else np.zeros(0)
    return {
        "source_foot_slide_cm_s": slide_of_capture(graph, highest=ground + OFF_HEIGHT).cm_per_second,
        "source_skating_ratio": float(steps.mean()) if steps.size else None,
    }


def source_skating(graph: MotionGraph, nodes: NDArray) -> float | None:
    """Of the captured frames among some nodes, the share at whose steps a foot skates in the clips themselves.

    It is what a skating ratio comes to by the choice of frames alone: footwork skates less than kicks do.

    Args:
        graph: of the nodes.
        nodes: which, each as often as it counts.  # (K,)
    """
    ground, feet = ground_of(graph), graph.skeleton.feet[:, 1]
    skates = np.full((graph.node_count, feet.size), np.nan)  # a clip's first frame has no step
    for number in np.unique(graph.clip[graph.original]):
        there = np.flatnonzero((graph.clip == number) & graph.original)
        there = there[np.argsort(graph.frame[there], kind="stable")]
        skates[there[1:]] = skating_steps(clip_places(clip_of_graph(graph, int(number)))[0][:, feet], ground)
    counted = skates[nodes]
    counted = counted[~np.isnan(counted)]
    return float(counted.mean()) if counted.size else None


def _p95(parts: Sequence[NDArray]) -> float | None:
    values = np.concatenate(parts)
    return float(np.percentile(values, 95)) if values.size else None
