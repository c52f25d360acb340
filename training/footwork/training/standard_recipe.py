"""The recipe of the standard motion graph: all pairs of frames, local minima, the strongly connected part."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.metric import PointCloudMetric
from footwork.motion.metrics import metric_of
from footwork.motion.state_machine import StateMachine
from footwork.motion.task import SteeringTask
from footwork.training.bridges import bridged
from footwork.training.connectivity import connecting_threshold, largest_component, restricted
from footwork.training.graph_options import GraphOptions
from footwork.training.memory import available_bytes
from footwork.training.nodes import nodes_in_states, nodes_of
from footwork.training.recipe import Built
from footwork.training.stages import Stages
from footwork.training.standard_graph import standard_graph
from footwork.training.transitions import Minima, local_minima

# a float64 cost for each pair of frames, and as much again for the rest of the build and the machine
_BYTES_PER_PAIR = 16


@dataclass(frozen=True, eq=False)
class WholeGraph:
    """A standard graph over all frames, and what it was made of.

    Args:
        graph: the graph.
        lengths: frames of each clip.
        costs: s of every pair of frames.  # (N, N)
        minima: the pairs where transitions are.
    """

    graph: MotionGraph
    lengths: Sequence[int]
    costs: NDArray[np.float64]
    minima: Minima

    @property
    def ends(self) -> NDArray[np.intp]:
        """For each frame the last frame of its clip.  # (N,)"""
        return np.repeat(np.cumsum(self.lengths) - 1, self.lengths)

    @property
    def possible(self) -> Minima:
        """All minima, whatever they cost."""
        return local_minima(self.costs, self.lengths)


def build_standard(clips: Sequence[Clip], options: GraphOptions, task: SteeringTask, stages: Stages) -> Built:
    """The standard motion graph, in the stages of ``whole_graph`` and "graph".

    Raises:
        InputError: for more frames than memory has room for, or where nothing can be walked without end.
    """
    whole = whole_graph(clips, options, task, stages)
    with stages("graph"):
        part = largest_component(whole.graph.node_count, whole.graph.source, whole.graph.target)
        if not part.size:
            raise _unconnected(options.number, whole)
        graph = restricted(whole.graph, part)
    return Built(graph, whole.graph.node_count, whole.graph.node_count, whole.graph.edge_count)


def whole_graph(
    clips: Sequence[Clip],
    options: GraphOptions,
    task: SteeringTask,
    stages: Stages,
    machine: StateMachine | None = None,
) -> WholeGraph:
    """All frames and the transitions between them, in the stages "metric", "graph" and, where asked for, "bridges".

    Behaviours are the states of ``machine`` where there is one.

    Raises:
        InputError: for more frames than memory has room for.
    """
    _check_room(sum(clip.frame_count for clip in clips))
    with stages("metric"):
        metric = metric_of(options.metric, clips)
        costs = metric.all_pairs()
    with stages("graph"):
        nodes = nodes_of(clips, task.behaviours) if machine is None else nodes_in_states(clips, machine)
        minima = local_minima(costs, nodes.lengths, options.number)
        uniform = None if options.metric == "uniform" else PointCloudMetric.of_clips(clips)
        whole = standard_graph(nodes, metric, minima, task.smoothness_sigma, uniform)
    if options.bridges:
        with stages("bridges") as tell:
            whole = bridged(whole, options.bridges, task.smoothness_sigma, tell)
    return WholeGraph(whole, nodes.lengths, costs, minima)


def _check_room(frames: int) -> None:
    """Raise InputError where the costs of all pairs of frames would not fit into memory."""
    room = math.isqrt(available_bytes() // _BYTES_PER_PAIR)
    if frames > room:
        raise InputError(f"{frames} frames at 30 Hz, expected {room} at most in the memory left: use fewer", "motions")


def _unconnected(threshold: float, whole: WholeGraph) -> InputError:
    """Why nothing can be walked without end at this threshold, and which threshold would do."""
    found = transitions_found(whole.minima)
    problem = f"{found} at threshold {threshold:g}, so nothing can be walked without end"
    possible = whole.possible
    for share, words in ((0.5, "would connect half of the frames"), (1e-9, "would connect some frames")):
        needed = connecting_threshold(whole.ends, possible, share)
        if needed is not None:
            return InputError(f"{problem}; a threshold of {rounded_up(needed):g} {words}", "threshold")
    return InputError(f"{problem}, nor at any other threshold: the clips need more frames that are alike", "threshold")


def transitions_found(minima: Minima) -> str:
    """How many there are, in words."""
    return f"{len(minima.i)} transitions" if len(minima.i) else "no transitions"


def rounded_up(value: float) -> float:
    """To three digits, never less than it was."""
    unit = 10.0 ** (math.floor(math.log10(max(value, 1e-12))) - 2)
    return math.ceil(value / unit) * unit
