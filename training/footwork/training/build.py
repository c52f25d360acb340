"""From clips to a bundle: metric, transitions, standard graph, its connected part, and the steering policy over it."""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import version
from typing import Any, Protocol

import msgspec

from footwork.errors import InputError
from footwork.motion.bundle import Bundle, sealed
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import SteeringTask
from footwork.motion.window import LENGTH
from footwork.training.connectivity import connecting_threshold, largest_component, restricted
from footwork.training.memory import machine_bytes, peak_rss_mb
from footwork.training.nodes import nodes_of
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import Minima, local_minima
from footwork.training.value_iteration import solve

Progress = Callable[[str, float], None]
# a float64 cost for each pair of frames, and as much again for the rest of the build and the machine
_BYTES_PER_PAIR = 16


class Motions(Protocol):
    """What a bundle is built from: a ``training.dataset.Dataset``, or anything with the same three fields."""

    @property
    def clips(self) -> Sequence[Clip]:
        """Clips of the common body at 30 Hz, labelled, with contacts."""
        ...

    @property
    def files(self) -> Sequence[Mapping[str, Any]]:
        """JSON-able: the files the clips came from, with their digests."""
        ...

    @property
    def attribution(self) -> Sequence[str]:
        """What the licences ask to have shown, a line each."""
        ...


def build_bundle(
    motions: Motions,
    *,
    threshold: float,
    task: SteeringTask | None = None,
    progress: Progress | None = None,
) -> tuple[Bundle, dict[str, Any]]:
    """A bundle of the standard motion graph and its steering policy, and a report of how it went.

    The report is JSON-able: frames, nodes, edges (of the whole graph), scc_nodes, scc_fraction (of the frames),
    threshold, seconds (metric, graph, policy and their total; read is 0, for the clips came from the caller),
    peak_rss_mb, policy (states, sweeps, residual, converged), missing_behaviours (those that no frame of the graph
    shows, so that commands for them go unanswered) and digest.

    Args:
        motions: the clips and where they came from.
        threshold: transitions must cost less than this s (conventions.md 2).
        task: what may be asked for; the default steering task where not given.
        progress: told the stage ("metric", "graph", "policy") and the share of it that is done.

    Raises:
        InputError: for a threshold that is not a positive number, no clips, a clip shorter than the metric's window
            or of another body or frame rate, more frames than memory has room for, a graph that cannot be walked
            without end at this threshold, or a policy that does not converge.
    """
    task = task or SteeringTask()
    tell = progress or (lambda stage, share: None)
    _check(motions.clips, threshold)
    seconds = {"read": 0.0, "metric": 0.0, "graph": 0.0, "policy": 0.0}
    with _stage("metric", seconds, tell):
        metric = PointCloudMetric.of_clips(motions.clips)
        costs = metric.all_pairs()
    with _stage("graph", seconds, tell):
        nodes = nodes_of(motions.clips, task.behaviours)
        minima = local_minima(costs, nodes.lengths, threshold)
        whole = standard_graph(nodes, metric, minima, task.smoothness_sigma)
        part = largest_component(whole.node_count, whole.source, whole.target)
        if not part.size:
            raise _unconnected(threshold, minima, local_minima(costs, nodes.lengths), nodes.ends)
        graph = restricted(whole, part)
    with _stage("policy", seconds, tell):
        table = solve(graph, task, progress=lambda share: tell("policy", share)).require_converged()
    provenance = _provenance(motions, threshold, task, whole, graph)
    bundle = sealed(Bundle(graph, {"steering": table}, provenance, tuple(motions.attribution)))
    report = {
        "frames": whole.node_count,
        "nodes": whole.node_count,
        "edges": whole.edge_count,
        "scc_nodes": graph.node_count,
        "scc_fraction": graph.node_count / whole.node_count,
        "threshold": threshold,
        "seconds": seconds | {"total": sum(seconds.values())},
        "peak_rss_mb": peak_rss_mb(),
        "policy": {
            "states": table.values.size,
            "sweeps": table.sweeps,
            "residual": table.residual,
            "converged": table.converged,
        },
        "missing_behaviours": _missing_behaviours(graph),
        "digest": bundle.digest,
    }
    return bundle, report


def require_threshold(threshold: float, where: str = "threshold") -> None:
    """Raise InputError unless the threshold is a positive number."""
    if not (math.isfinite(threshold) and threshold > 0.0):
        raise InputError(f"{threshold} is no threshold, expected a positive number", where)


def _check(clips: Sequence[Clip], threshold: float) -> None:
    require_threshold(threshold)
    for clip in clips:
        if clip.frame_count < LENGTH:
            problem = f"{clip.frame_count} frames at 30 Hz, expected at least the {LENGTH} of the metric's window"
            raise InputError(problem, clip.name)
    _check_room(sum(clip.frame_count for clip in clips))


def _check_room(frames: int) -> None:
    """Raise InputError where the costs of all pairs of frames would not fit into memory."""
    room = math.isqrt(machine_bytes() // _BYTES_PER_PAIR)
    if frames > room:
        raise InputError(f"{frames} frames at 30 Hz, expected {room} at most on this machine: use fewer", "motions")


def _missing_behaviours(graph: MotionGraph) -> list[str]:
    shown = set(graph.behaviour.tolist())
    return [name for index, name in enumerate(graph.behaviours) if index not in shown]


@contextmanager
def _stage(name: str, seconds: dict[str, float], tell: Progress) -> Iterator[None]:
    """Tell the beginning and the end of a stage and note how long it took."""
    tell(name, 0.0)
    started = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - started
    tell(name, 1.0)


def _unconnected(threshold: float, minima: Minima, possible: Minima, ends: Any) -> InputError:
    """Why nothing can be walked without end at this threshold, and which threshold would do."""
    found = f"{len(minima.i)} transitions" if len(minima.i) else "no transitions"
    problem = f"{found} at threshold {threshold:g}, so nothing can be walked without end"
    for share, words in ((0.5, "would connect half of the frames"), (1e-9, "would connect some frames")):
        needed = connecting_threshold(ends, possible, share)
        if needed is not None:
            return InputError(f"{problem}; a threshold of {_rounded_up(needed):g} {words}", "threshold")
    return InputError(f"{problem}, nor at any other threshold: the clips need more frames that are alike", "threshold")


def _rounded_up(value: float) -> float:
    """To three digits, never less than it was."""
    unit = 10.0 ** (math.floor(math.log10(max(value, 1e-12))) - 2)
    return math.ceil(value / unit) * unit


def _provenance(
    motions: Motions, threshold: float, task: SteeringTask, whole: MotionGraph, graph: MotionGraph
) -> dict[str, Any]:
    """What the bundle was made of and how; nothing in it changes from one run to the next."""
    return {
        "files": list(motions.files),
        "options": {
            "graph": "standard",
            "metric": "uniform",
            "threshold": threshold,
            "task": msgspec.to_builtins(task),
        },
        "versions": {"footwork": version("footwork")},
        "counts": {
            "frames": whole.node_count,
            "nodes": whole.node_count,
            "edges": whole.edge_count,
            "scc_nodes": graph.node_count,
            "scc_edges": graph.edge_count,
        },
    }
