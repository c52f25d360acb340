"""From clips to a bundle: the motion graph, and the steering policy over it."""

from collections.abc import Mapping, Sequence
from importlib.metadata import version
from typing import Any, Protocol

import msgspec

from footwork.errors import InputError
from footwork.motion.bundle import Bundle, sealed
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.mirror import mirrored
from footwork.motion.shadowing_table import ShadowingTable
from footwork.motion.shadowing_task import ShadowingTask
from footwork.motion.state_machine import NO_STATE, StateMachine
from footwork.motion.table import PolicyTable
from footwork.motion.task import SteeringTask
from footwork.motion.trace import Trace
from footwork.motion.window import LENGTH
from footwork.training.annotated_recipe import build_annotated, task_of_states
from footwork.training.graph_options import GraphOptions, require_machine
from footwork.training.memory import peak_rss_mb
from footwork.training.player_model import learned
from footwork.training.recipe import Built
from footwork.training.shadowing import solve_shadowing
from footwork.training.speed_levels import with_speed_levels
from footwork.training.stages import Progress, Stages
from footwork.training.standard_recipe import build_standard
from footwork.training.strike_table import StrikeRow, strikes_of
from footwork.training.threshold_choice import chosen
from footwork.training.value_iteration import solve
from footwork.training.well_connected_recipe import build_well_connected

_AS_USUAL = GraphOptions()


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
    options: GraphOptions = _AS_USUAL,
    *,
    task: SteeringTask | None = None,
    machine: StateMachine | None = None,
    speed_levels: int = 0,
    players: Sequence[Trace] = (),
    strikes: Sequence[StrikeRow] = (),
    progress: Progress | None = None,
) -> tuple[Bundle, dict[str, Any]]:
    """A bundle of a motion graph and its steering policy, and a report of how it went.

    The report is JSON-able: frames (captured), mirrored_frames (where there are any), nodes, edges (of the whole
    graph), scc_nodes, scc_fraction (of the captured and mirrored frames), what the graph's kind adds, threshold, knee
    (where it was to be found), seconds (read, which is 0 for the clips came from the caller, each stage and the total),
    peak_rss_mb, policy (states, sweeps, residual, converged; None where no frame shows any
    behaviour, for there is nothing to steer by then), shadowing (the same of the table for a state that is shadowing,
    and its bytes; only where there is one), missing_behaviours (those that no frame of the graph
    shows, so that commands for them go unanswered) and digest.

    Args:
        motions: the clips and where they came from.
        options: the kind of graph and how it is built.
        task: what may be asked for; the default steering task where not given. Of an annotated graph it is the states.
        machine: the states of an annotated graph; for that kind alone.
        speed_levels: for how many speeds of each headed behaviour whose speeds the task does not give.
        players: recordings that the policy learns from how commands change; without any it takes them never to.
        strikes: where attacks reach their target, in place of what is detected in the clips that they name.
        progress: told the stage and the share of it that is done.

    Raises:
        InputError: for no clips, a clip shorter than the metric's window or of another body or frame rate, more frames
            than memory has room for, a graph that cannot be walked without end, a machine that is missing, not needed
            or does not fit the labels, or a policy that does not converge.
    """
    task = task or SteeringTask()
    stages = Stages(progress)
    require_machine(options, machine is not None)
    _check(motions.clips)
    task = task if machine is None else task_of_states(task, machine)
    options, choice = chosen(motions.clips, options, stages)
    clips = [*motions.clips, *map(mirrored, motions.clips)] if options.mirror else motions.clips
    built = _built(clips, options, task, stages, machine)
    task = with_speed_levels(task, built.graph, speed_levels)
    tables: dict[str, PolicyTable] = {}
    if _shown_behaviours(built.graph):
        with stages("policy") as tell:
            player = learned(players, task, _shown_behaviours(built.graph)) if players else None
            tables["steering"] = solve(built.graph, task, player=player, progress=tell).require_converged().compact
    shadowing = _shadowing(built, stages)
    extra = _mirrored_frames(motions, options)
    provenance = _provenance(motions, options, task, built, extra) | choice
    contacts = strikes_of(built.graph, built.annotation, strikes)
    whole = Bundle(
        built.graph,
        tables,
        provenance,
        tuple(motions.attribution),
        annotation=built.annotation,
        strikes=contacts,
        shadowing=shadowing,
    )
    bundle = sealed(whole)
    report = {
        "frames": sum(clip.frame_count for clip in motions.clips),
        **extra,
        "nodes": built.nodes,
        "edges": built.edges,
        "scc_nodes": built.graph.node_count,
        "scc_fraction": built.connected_frames / built.frames,
        **built.measured,
        **({} if contacts is None else {"strikes": contacts.rows(built.graph)}),
        "threshold": options.threshold,
        **choice,
        "seconds": {"read": 0.0} | stages.seconds | {"total": sum(stages.seconds.values())},
        "peak_rss_mb": peak_rss_mb(),
        "policy": _solved(tables["steering"]) if tables else None,
        **({} if shadowing is None else {"shadowing": _solved(shadowing) | {"bytes": shadowing.nbytes}}),
        "missing_behaviours": [name for name in task.behaviours if name not in _shown_behaviours(built.graph)],
        "digest": bundle.digest,
    }
    return bundle, report


def _built(
    clips: Sequence[Clip], options: GraphOptions, task: SteeringTask, stages: Stages, machine: StateMachine | None
) -> Built:
    """The graph by the recipe of its kind."""
    if machine is not None:
        return build_annotated(clips, options, task, stages, machine)
    build = build_standard if options.graph == "standard" else build_well_connected
    return build(clips, options, task, stages)


def _shadowing(built: Built, stages: Stages) -> ShadowingTable | None:
    """The table for the state that is shadowing, where there is one."""
    notes = built.annotation
    if notes is None or notes.machine.shadowing == NO_STATE:
        return None
    with stages("shadowing") as tell:
        task = ShadowingTask()
        return solve_shadowing(built.graph, notes, notes.machine.shadowing, task, progress=tell).require_converged()


def _check(clips: Sequence[Clip]) -> None:
    for clip in clips:
        if clip.frame_count < LENGTH:
            problem = f"{clip.frame_count} frames at 30 Hz, expected at least the {LENGTH} of the metric's window"
            raise InputError(problem, clip.name)


def _solved(table: PolicyTable | ShadowingTable) -> dict[str, Any]:
    return {
        "states": table.values.size,
        "sweeps": table.sweeps,
        "residual": table.residual,
        "converged": table.converged,
    }


def _shown_behaviours(graph: MotionGraph) -> list[str]:
    shown = set(graph.behaviour.tolist())
    return [name for index, name in enumerate(graph.behaviours) if index in shown]


def _mirrored_frames(motions: Motions, options: GraphOptions) -> dict[str, int]:
    """How many of the graph's frames are mirrored ones, where it has any."""
    return {"mirrored_frames": sum(clip.frame_count for clip in motions.clips)} if options.mirror else {}


def _provenance(
    motions: Motions, options: GraphOptions, task: SteeringTask, built: Built, extra: Mapping[str, int]
) -> dict[str, Any]:
    """What the bundle was made of and how; nothing in it changes from one run to the next.

    Its counts are of all frames that the graph was made of, those that ``extra`` tells are mirrored among them.
    """
    return {
        "files": list(motions.files),
        "options": options.record() | {"task": msgspec.to_builtins(task)},
        "versions": {"footwork": version("footwork")},
        "counts": {
            "frames": built.frames,
            **extra,
            "nodes": built.nodes,
            "edges": built.edges,
            "scc_nodes": built.graph.node_count,
            "scc_edges": built.graph.edge_count,
            "scc_frames": built.connected_frames,
        },
    }
