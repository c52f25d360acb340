"""A path that shows what a motion graph can do: from each kind of motion to the next, through the middle of each."""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.study.graph_paths import best_path_through

_ORDER = ("idle", "walk", "run", "jump", "duck", "turn", "pick")
_SHORTEST = 10  # frames: shorter stretches show little of what they are


def tour(graph: MotionGraph) -> NDArray[np.int64] | None:
    """The edges of a best path through all labels and back to the first, None with fewer than two or with no way.

    Idle, walk, run, jump, duck, turn, pick come in this order, other labels after them. The path comes through the
    middle of a captured stretch of each, of which the cheapest to reach is taken, and goes on for half a second.
    """
    stops = [middles(graph, label) for label in tour_labels(graph)]
    if len(stops) < 2:
        return None
    try:
        return best_path_through(graph, [stops[0][:1], *stops[1:], stops[0]], ticks=15)
    except InputError:  # a graph that is not connected has no tour
        return None


def tour_labels(graph: MotionGraph) -> list[str]:
    """The labels of captured frames in the order in which a tour shows them."""
    shown = [graph.labels[index] for index in np.unique(graph.label[graph.original])]
    return sorted(
        filter(None, shown), key=lambda label: (_ORDER.index(label) if label in _ORDER else len(_ORDER), label)
    )


def middles(graph: MotionGraph, label: str) -> NDArray[np.intp]:
    """The middle nodes of the captured stretches of a label that last a third of a second, or of the longest one."""
    nodes = np.flatnonzero(graph.original & (graph.label == graph.labels.index(label)))
    nodes = nodes[np.lexsort((graph.frame[nodes], graph.clip[nodes]))]
    follows = (np.diff(graph.clip[nodes]) == 0) & (np.diff(graph.frame[nodes]) == 1)
    stretches = np.split(nodes, np.flatnonzero(~follows) + 1)
    least = min(_SHORTEST, max(len(stretch) for stretch in stretches))
    return np.array([stretch[len(stretch) // 2] for stretch in stretches if len(stretch) >= least])
