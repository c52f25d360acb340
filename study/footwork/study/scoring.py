"""The score: how well, how soon and how smoothly a character follows recorded players.

Every figure is defined in ``measures`` (Control, Transition, Total, heading error, settle time, latency, jumps) and
``foot_slide``; figures of several traces are over all their ticks and changes, so long traces weigh more.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from footwork.controllers.controller import Controller
from footwork.controllers.steering import SteeringController
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.task import BEHAVIOURS
from footwork.motion.trace import Trace
from footwork.study import measures
from footwork.study.foot_slide import Slide, slide_of_capture
from footwork.study.replay import Replay, replay


def score(
    bundle: Bundle,
    traces: Sequence[Trace],
    controller: Controller | None = None,
    *,
    inertialise: bool = True,
    progress: Callable[[str, float], None] | None = None,
) -> dict[str, Any]:
    """Replay traces through a bundle's character, one at a time, and report (JSON-able; None where there is nothing).

    ``control, transition, transition_jumps, total, total_by_tick, heading_error_deg`` as ``measures.quality``;
    ``settle_s, settled_share`` as ``measures.settling``; ``behaviour_latency_s, answered_share`` as
    ``measures.latencies``; ``jumps_asked, jumps_answered`` as ``measures.jumps``; ``missing_behaviours`` are those
    that a trace asks for and no frame shows, whose ticks score 0; ``foot_slide_cm_s`` is of the poses shown at the
    ticks and ``source_foot_slide_cm_s`` of the capture in the graph; ``tick_us`` is decision, step and show of one
    character; ``total_interval`` as ``measures.bootstrap_total``; ``traces`` has the same of each trace with its
    ``file``.

    Args:
        bundle: what is scored; transitions count by the uniform metric, whichever metric built the graph.
        traces: the recorded players.
        controller: what chooses edges; the bundle's "steering" table by default.
        inertialise: whether transitions are smoothed (it changes the shown poses, so foot slide and time only).
        progress: told the share that is done.

    Raises:
        InputError: for no traces, a bundle without a steering table or a graph without a frame of any behaviour.
    """
    if not traces:
        raise InputError("no traces, expected at least one", "traces")
    graph = bundle.graph
    controller = controller or SteeringController(graph, bundle.table("steering"))
    replay(graph, traces[0], controller, inertialise=inertialise, most_ticks=3)  # compiles every kernel
    source = slide_of_capture(graph)
    sigma = bundle.table("steering").task.smoothness_sigma
    replays = []
    for done, trace in enumerate(traces):
        if progress:
            progress("replaying traces", done / len(traces))
        replays.append(replay(graph, trace, controller, inertialise=inertialise, sigma=sigma))
    report = _report(replays, controller.present, source)
    interval = measures.bootstrap_total([one.followed for one in replays])
    single = [{"file": one.name} | _report([one], controller.present, source) for one in replays]
    return report | {"total_interval": interval, "traces": single}


def _report(replays: Sequence[Replay], present: tuple[str, ...], source: Slide) -> dict[str, Any]:
    parts = [one.followed for one in replays]
    settling = measures.joined([measures.settling(part) for part in parts])
    latencies = measures.joined([measures.latencies(part) for part in parts])
    jumps = [measures.jumps(part) for part in parts]
    slide = sum((one.slide for one in replays), Slide(0.0, 0.0))
    asked = {BEHAVIOURS[index] for part in parts for index in np.unique(part.behaviour)}
    return measures.quality(measures.joined(parts)) | {
        "settle_s": settling.summary(),
        "settled_share": settling.share,
        "behaviour_latency_s": latencies.summary(),
        "answered_share": latencies.share,
        **{name: sum(jump[name] for jump in jumps) for name in ("jumps_asked", "jumps_answered")},
        "missing_behaviours": sorted(asked - set(present)),
        "foot_slide_cm_s": slide.cm_per_second,
        "source_foot_slide_cm_s": source.cm_per_second,
        "tick_us": _times(np.concatenate([one.tick_us for one in replays])),
        "ticks": sum(len(one.tick_us) for one in replays),
    }


def _times(microseconds: np.ndarray) -> dict[str, float]:
    p50, p99 = np.percentile(microseconds, [50, 99])
    return {"mean": float(microseconds.mean()), "p50": float(p50), "p99": float(p99)}
