"""The world: all characters as arrays, moved along the edges of one motion graph a tick at a time."""

import math

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.errors import FootworkError
from footwork.motion.graph import MotionGraph
from footwork.motion.tick import TICK
from footwork.runtime import posing
from footwork.runtime.inertialisation import decay, jump, ticks_to_settle
from footwork.runtime.motion_rows import VELOCITY, node_rows, offset_rows
from footwork.runtime.rotation_kernels import turned

NO_EDGE = -1
HALFLIFE = 0.1
"""Half-life of what inertialisation adds, s (conventions.md 10)."""


class WorldError(FootworkError):
    """The world was asked for something that it cannot do."""


class WorldFull(WorldError):  # noqa: N818  (it reads as what happened)
    """A character was spawned where there is no room for another."""


class NoSuchCharacter(WorldError):  # noqa: N818
    """A slot was named that holds no character."""


class WrongEdge(WorldError):  # noqa: N818
    """A character was told to take an edge that does not leave from its node."""


@numba.njit(cache=True, nogil=True)
def within_half_turn(angle: float) -> float:
    """The same direction as an angle in -pi..pi; angles already there stay as they are to the last bit."""
    return angle - 2.0 * math.pi * math.floor(angle / (2.0 * math.pi) + 0.5)


@numba.njit(cache=True, nogil=True)
def first_wrong_edge(active: NDArray, node: NDArray, edges: NDArray, edge_start: NDArray) -> int:
    """The first active row whose edge does not leave from its node, -1 for none."""
    for who in range(active.shape[0]):
        if active[who] and not edge_start[node[who]] <= edges[who] < edge_start[node[who] + 1]:
            return who
    return -1


@numba.njit(cache=True, nogil=True)
def take_edges(active: NDArray, edges: NDArray, target: NDArray, displacement: NDArray, node: NDArray, place: NDArray):
    """Move all active characters along their edges, in place; yaw is kept within -pi..pi.

    Args:
        active: which rows are characters.  # (C,)
        edges: the edge each takes.  # (C,)
        target: of the graph.  # (E,)
        displacement: of the graph.  # (E, 3)
        node: where each is.  # (C,)
        place: planar places (x, z, yaw).  # (C, 3)
    """
    for who in range(active.shape[0]):
        if not active[who]:
            continue
        edge = edges[who]
        yaw = place[who, 2]
        x, _, z = turned(math.cos(yaw), math.sin(yaw), (displacement[edge, 0], 0.0, displacement[edge, 1]))
        place[who, 0] += x
        place[who, 1] += z
        place[who, 2] = within_half_turn(yaw + displacement[edge, 2])
        node[who] = target[edge]


@numba.njit(cache=True, nogil=True)
def take_jumps(
    settle_ticks: int,
    ticks_left: NDArray,
    active: NDArray,
    edges: NDArray,
    natural: NDArray,
    old_node: NDArray,
    old_place: NDArray,
    node: NDArray,
    place: NDArray,
    root_position: NDArray,
    root_velocity: NDArray,
    nodes: NDArray,
    offsets: NDArray,
    roots: NDArray,
) -> None:
    """``inertialisation.jump`` for all active characters whose edge is a transition; see there for the arrays.

    ``ticks_left`` is set to ``settle_ticks`` for them.
    """
    for who in range(active.shape[0]):
        if active[who] and not natural[edges[who]]:
            ticks_left[who] = settle_ticks
            jump(
                who,
                old_node[who],
                old_place[who],
                node[who],
                place[who],
                root_position,
                root_velocity,
                nodes,
                offsets,
                roots,
            )


class World:
    """Characters on one motion graph: a node, a planar place and inertialisation offsets each, as arrays.

    The arrays below may be read at any time and are the world's own: they change with every step. A step or a pose
    of the same inputs gives the same bytes. Rows of slots that are not active mean nothing.

    Args:
        graph: what all characters move on.
        capacity: how many characters there is room for.
        inertialise: whether transitions are smoothed; without it the pose jumps.
        halflife: of what inertialisation adds, s.

    Attributes:
        active: which slots hold a character.  # (capacity,) bool
        node: where each is on the graph.  # (capacity,) int32
        place: planar place (x, z, yaw), metres and radians, yaw within -pi..pi.  # (capacity, 3) float64
        edge: the edge last taken, -1 before the first.  # (capacity,) int32

    Raises:
        WorldError: for a capacity under one or a half-life not above zero.
    """

    def __init__(self, graph: MotionGraph, capacity: int, inertialise: bool = True, halflife: float = HALFLIFE) -> None:
        if capacity < 1:
            raise WorldError(f"capacity is {capacity}, expected at least 1")
        if not (math.isfinite(halflife) and halflife > 0.0):
            raise WorldError(f"halflife is {halflife}, expected a positive number of seconds")
        joints = graph.skeleton.joint_count
        self.graph = graph
        self.capacity = capacity
        self.inertialise = inertialise
        self.halflife = halflife
        self.active = np.zeros(capacity, dtype=np.bool_)
        self.node = np.zeros(capacity, dtype=np.int32)
        self.place = np.zeros((capacity, 3))
        self.edge = np.full(capacity, NO_EDGE, dtype=np.int32)
        self._offsets = offset_rows(capacity, joints)
        self._roots = np.zeros((capacity, 2, 3))
        self._ticks_left = np.zeros(capacity, dtype=np.int32)
        self._settle_ticks = ticks_to_settle(halflife)
        self._old_node = np.zeros_like(self.node)
        self._old_place = np.zeros_like(self.place)
        self._shown_root = np.zeros((capacity, 3), dtype=np.float32)
        self._shown_rotations = np.zeros((capacity, joints, 4), dtype=np.float32)
        self._motion = (graph.root_position, graph.root_velocity, node_rows(graph))

    def spawn(self, node: int, x: float, z: float, yaw: float) -> int:
        """Put a new character on a node at a planar place; its slot is the lowest free one.

        Raises:
            WorldFull: when every slot is taken.
            WorldError: for a node that is not in the graph or a place that is not finite.
        """
        if not 0 <= node < self.graph.node_count:
            raise WorldError(f"node {node}, expected 0 to {self.graph.node_count - 1}")
        _require_finite(x, z, yaw)
        slot = int(np.argmin(self.active))
        if self.active[slot]:
            raise WorldFull(f"all {self.capacity} characters are taken; remove one first")
        self.active[slot] = True
        self.node[slot] = node
        self.edge[slot] = NO_EDGE
        self.place[slot] = x, z, within_half_turn(yaw)
        self._offsets[slot] = self._roots[slot] = self._ticks_left[slot] = 0
        return slot

    def remove(self, slot: int) -> None:
        """Take a character out of the world.

        Raises:
            NoSuchCharacter: for a slot that holds none.
        """
        self._require(slot)
        self.active[slot] = False
        self.node[slot] = 0

    def correct(self, slot: int, x: float, z: float, yaw: float) -> None:
        """Put a character somewhere else (a wall stopped it, a teleport); its motion goes on, turned with it.

        Raises:
            NoSuchCharacter: for a slot that holds none.
            WorldError: for a place that is not finite.
        """
        self._require(slot)
        _require_finite(x, z, yaw)
        turn = yaw - self.place[slot, 2]
        self.place[slot] = x, z, within_half_turn(yaw)
        # What these hold is given in the world: the root's offset and velocity, and those of joint 0.
        joint = self._offsets[slot, :, 0]
        for vectors in (*self._roots[slot], joint[:VELOCITY], joint[VELOCITY:]):
            vectors[:] = turned(math.cos(turn), math.sin(turn), vectors)

    def step(self, edges: NDArray[np.int32]) -> None:
        """Advance every active character one tick along the edge chosen for it.

        Args:
            edges: the edge of each slot; entries of slots that are not active are ignored.  # (capacity,)

        Raises:
            WrongEdge: when an edge does not leave from its character's node; nobody has moved then.
        """
        graph = self.graph
        wrong = first_wrong_edge(self.active, self.node, edges, graph.edge_start)
        if wrong >= 0:
            self._raise_wrong_edge(wrong, int(edges[wrong]))
        self._old_node[:] = self.node
        self._old_place[:] = self.place
        take_edges(self.active, edges, graph.target, graph.displacement, self.node, self.place)
        self.edge[:] = edges
        if self.inertialise:
            self._carry_over(edges)

    def _carry_over(self, edges: NDArray[np.int32]) -> None:
        """Let the offsets decay over the tick that ended, then take the jumps of transitions into them."""
        decay(self._ticks_left, self._offsets, self._roots, TICK, self.halflife)
        take_jumps(
            self._settle_ticks,
            self._ticks_left,
            self.active,
            edges,
            self.graph.natural,
            self._old_node,
            self._old_place,
            self.node,
            self.place,
            *self._motion,
            self._offsets,
            self._roots,
        )

    def show(self, fraction: float) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """The poses at a fraction of the tick in (0, 1]: 1 is the node itself, near 0 where the last tick ended.

        Returns:
            The place of joint 0 in the world, metres (capacity, 3), and the local rotations xyzw with joint 0 in the
            world (capacity, J, 4). Both are the world's own buffers, which the next call writes over.

        Raises:
            WorldError: for a fraction outside (0, 1].
        """
        if not 0.0 < fraction <= 1.0:
            raise WorldError(f"fraction is {fraction}, expected above 0 and at most 1")
        posing.pose(
            self.active,
            self.node,
            self.place,
            fraction,
            self.halflife,
            *self._motion,
            self._offsets,
            self._roots,
            self._shown_root,
            self._shown_rotations,
        )
        return self._shown_root, self._shown_rotations

    def _require(self, slot: int) -> None:
        if not (0 <= slot < self.capacity and self.active[slot]):
            raise NoSuchCharacter(f"no character {slot}; there are {int(self.active.sum())}")

    def _raise_wrong_edge(self, slot: int, edge: int) -> None:
        node = int(self.node[slot])
        first, end = (int(self.graph.edge_start[node + step]) for step in (0, 1))
        raise WrongEdge(f"character {slot} at node {node} was given edge {edge}, expected {first} to {end - 1}")


def _require_finite(x: float, z: float, yaw: float) -> None:
    if not all(math.isfinite(value) for value in (x, z, yaw)):
        raise WorldError(f"place ({x}, {z}, {yaw}), expected finite numbers")
