"""The world: all characters as arrays, moved along the edges of one motion graph a tick at a time."""

import math
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from footwork.motion.angle import wrapped_angle
from footwork.motion.graph import MotionGraph
from footwork.motion.kept import keep
from footwork.motion.moves import LEAP, Moves
from footwork.runtime.characters import Motion, motion_of, no_characters, smoothing
from footwork.runtime.foot_lock import move_locks
from footwork.runtime.motion_rows import VELOCITY
from footwork.runtime.rotation_kernels import turned
from footwork.runtime.ticking import advance_kept, show_kept
from footwork.runtime.world_errors import NoSuchCharacter, WorldError, WorldFull, WrongMove

HALFLIFE = 0.1
"""Half-life of what inertialisation adds, s (conventions.md 10)."""


class World:
    """Characters on one motion graph: a node, a planar place and inertialisation offsets each, as arrays.

    The arrays below may be read at any time and are the world's own: they change with every step. A step or a pose
    of the same inputs gives the same bytes. Rows of slots that are not active mean nothing.

    Args:
        graph: what all characters move on.
        capacity: how many characters there is room for.
        inertialise: whether transitions are smoothed; without it the pose jumps.
        foot_lock: whether feet that stand stay where they are shown; without it they slide as much as transitions do.
        halflife: of what inertialisation adds, s.
        motion: ``motion_of(graph)`` of another world, to be shared; made anew where not given.

    Attributes:
        active: which slots hold a character.  # (capacity,) bool
        slots: those slots, in order.  # (n,)
        characters: all that is remembered of them.
        motion: what they move on.
        smoothing: how they are shown.
        node: where each is on the graph.  # (capacity,) int32
        place: planar place (x, z, yaw), metres and radians, yaw within -pi..pi.  # (capacity, 3) float64
        edge: the edge last taken, ``LEAP`` where it was none.  # (capacity,) int32
        natural: whether the last move followed the capture; true before the first.  # (capacity,) bool

    Raises:
        WorldError: for a capacity under one or a half-life not above zero.
    """

    def __init__(
        self,
        graph: MotionGraph,
        capacity: int,
        *,
        inertialise: bool = True,
        foot_lock: bool = True,
        halflife: float = HALFLIFE,
        motion: Motion | None = None,
    ) -> None:
        if capacity < 1:
            raise WorldError(f"capacity is {capacity}, expected at least 1")
        if not (math.isfinite(halflife) and halflife > 0.0):
            raise WorldError(f"halflife is {halflife}, expected a positive number of seconds")
        joints = graph.skeleton.joint_count
        self.graph = graph
        self.capacity = capacity
        self.active = np.zeros(capacity, dtype=np.bool_)
        self.slots = np.flatnonzero(self.active)
        self.motion = motion_of(graph) if motion is None else motion
        self.smoothing = smoothing(inertialise, foot_lock, halflife)
        self.characters = no_characters(capacity, joints, len(self.motion.legs))
        self.node, self.place = self.characters.node, self.characters.place
        self.edge, self.natural = self.characters.edge, self.characters.natural
        self._shown = np.zeros((capacity, 3), dtype=np.float32), np.zeros((capacity, joints, 4), dtype=np.float32)
        self._kept = keep((self.characters, self.motion, self.smoothing, *self._shown))

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
        self.slots = np.flatnonzero(self.active)
        self.node[slot] = node
        self.edge[slot], self.natural[slot] = LEAP, True
        self.place[slot] = x, z, wrapped_angle(yaw)
        self._begin_smoothing(slot)
        return slot

    def _begin_smoothing(self, slot: int) -> None:
        """Without offsets, glide or foot locks."""
        one = self.characters
        for array in (one.glide, one.ticks_left, one.offsets, one.roots, one.locked, one.anchor, one.slip, one.stride):
            array[slot] = 0

    def remove(self, slot: int) -> None:
        """Take a character out of the world.

        Raises:
            NoSuchCharacter: for a slot that holds none.
        """
        self.require(slot)
        self.active[slot] = False
        self.slots = np.flatnonzero(self.active)
        self.node[slot] = 0

    def correct(self, slot: int, x: float, z: float, yaw: float) -> None:
        """Put a character somewhere else (a wall stopped it); its motion goes on, turned with it.

        Raises:
            NoSuchCharacter: for a slot that holds none.
            WorldError: for a place that is not finite.
        """
        self.require(slot)
        _require_finite(x, z, yaw)
        move_locks(self.characters.anchor[slot], self.characters.slip[slot], self.place[slot], (x, z, yaw))
        turn = yaw - self.place[slot, 2]
        self.place[slot] = x, z, wrapped_angle(yaw)
        # What these hold is given in the world: the root's offset and velocity, and those of joint 0.
        joint = self.characters.offsets[slot, :, 0]
        for vectors in (*self.characters.roots[slot], joint[:VELOCITY], joint[VELOCITY:]):
            vectors[:] = turned(math.cos(turn), math.sin(turn), vectors)

    def teleport(self, slot: int, x: float, z: float, yaw: float) -> None:
        """Put a character somewhere else as if it had always been there: what smooths its motion does not go along.

        Raises:
            NoSuchCharacter: for a slot that holds none.
            WorldError: for a place that is not finite.
        """
        self.require(slot)
        _require_finite(x, z, yaw)
        self.place[slot] = x, z, wrapped_angle(yaw)
        self._begin_smoothing(slot)

    def step(self, moves: Moves, slots: NDArray[np.intp] | None = None) -> None:
        """Advance characters one tick by the moves chosen for them.

        Args:
            moves: a row for each slot; rows of other slots are ignored.  # capacity rows
            slots: whose, all of them active; all that are where not given.  # (n,)

        Raises:
            WrongMove: when an edge does not leave from its character's node or lead to its target, and for a target
                or a place that is none; nobody has moved then.
        """
        wrong = advance_kept(
            self.slots if slots is None else slots,
            moves.edge,
            moves.target,
            moves.displacement,
            moves.adjustment,
            moves.natural,
            self._kept,
        )
        if wrong >= 0:
            self.raise_wrong_move(wrong, moves)

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
        if len(self.slots):
            show_kept(self.slots, fraction, self._kept)
        return self._shown

    def require(self, slot: int) -> None:
        """Refuse a slot that holds no character.

        Raises:
            NoSuchCharacter: for such a slot.
        """
        if not (0 <= slot < self.capacity and self.active[slot]):
            raise NoSuchCharacter(f"no character {slot}; there are {int(self.active.sum())}")

    def raise_wrong_move(self, slot: int, moves: Moves) -> NoReturn:
        """Say what is wrong with a move that could not be made.

        Raises:
            WrongMove: always.
        """
        node, edge, target = (int(array[slot]) for array in (self.node, moves.edge, moves.target))
        first, end = (int(self.graph.edge_start[node + step]) for step in (0, 1))
        if edge != LEAP and not first <= edge < end:
            raise WrongMove(f"character {slot} at node {node} was given edge {edge}, expected {first} to {end - 1}")
        wrong_end = edge != LEAP and self.graph.target[edge] != target
        if wrong_end or not 0 <= target < self.graph.node_count:
            valid = f"{self.graph.target[edge]}" if edge != LEAP else f"0 to {self.graph.node_count - 1}"
            raise WrongMove(f"character {slot} at node {node} was sent to node {target}, expected {valid}")
        raise WrongMove(f"character {slot} at node {node} was sent to a place that is not finite")


def _require_finite(x: float, z: float, yaw: float) -> None:
    if not all(math.isfinite(value) for value in (x, z, yaw)):
        raise WorldError(f"place ({x}, {z}, {yaw}), expected finite numbers")
