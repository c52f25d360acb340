"""The recipe of the state-annotated motion graph: the standard one as a state machine allows, cut into segments."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.annotation import Annotation, NextHops
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.state_machine import NO_STATE, StateMachine
from footwork.motion.task import SteeringTask
from footwork.training.connectivity import least_threshold, restricted
from footwork.training.graph_options import GraphOptions
from footwork.training.memory import available_bytes
from footwork.training.next_hops import next_hops
from footwork.training.recipe import Built
from footwork.training.stages import Stages
from footwork.training.standard_graph import edges_of
from footwork.training.standard_recipe import WholeGraph, rounded_up, transitions_found, whole_graph
from footwork.training.state_parts import Links, lasting_parts, missing_states, permitted
from footwork.training.state_report import state_report
from footwork.training.stretches import stretches

_BYTES_PER_WAY = 32  # in the search and in the tables
_TRIED = 400  # thresholds, from the one asked for to that of all minima


def build_annotated(
    clips: Sequence[Clip], options: GraphOptions, task: SteeringTask, stages: Stages, machine: StateMachine
) -> Built:
    """The state-annotated motion graph, in the stages of ``standard_recipe.whole_graph``, "states" and "ways".

    Its behaviours are the states, wind-ups and recoveries those of what they belong to.

    Measured are ``outside`` (frames whose label shows no state, by label), ``forbidden_edges`` (that the machine takes
    out), ``steps`` (nodes that each step leaves, by state), ``as_published`` (those left where no wind-up or recovery
    is handed over), ``wind_ups_and_recoveries`` (how many are) and what ``state_report`` tells.

    Raises:
        InputError: for a state that no frame shows, a label that none has, more frames than memory has room for, or a
            state of which nothing is left.
    """
    machine.require_shown(str(label) for clip in clips for label in np.unique(clip.labels))
    whole = whole_graph(clips, options, task, stages, machine)
    with stages("states"):
        state = whole.graph.behaviour
        links = Links(whole.graph.source, whole.graph.target, whole.graph.natural)
        parts = lasting_parts(machine, state, links)
        if lost := missing_states(machine, parts.state):
            raise _lost(machine, lost[0], options.number, whole, state)
        nodes = np.flatnonzero(parts.state != NO_STATE)
        graph = replace(restricted(whole.graph, nodes, parts.links), behaviour=parts.state[nodes])
    with stages("ways"):
        annotation = annotated(graph, machine, parts.state[nodes])
    measured = {
        "outside": _outside(clips, machine),
        "forbidden_edges": int((~permitted(machine, state, links)).sum()),
        "steps": [{"step": name} | _counts(machine, left) for name, left in parts.steps],
        "as_published": _counts(machine, lasting_parts(machine, state, links, hand_over=False).state),
        "wind_ups_and_recoveries": int((parts.state != state)[nodes].sum()),
        **state_report(annotation),
    }
    return Built(graph, len(state), len(state), whole.graph.edge_count, measured, annotation)


def task_of_states(task: SteeringTask, machine: StateMachine) -> SteeringTask:
    """The same task with states to ask for; those with a heading may be turned like walking where it does not say."""
    share = {name: task.warp_share.get(name, 1.0) for name in machine.headed}
    share |= {name: task.warp_share.get(name, 0.0) for name in machine.names if name not in machine.headed}
    asked = {"behaviours": machine.names, "facing": machine.headed, "one_shot": machine.one_shot}
    return replace(task, warp_share=share, **asked)


def annotated(graph: MotionGraph, machine: StateMachine, state: NDArray) -> Annotation:
    """The segments of a graph that a machine allows, and the ways between those that are to be reached at once.

    Args:
        graph: the graph.
        machine: the states.
        state: the number of each node's state.  # (N,)

    Raises:
        InputError: for more ways than memory has room for.
    """
    first = stretches(graph, state)
    of_segment = state[first[:-1]]

    def between(pair: tuple[int, int]) -> NextHops:
        rows, goals = np.flatnonzero(np.isin(of_segment, pair)), np.flatnonzero(of_segment == pair[1])
        _check_room(machine, pair, len(rows), len(goals))
        return next_hops(graph, first, rows, goals)

    return Annotation(machine, first, of_segment, tuple(map(between, machine.at_once)))


def _check_room(machine: StateMachine, pair: tuple[int, int], rows: int, goals: int) -> None:
    """Raise InputError where the ways between two states would not fit into memory."""
    room = available_bytes() // _BYTES_PER_WAY
    if rows * goals > room:
        there = machine.names[pair[1]]
        problem = f"{rows} x {goals} ways to {there!r} at once, expected {room} at most in the memory left"
        raise InputError(
            f"{problem}: take {there!r} out of its 'at_once', or lower the threshold", machine.place(pair[0])
        )


def _outside(clips: Sequence[Clip], machine: StateMachine) -> dict[str, int]:
    """Frames whose label no state shows, by label."""
    frames = Counter(str(label) for clip in clips for label in clip.labels)
    shown = {label for state in machine.states for label in state.labels}
    return {label or "none": count for label, count in sorted(frames.items()) if label not in shown}


def _counts(machine: StateMachine, state: NDArray) -> dict[str, int]:
    """Nodes by state."""
    counts = np.bincount(state[state != NO_STATE], minlength=len(machine.states)).tolist()
    return {"nodes": sum(counts), **dict(zip(machine.names, counts, strict=True))}


def _lost(machine: StateMachine, number: int, threshold: float, whole: WholeGraph, state: NDArray) -> InputError:
    """Why nothing of a state is left at this threshold, and which threshold would keep some of every state."""
    found = transitions_found(whole.minima)
    problem = f"no way leads into it, out again and so on without end at threshold {threshold:g} ({found})"
    ends, possible = whole.ends, whole.possible

    def holds(tried: float) -> bool:
        edges = edges_of(ends, possible.under(tried))
        links = Links(edges.source, edges.target, edges.source == edges.similar)
        return not missing_states(machine, lasting_parts(machine, state, links).state)

    dearest = max(2.0 * float(possible.cost.max(initial=0.0)), threshold)
    tried = sorted({rounded_up(value) for value in np.geomspace(threshold, dearest, _TRIED).tolist()})
    needed = least_threshold(np.array(tried), holds)
    mend = "nor at any other: it needs frames that are like those of the states before and after it"
    if needed is not None:
        mend = f"a threshold of {needed:g} would keep every state"
    return InputError(f"{problem}; {mend}", machine.place(number))
