"""Many characters whose ticks are spread over the frames that are shown, so that all frames take alike.

A tick takes longer than a frame is shown for when thousands of characters make it at once. What one character does
depends on no other, so a crowd is parted into as many groups as frames are shown in a tick, and each frame is the tick
of one group. Every group makes thirty ticks a second; between its ticks it is shown as any simulation is.
"""

from footwork.errors import InputError
from footwork.motion.bundle import Bundle
from footwork.runtime.pose_frames import PoseFrames
from footwork.runtime.simulation import Simulation


class Crowd:
    """Characters of one bundle, in groups that tick in turn.

    Each group is a simulation of its own: what it is told, recorded and restored is its own affair. A character that is
    told something waits for its group's next tick, as long as in any simulation.

    Args:
        bundle: the graph and its "steering" table.
        capacity: how many characters there is room for, in all groups together.
        frames: how many frames are shown in a tick (2 for sixty a second), and so how many groups there are.

    Attributes:
        groups: the simulations, in the order in which they tick.
        frame: the frame last made, from 0.

    Raises:
        InputError: for no frame or fewer places than groups, and what ``Simulation`` raises.
    """

    def __init__(self, bundle: Bundle, capacity: int, *, frames: int = 2) -> None:
        if not 1 <= frames <= capacity:
            raise InputError(f"{frames} frames a tick for {capacity} characters, expected 1 to {capacity}", "crowd")
        rooms = [capacity // frames + (group < capacity % frames) for group in range(frames)]
        first = Simulation(bundle, rooms[0])
        self.groups = (first, *(Simulation(bundle, room, motion=first.world.motion) for room in rooms[1:]))
        self.frame = 0

    def spawn(self, x: float, z: float, yaw: float, behaviour: str = "") -> tuple[Simulation, int]:
        """Put a character into the group with the fewest; that group, and its slot there.

        Raises:
            UnknownBehaviour: for a behaviour that the bundle lacks.
            WorldFull: where there is no room in any group.
        """
        group = min((group for group in self.groups if not group.full), key=_size, default=self.groups[0])
        return group, group.spawn(x, z, yaw, behaviour)

    def advance(self) -> None:
        """Go on to the next frame: the group whose turn it is makes its tick."""
        self.groups[self.frame % len(self.groups)].step()
        self.frame += 1

    def show(self) -> list[PoseFrames]:
        """What is shown of each group at the frame last made."""
        return [group.show(self._fraction(turn)) for turn, group in enumerate(self.groups)]

    def _fraction(self, turn: int) -> float:
        """How much of its tick the group whose turn is so many frames after the first one's has been through."""
        count = len(self.groups)
        return ((self.frame - 1 - turn) % count + 1) / count


def _size(group: Simulation) -> int:
    return len(group.world.slots)
