"""Clips back out of a motion graph: the frames of one source clip in the order they were captured."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.study.placing import placed_clip


def clip_of_graph(graph: MotionGraph, clip: int) -> Clip:
    """The captured frames of source clip ``clip`` as a clip of their own, placed by the natural edges between them.

    Where a frame is missing from the graph, the next one stands where the last one stood.

    Raises:
        InputError: for a clip of which the graph has no frame.
    """
    nodes = np.flatnonzero((graph.clip == clip) & graph.original)
    if not nodes.size:
        raise InputError(f"clip {clip} has no node in it", graph.where)
    nodes = nodes[np.argsort(graph.frame[nodes], kind="stable")]
    steps = [_natural_step(graph, start, end) for start, end in pairwise(nodes)]
    return placed_clip(graph, nodes, np.reshape(steps, (-1, 3)), graph.clips[clip])


def clips_of_graph(graph: MotionGraph) -> list[Clip]:
    """All source clips of which the graph has a frame."""
    return [clip_of_graph(graph, int(clip)) for clip in np.unique(graph.clip[graph.original])]


def _natural_step(graph: MotionGraph, source: int, target: int) -> NDArray[np.float64]:
    edges = np.arange(graph.edge_start[source], graph.edge_start[source + 1])
    edges = edges[graph.natural[edges] & (graph.target[edges] == target)]
    return graph.displacement[edges[0]].astype(np.float64) if edges.size else np.zeros(3)
