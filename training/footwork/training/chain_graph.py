"""A motion graph out of some nodes of chains and the edges that join them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.training.chain_edges import ChainEdges
from footwork.training.chains import Chains
from footwork.training.interpolation import poses_of
from footwork.training.planar_poses import planar_poses
from footwork.training.row_metric import RowMetric, uniform_rows
from footwork.training.standard_graph import moved, relative

_SOURCES = ("clip", "frame", "other_clip", "other_frame", "weight", "label", "behaviour", "contacts")


def graph_of_chains(
    clips: Sequence[Clip],
    chains: Chains,
    nodes: NDArray[np.intp],
    edges: ChainEdges,
    sigma: float,
    metric: RowMetric | None = None,
) -> MotionGraph:
    """The motion graph of some nodes of chains; a transition's two sides are aligned by the metric.

    Args:
        clips: what the chains were made of.
        chains: the chains.
        nodes: the nodes, ascending.  # (n,)
        edges: edges between these nodes, by their numbers in the chains.
        sigma: the task's smoothness_sigma: smoothness is exp(-s / sigma) by the uniform metric.
        metric: that aligns, of these chains; the uniform one where not given.
    """
    poses = _poses(clips, chains, nodes)
    places = poses.pop("places")
    source, target = np.searchsorted(nodes, edges.source), np.searchsorted(nodes, edges.target)
    there = places[target].copy()
    jumps = np.flatnonzero(~edges.natural)
    # an edge leads to the frame after the one that its source is like
    here, similar = chains.row_of_node[edges.source[jumps]], chains.row_of_node[edges.target[jumps]] - 1
    uniform = uniform_rows(chains)
    there[jumps] = moved(there[jumps], (metric or uniform).align(here, similar))
    judged = edges.cost.copy()
    if metric is not None:
        judged[jumps] = uniform.costs(here, similar)
    sources: dict[str, Any] = {name: getattr(chains, name)[nodes] for name in _SOURCES}
    return MotionGraph(
        skeleton=chains.skeleton,
        clips=chains.clips,
        labels=chains.labels,
        behaviours=chains.behaviours,
        edge_start=np.searchsorted(source, np.arange(len(nodes) + 1)).astype(np.int32),
        target=target.astype(np.int32),
        cost=edges.cost.astype(np.float32),
        smoothness=np.exp(-judged / sigma).astype(np.float32),
        displacement=relative(places[source], there).astype(np.float32),
        natural=edges.natural,
        **sources,
        **poses,
    )


def _poses(clips: Sequence[Clip], chains: Chains, nodes: NDArray) -> dict[str, Any]:
    """Poses, velocities and places in their chains' worlds of some nodes, by name."""
    which = np.unique(chains.chain_of_node[nodes])
    lengths = chains.length[which] + 2 * chains.context[which]
    # the rows of the chosen chains, laid end to end
    ahead = np.cumsum(lengths) - lengths - chains.first_row[which]
    row = chains.row_of_node[nodes] + ahead[np.searchsorted(which, chains.chain_of_node[nodes])]
    whole = planar_poses(chains.skeleton, *poses_of(clips, chains, which), lengths)
    return {name: values[row] for name, values in whole.items()}
