"""From one bundle to another under running sessions: who goes on where.

A character goes on at its place, at the node of the same behaviour whose pose is nearest: the least sum of squares of
the distances between joints, in each one's own planar frame, and of how far the root travels in 0.2 s (convention).
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import NONE, Command
from footwork.errors import InputError
from footwork.motion.graph import MotionGraph
from footwork.motion.skeleton import Skeleton
from footwork.runtime.arena import Arena
from footwork.runtime.simulation import Simulation

_AHEAD = 0.2
_ROWS = 256
_EXACT = ("parents", "feet")
_CLOSE = ("offsets", "ends")


class Succession:
    """One simulation takes the place of another.

    All that takes long is done here, so that it can be done beside the ticks.

    Args:
        former: the one that runs.
        latter: the one that follows it, with no character yet and room for all.

    Raises:
        InputError: for another body, and where characters fight.
    """

    def __init__(self, former: Simulation, latter: Simulation) -> None:
        require_same_body(former.world.graph.skeleton, latter.world.graph.skeleton)
        if isinstance(former, Arena):
            raise InputError("fights do not go over to another bundle", latter.world.graph.where)
        self.former = former
        self.latter = latter
        self._nearest = nearest_nodes(former.world.graph, latter.world.graph)

    def move(self, slot: int) -> int:
        """Let a character go on in the new simulation with what it was last asked for; returns its slot there."""
        former, latter = self.former, self.latter
        x, z, yaw = former.world.place[slot].tolist()
        heading, behaviour, speed = former.lasting(slot)
        behaviour = behaviour if behaviour in latter.behaviours else ""
        speed = speed if behaviour in latter.speeds else None
        given = former.orders.in_force
        held, waiting = self._number(given.held[slot]), self._number(given.latched[slot])
        node = int(self._nearest[former.world.node[slot]])
        there = latter.spawn(x, z, yaw, behaviour, node=node, held=held if waiting == NONE else NONE)
        asked = latter.vocabulary.outright(heading, behaviour, speed) if behaviour else Command(yaw, NONE)
        # what waits is asked for anew, what was answered is not, though its key is held
        for one_shot in (held,) if waiting in (NONE, held) else (waiting, NONE):
            latter.give(there, replace(asked, one_shot=one_shot))
        return there

    def _number(self, behaviour: int) -> int:
        """The new simulation's number for a behaviour of the old one; NONE for none, and for one that it lacks."""
        name = "" if behaviour == NONE else self.former.world.graph.behaviours[behaviour]
        return self.latter.vocabulary.index(name) if name in self.latter.behaviours else NONE


def require_same_body(one: Skeleton, other: Skeleton) -> None:
    """Make sure that poses of one body can be shown on the other.

    Raises:
        InputError: where joints, their parents, their places or the feet differ.
    """
    same = one.names == other.names and all(np.array_equal(getattr(one, k), getattr(other, k)) for k in _EXACT)
    if not same or not all(np.allclose(getattr(one, k), getattr(other, k), atol=1e-6) for k in _CLOSE):
        raise InputError("another body than that of the bundle it would replace", other.where)


def nearest_nodes(former: MotionGraph, latter: MotionGraph) -> NDArray[np.int32]:
    """For each node of one graph the nearest of another, of the same behaviour where it has any such.  # (N,)"""
    ours, theirs = _poses(former), _poses(latter)
    shows = np.array([*former.behaviours, ""])[former.behaviour]
    offered = np.array([*latter.behaviours, ""])[latter.behaviour]
    nearest = np.zeros(former.node_count, dtype=np.int32)
    for name in np.unique(shows):
        among = np.flatnonzero(offered == name)
        among = among if len(among) else np.arange(latter.node_count)
        asking = np.flatnonzero(shows == name)
        nearest[asking] = among[_nearest_rows(ours[asking], theirs[among])]
    return nearest


def _poses(graph: MotionGraph) -> NDArray[np.float32]:
    """What nodes are compared by, a row each.  # (N, 3 J + 3)"""
    joints = graph.joint_places.reshape(graph.node_count, -1)
    return np.hstack([joints, _AHEAD * graph.root_velocity]).astype(np.float32)


def _nearest_rows(rows: NDArray, among: NDArray) -> NDArray[np.intp]:
    """For each row the index of the one nearest to it.  # (n,)"""
    squares = np.einsum("ij,ij->i", among, among)
    parts = [rows[start : start + _ROWS] for start in range(0, len(rows), _ROWS)]
    return np.concatenate([np.argmin(squares - 2.0 * part @ among.T, axis=1) for part in parts])
