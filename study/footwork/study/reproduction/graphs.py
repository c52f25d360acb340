"""The graphs of one set of motion at any threshold: standard and well-connected, flat, from one search each."""

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from footwork.motion.clip import Clip
from footwork.motion.graph import MotionGraph
from footwork.motion.metric import PointCloudMetric
from footwork.motion.task import BEHAVIOURS, SteeringTask
from footwork.study.closure import parts_of
from footwork.study.reproduction.flat_graph import FlatGraph, standard_flat_graph
from footwork.training.chain_edges import ChainEdges, edges_of_chains
from footwork.training.chains import Chains
from footwork.training.connectivity import connecting_threshold, largest_component, restricted
from footwork.training.interpolation import interpolated
from footwork.training.nodes import Nodes, nodes_of
from footwork.training.stages import Stages
from footwork.training.standard_graph import standard_graph
from footwork.training.transition_search import search
from footwork.training.transitions import Minima, local_minima

Tell = Callable[[str, float], None]
LEAST = 0.01  # of the highest threshold is the lowest that is tried
PRECISION = 0.01
SIGMA = SteeringTask().smoothness_sigma


class Graphs:
    """What can be built of some clips.

    Args:
        name: of the set, for progress.
        clips: of one body at 30 frames a second.
        weights: between two segments of an interpolated pair, at most where ``hops`` is given.
        tell: told what is being done and the share of it that is done.
        searched_to: threshold to which transitions are sought at once, where lower ones are asked for.
        hops: where given, pairs have only as many weights as hops under this threshold need.

    Attributes:
        stages: what was done, with the seconds that it took.
    """

    def __init__(
        self,
        name: str,
        clips: Sequence[Clip],
        weights: int,
        tell: Tell,
        searched_to: float = 0.0,
        hops: float | None = None,
    ) -> None:
        self.clips, self.weights, self._searched_to, self._hops = clips, weights, searched_to, hops
        self.stages = Stages(lambda stage, share: tell(f"{name}: {stage}", share))
        # the pairs found so far: all under a threshold, which hold those under a lower one
        self._found: tuple[float, Minima] | None = None
        self._edges: tuple[float, ChainEdges] | None = None

    @cached_property
    def nodes(self) -> Nodes:
        """The captured frames."""
        return nodes_of(self.clips, BEHAVIOURS)

    @cached_property
    def metric(self) -> PointCloudMetric:
        """The metric of the captured frames."""
        return PointCloudMetric.of_clips(self.clips)

    @cached_property
    def minima(self) -> Minima:
        """All local minima between captured frames, whatever they cost."""
        with self.stages("comparison of frames"):
            return local_minima(self.metric.all_pairs(), self.nodes.lengths)

    @cached_property
    def chains(self) -> Chains:
        """Clips and interpolated segments."""
        with self.stages("interpolation") as tell:
            return interpolated(self.clips, BEHAVIOURS, self.weights, threshold=self._hops, progress=tell)[0]

    def standard(self, threshold: float) -> FlatGraph:
        """The standard graph."""
        return standard_flat_graph(self.nodes, self.minima.under(threshold))

    def well_connected(self, threshold: float) -> FlatGraph:
        """The well-connected graph before reduction."""
        chains, edges = self.chains, self.edges(threshold)
        return FlatGraph(
            edge_start=np.searchsorted(edges.source, np.arange(chains.node_count + 1)),
            target=edges.target,
            kind=chains.label,
            kinds=chains.labels,
            frames=np.arange(chains.original_count, dtype=np.int32),
            captured=chains.original_count,
        )

    def well_minima(self, threshold: float) -> Minima:
        """The transitions between all nodes of the chains; those of the highest threshold so far are kept."""
        if self._found is None or self._found[0] < threshold:
            chains, highest = self.chains, max(threshold, self._searched_to)
            with self.stages(f"transitions at {highest:g}") as tell:
                self._found = highest, search(chains, highest, progress=tell)
        return self._found[1].under(threshold)

    def edges(self, threshold: float) -> ChainEdges:
        """The edges of the well-connected graph before reduction; those of the last threshold are kept."""
        if self._edges is None or self._edges[0] != threshold:
            self._edges = threshold, edges_of_chains(self.chains, self.well_minima(threshold), threshold)
        return self._edges[1]

    def standard_motion_graph(self, threshold: float) -> MotionGraph:
        """The largest connected part of the standard graph, with poses."""
        return connected_part(standard_graph(self.nodes, self.metric, self.minima.under(threshold), SIGMA))

    def standard_threshold(self, share: float) -> float | None:
        """The lowest threshold at which the standard graph connects a share of the frames, None for none."""
        return connecting_threshold(self.nodes.ends, self.minima, share)

    def well_connected_threshold(self, share: float, highest: float) -> float | None:
        """A threshold up to ``highest`` from which the well-connected graph does, to PRECISION; None for none."""
        if self.well_connected(highest).connected().captured_share < share:
            return None
        low, high = highest * LEAST, highest
        while high > low * (1.0 + PRECISION):
            middle = float(np.sqrt(low * high))
            if self.well_connected(middle).connected().captured_share >= share:
                high = middle
            else:
                low = middle
        return high

    def share_beyond(self, inner: FlatGraph, threshold: float) -> float:
        """The share that the well-connected graph connects at a threshold, from a graph at a lower one.

        Local minima do not depend on the threshold, so what is connected at a lower one stays so: only pairs with a
        side outside that part need to be sought.
        """
        part = parts_of(inner.edge_start, inner.target)
        outside = part != np.argmax(np.bincount(part))
        with self.stages(f"what is still unconnected at {threshold:g}") as tell:
            more = search(self.chains, threshold, active=outside, progress=tell)
        edges = edges_of_chains(self.chains, more, threshold)
        source = np.concatenate([inner.source, edges.source])
        target = np.concatenate([inner.target, edges.target])
        part = largest_component(inner.node_count, source, target)
        return float((part < self.chains.original_count).mean() * len(part) / self.chains.original_count)


def connected_part(graph: MotionGraph) -> MotionGraph:
    """The largest strongly connected part of a motion graph."""
    return restricted(graph, largest_component(graph.node_count, graph.source, graph.target))
