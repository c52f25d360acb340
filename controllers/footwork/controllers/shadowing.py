"""Shadowing by a table: at the end of each segment the hop that costs least from there on."""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import FootworkError
from footwork.motion.annotation import Annotation
from footwork.motion.graph import MotionGraph
from footwork.motion.hops import Hops, hops_within
from footwork.motion.shadowing_lookahead import ShadowingRules, best_hop, rules_of_shadowing
from footwork.motion.shadowing_table import ShadowingTable


class NotShadowing(FootworkError):  # noqa: N818  (it reads as what happened)
    """A hop was asked for at the end of a segment of another state."""


class TableShadowing:
    """Picks segments of one state so that the opponent stays at a distance and in front (conventions.md 11).

    Args:
        graph: what the characters move on.
        annotation: its segments.
        table: the values that were solved for on them.

    Attributes:
        rules: what the kernel ``best_hop`` takes, and so do
        hops: of the state, and
        values: in float32.  # (R, D, P)

    Raises:
        InputError: for a table that has not converged or belongs to another graph.
    """

    def __init__(self, graph: MotionGraph, annotation: Annotation, table: ShadowingTable) -> None:
        table.require_converged().require_fits(annotation)
        self.rules: ShadowingRules = rules_of_shadowing(table.task)
        self.hops: Hops = hops_within(graph, annotation, table.state)
        self.values: NDArray[np.float32] = table.values

    def next_edge(self, segment: int, x: float, z: float) -> int:
        """The edge to take at the end of a segment.

        Args:
            segment: of the table's state.
            x: where the opponent is, in the planar frame of the segment's last node, metres.
            z: likewise.

        Raises:
            NotShadowing: for a segment of another state.
        """
        row = int(self.hops.row[segment])
        if row < 0:
            raise NotShadowing(f"segment {segment} is of another state")
        return int(self.hops.edge[best_hop(self.rules, self.hops, self.values, row, x, z)[1]])
