"""The score: how well, how soon and how smoothly a character follows recorded players.

Every figure is defined in ``measures`` (Control, Transition, Total, heading error, settle time, latency, jumps),
``charges`` (what a tick costs), ``shown`` (foot slide, skating, jumps of velocity) and ``pace`` (time); figures of
several traces are over all their ticks and changes, so long traces weigh more.
"""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from footwork.controllers.bundle_controller import bundle_controller
from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.motion.graph import ARRAYS
from footwork.motion.task import BEHAVIOURS
from footwork.motion.trace import Trace
from footwork.study import measures
from footwork.study.contender import Contender, Foreseeing
from footwork.study.intervals import intervals
from footwork.study.pace import pace, times_of
from footwork.study.replay import Replay, Stage, replay
from footwork.study.showing import Showing
from footwork.study.shown import shown_report, source_report

_MEGABYTE = 1e6
_COMPILING_TICKS = 3


def score(
    bundle: Bundle,
    traces: Sequence[Trace],
    contender: Contender | None = None,
    *,
    instead: Mapping[str, Contender] = MappingProxyType({}),
    showing: Showing | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> dict[str, Any]:
    """Replay traces through a character, one at a time, and report (JSON-able; None where there is nothing).

    ``control, transition, transition_jumps, total, total_by_tick, switch_share, turn_share, heading_error_deg`` as
    ``measures.quality``; ``settle_s, settled_share`` as ``measures.settling``; ``behaviour_latency_s,
    answered_share`` as ``measures.latencies``; ``jumps_asked, jumps_answered`` as ``measures.jumps``;
    ``missing_behaviours`` are those that a trace asks for and no frame shows, whose ticks score 0;
    ``foot_slide_cm_s, skating_ratio, velocity_jump_m_s`` of the poses shown at the ticks and
    ``source_foot_slide_cm_s, source_skating_ratio`` of the capture in the graph; ``decision_us, tick_us`` for one
    character alone and in ``batch`` for many at once (None for what must know the trace); ``table_mb`` is what the
    controller looks things up in and ``clip_mb`` the graph; ``intervals`` over traces; ``traces`` has the same of
    each trace with its ``file``.

    Args:
        bundle: whose character is scored, where no contender is given; transitions count by the uniform metric,
            whichever metric built the graph.
        traces: the recorded players.
        contender: what chooses moves, on a graph of its own; the bundle's "steering" table by default.
        instead: what replays a trace in place of the contender, on the same graph, by the trace's digest: such as a
            policy that has not seen it. Size and time in a batch are the contender's.
        showing: what is done to poses (it changes what is shown, so foot slide, skating and time only).
        progress: told the share that is done.

    Raises:
        InputError: for no traces, one that asks for nothing that the character can do, or a bundle without a steering
            table where no contender is given.
    """
    if not traces:
        raise InputError("no traces, expected at least one", "traces")
    contender = contender or bundle_controller(bundle)
    stage = Stage(contender.graph, showing, sigma=_sigma(bundle))
    replays = replays_of(traces, contender, stage, progress, instead)
    shared = {
        **source_report(contender.graph),
        "batch": None if isinstance(contender, Foreseeing) else pace(traces, contender, stage.showing),
        "table_mb": _table_megabytes(contender),
        "clip_mb": sum(getattr(contender.graph, name).nbytes for name in ARRAYS) / _MEGABYTE,
    }
    followed, slides = [one.followed for one in replays], [one.shown.slide for one in replays]
    single = [{"file": one.name} | report_of([one], contender) for one in replays]
    return report_of(replays, contender) | shared | {"intervals": intervals(followed, slides), "traces": single}


def replays_of(
    traces: Sequence[Trace],
    contender: Contender,
    stage: Stage,
    progress: Callable[[str, float], None] | None = None,
    instead: Mapping[str, Contender] = MappingProxyType({}),
) -> list[Replay]:
    """All traces replayed, every kernel compiled before the first."""
    replay(traces[0], contender, stage, most_ticks=_COMPILING_TICKS)
    replays = []
    for done, trace in enumerate(traces):
        if progress:
            progress("replaying traces", done / len(traces))
        replays.append(replay(trace, instead.get(trace.digest, contender), stage))
    return replays


def report_of(replays: Sequence[Replay], contender: Contender) -> dict[str, Any]:
    """The figures of some replays together, as ``score`` names them."""
    parts = [one.followed for one in replays]
    settling = measures.joined([measures.settling(part) for part in parts])
    latencies = measures.joined([measures.latencies(part) for part in parts])
    jumps = [measures.jumps(part) for part in parts]
    asked = {BEHAVIOURS[index] for part in parts for index in np.unique(part.behaviour)}
    return measures.quality(measures.joined(parts)) | {
        "settle_s": settling.summary(),
        "settled_share": settling.share,
        "behaviour_latency_s": latencies.summary(),
        "answered_share": latencies.share,
        **{name: sum(jump[name] for jump in jumps) for name in ("jumps_asked", "jumps_answered")},
        "missing_behaviours": sorted(asked - set(contender.present)),
        **shown_report([one.shown for one in replays]),
        "decision_us": times_of(np.concatenate([one.decision_us for one in replays])),
        "tick_us": times_of(np.concatenate([one.tick_us for one in replays])),
        "ticks": sum(len(one.tick_us) for one in replays),
    }


def _sigma(bundle: Bundle) -> float:
    """What the graph's smoothness was made with: its policy's sigma, the usual one where it has no policy."""
    table = bundle.tables.get("steering")
    return table.task.smoothness_sigma if table else measures.TASK.smoothness_sigma


def _table_megabytes(contender: Contender) -> float | None:
    """What it looks things up in beside the graph, None where it does not say."""
    bytes_there = getattr(contender, "table_bytes", None)
    return None if bytes_there is None else bytes_there / _MEGABYTE
