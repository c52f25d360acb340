"""Ticks of characters whose moves any controller chooses."""

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller, Situations
from footwork.controllers.orders import Orders, ask
from footwork.motion.moves import no_moves
from footwork.runtime.single_ticks import SingleTicks
from footwork.runtime.world import World


class ChosenTicks(SingleTicks):
    """Makes the ticks of a world: orders -> controller -> world.

    Args:
        controller: what chooses.
        world: where the characters are.
        orders: what they are asked for.
    """

    def __init__(self, controller: Controller, world: World, orders: Orders) -> None:
        super().__init__(world, orders)
        self._controller = controller
        self._moves, self._chosen = no_moves(world.capacity), no_moves(world.capacity)

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
