"""Ticks that are made one by one, as Python says how."""

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import Command
from footwork.controllers.orders import Orders
from footwork.runtime.schedule import Schedule, commands_in
from footwork.runtime.world import World


class SingleTicks(ABC):
    """Makes the ticks of a world: commands come into force, characters are taken on, and are shown.

    Args:
        world: where the characters are.
        orders: what they are asked for.
    """

    def __init__(self, world: World, orders: Orders) -> None:
        self._world, self._orders = world, orders

    def make(self, slots: NDArray[np.intp], schedule: Schedule, poses: NDArray[np.float32]) -> None:
        """Take characters through T ticks and write their poses at F moments of each.

        Args:
            slots: which, in rising order.  # (n,)
            schedule: commands to them.
            poses: written: place of joint 0, then local rotations joint by joint.  # (T, F, n, 3 + 4 J) float32
        """
        frames = poses.shape[1]
        for tick, shown in enumerate(poses):
            self._give(schedule, tick)
            self._step(slots)
            for frame in range(frames):
                root, rotations = self._world.show((frame + 1) / frames)
                shown[frame, :, :3] = root[slots]
                shown[frame, :, 3:] = rotations[slots].reshape(len(slots), rotations.shape[1] * 4)

    def _give(self, schedule: Schedule, tick: int) -> None:
        due = schedule[schedule[:, 0] == tick]
        for _, slot, heading, behaviour, one_shot, speed in commands_in(due):
            shown = int(self._world.graph.behaviour[self._world.node[slot]])
            self._orders.give(slot, Command(heading, behaviour, one_shot, speed), shown)

    @abstractmethod
    def _step(self, slots: NDArray[np.intp]) -> None:
        """Take characters through a tick."""
