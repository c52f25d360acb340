"""What is done to poses before they are shown: switches, so that the worth of each can be measured."""

from dataclasses import dataclass

from footwork.motion.graph import MotionGraph
from footwork.runtime.world import World


@dataclass(frozen=True)
class Showing:
    """What is done to poses before they are shown; each can be left out, to see what it is worth.

    Args:
        inertialise: whether transitions are smoothed.
        foot_lock: whether standing feet are kept where they stand.
    """

    inertialise: bool = True
    foot_lock: bool = True

    def world(self, graph: MotionGraph, capacity: int) -> World:
        """An empty world that shows so."""
        return World(graph, capacity, inertialise=self.inertialise, foot_lock=self.foot_lock)
