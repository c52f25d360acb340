"""Ticks of characters whose moves any controller chooses."""

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.command import Command
from footwork.controllers.controller import Controller, Situations
from footwork.controllers.orders import Orders, ask
from footwork.motion.moves import no_moves
from footwork.runtime.schedule import Schedule
from footwork.runtime.world import World


class ChosenTicks:
    """Makes the ticks of a world: orders -> controller -> world.

    Args:
        controller: what chooses.
        world: where the characters are.
        orders: what they are asked for.
    """

    def __init__(self, controller: Controller, world: World, orders: Orders) -> None:
        self._controller, self._world, self._orders = controller, world, orders
        self._moves, self._chosen = no_moves(world.capacity), no_moves(world.capacity)

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
        due = schedule.tick == tick
        rows = zip(*(array[due].tolist() for array in schedule), strict=True)
        for _, slot, heading, behaviour, one_shot, speed in rows:
            shown = int(self._world.graph.behaviour[self._world.node[slot]])
            self._orders.give(slot, Command(heading, behaviour, one_shot, speed), shown)

    def _step(self, slots: NDArray[np.intp]) -> None:
        world, orders = self._world, self._orders
        node = world.node[slots]
        ask(slots, world.graph.behaviour[node], orders.in_force)
        chosen = self._chosen.first(len(slots))
        asked, speed = orders.in_force.asked[slots], orders.in_force.asked_speed[slots]
        situations = Situations(slots, node, world.place[slots], orders.heading[slots], asked, speed)
        self._controller.choose(situations, chosen)
        self._moves.put(slots, chosen)
        world.step(self._moves, slots)
