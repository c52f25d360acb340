"""Moves: what characters do in the next tick, as arrays that controllers fill and the world carries out."""

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.graph import MotionGraph

LEAP = -1
"""In place of an edge: a move to a frame that no edge leads to."""


@dataclass(frozen=True, eq=False)
class Moves:
    """One tick of each of C characters: to which frame, where that frame stands, and whether it follows the capture.

    A character at planar place P is at ``P displacement adjustment`` after the tick, three planar transforms.

    Args:
        edge: the edge taken, ``LEAP`` for none.  # (C,) int32
        target: the frame moved to.  # (C,) int32
        displacement: its planar place (x, z, yaw) in the frame left, as the capture or an alignment has it, metres and
            radians.  # (C, 3)
        adjustment: what a controller adds, a planar transform in the target's planar frame; zero for none.  # (C, 3)
        natural: whether the pose follows the capture, so that there is no jump to smooth.  # (C,) bool
    """

    edge: NDArray[np.int32]
    target: NDArray[np.int32]
    displacement: NDArray[np.float64]
    adjustment: NDArray[np.float64]
    natural: NDArray[np.bool_]

    def first(self, count: int) -> "Moves":
        """Views of the first so many rows."""
        return Moves(*(array[:count] for array in self._arrays))

    def put(self, rows: NDArray[np.intp], others: "Moves") -> None:
        """Write the rows of ``others``, one after the other, into the rows named.  # rows (n,)"""
        for mine, other in zip(self._arrays, others._arrays, strict=True):
            mine[rows] = other

    @property
    def _arrays(self) -> tuple[NDArray, ...]:
        return self.edge, self.target, self.displacement, self.adjustment, self.natural


def no_moves(count: int) -> Moves:
    """Room for the moves of so many characters."""
    return Moves(
        edge=np.full(count, LEAP, np.int32),
        target=np.zeros(count, np.int32),
        displacement=np.zeros((count, 3)),
        adjustment=np.zeros((count, 3)),
        natural=np.zeros(count, np.bool_),
    )


def along_edges(graph: MotionGraph, edges: NDArray[np.int32], moves: Moves) -> None:
    """Fill moves with edges of a graph, taken as they are.  # edges (C,)"""
    into = moves.edge, moves.target, moves.displacement, moves.adjustment, moves.natural
    fill_moves(edges, graph.target, graph.displacement, graph.natural, *into)


def moves_along(graph: MotionGraph, edges: NDArray[np.int32]) -> Moves:
    """The moves of characters that take edges of a graph as they are.  # edges (C,)"""
    moves = no_moves(len(edges))
    along_edges(graph, edges, moves)
    return moves


@numba.njit(cache=True, nogil=True)
def fill_moves(
    edges: NDArray,
    graph_target: NDArray,
    graph_displacement: NDArray,
    graph_natural: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
) -> None:
    """``along_edges`` for kernels: the arrays of a graph, then those of the moves."""
    for who in range(edges.shape[0]):
        taken = edges[who]
        edge[who] = taken
        target[who] = graph_target[taken]
        natural[who] = graph_natural[taken]
        for k in range(3):
            displacement[who, k] = graph_displacement[taken, k]
            adjustment[who, k] = 0.0
