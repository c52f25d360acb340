"""Everything that the paper measures on a graph, once, so that a large graph need not be kept for later rows."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.study.behaviour_times import BehaviourTimes, behaviour_times
from footwork.study.closure import closure
from footwork.study.maneuverability import Maneuverability, maneuverability
from footwork.study.reproduction.flat_graph import FlatGraph
from footwork.study.transition_times import TransitionTimes, transition_times

EXACT_UP_TO = 100_000  # nodes: ways are sought from all frames of smaller graphs, from SOURCES frames of larger ones
SOURCES = 256
PIXELS = 340


@dataclass(frozen=True, eq=False)
class Survey:
    """What was measured on a graph and on its largest strongly connected part.

    Args:
        nodes: of the graph.
        edges: of the graph.
        share: of the captured frames that are in the largest part.
        reached: share of the ordered pairs of captured frames with a way from the first to the second.
        picture: the same share in each cell of a grid over (from, to).  # (P, P)
        times: of the ways between the captured frames of the largest part.
        maneuver: local maneuverability of the largest part, by label.
        from_frames: the same, but with each captured frame as a start of its own, which is alike for all graphs.
        behaviour: times between labels in the largest part.
        part_frames: captured frames in the largest part.
    """

    nodes: int
    edges: int
    share: float
    reached: float
    picture: NDArray[np.float64]
    times: TransitionTimes
    maneuver: Maneuverability
    from_frames: Maneuverability
    behaviour: BehaviourTimes
    part_frames: int


def survey(graph: FlatGraph) -> Survey:
    """Measure a graph.

    Raises:
        InputError: for a graph without a cycle, so with no part to measure.
    """
    part = graph.connected()
    reached = closure(graph.edge_start, graph.target, graph.frames)
    sources = None if part.node_count <= EXACT_UP_TO else SOURCES
    return Survey(
        nodes=graph.node_count,
        edges=graph.edge_count,
        share=part.captured_share,
        reached=float(reached.mean()),
        picture=_in_cells(reached, PIXELS),
        times=transition_times(part.edge_start, part.target, part.frames, sources=sources),
        maneuver=maneuverability(part.edge_start, part.target, part.kind, part.kinds),
        from_frames=maneuverability(part.edge_start, part.target, part.kind, part.kinds, frames=part.frames),
        behaviour=behaviour_times(part.edge_start, part.target, part.kind, part.kinds, part.frames),
        part_frames=len(part.frames),
    )


def _in_cells(reached: NDArray[np.bool_], pixels: int) -> NDArray[np.float64]:
    """Share of true entries in each cell of a grid of at most ``pixels`` cells a side.  # (F, F) -> (P, P)"""
    starts = np.unique(np.linspace(0, len(reached), min(pixels, len(reached)), endpoint=False).astype(int))
    counts = np.diff(np.append(starts, len(reached)))
    sums = np.add.reduceat(np.add.reduceat(reached, starts, axis=0, dtype=np.int64), starts, axis=1)
    return sums / np.outer(counts, counts)
