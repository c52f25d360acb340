"""Which way the ticks of a world are made."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller
from footwork.controllers.orders import Orders
from footwork.controllers.steering import SteeringController
from footwork.runtime.chosen_ticks import ChosenTicks
from footwork.runtime.duel_ticks import DuelTicks
from footwork.runtime.duels import DuelSteering
from footwork.runtime.schedule import Schedule
from footwork.runtime.steered_ticks import SteeredTicks
from footwork.runtime.world import World


class Ticks(Protocol):
    """Takes characters through ticks."""

    def make(self, slots: NDArray[np.intp], schedule: Schedule, poses: NDArray[np.float32]) -> None:
        """Take those of some slots, in rising order, through T ticks and write their poses at F moments of each.

        ``poses`` are the place of joint 0, then the local rotations joint by joint.  # (T, F, n, 3 + 4 J)
        """
        ...


def ticks_of(controller: Controller, world: World, orders: Orders) -> Ticks:
    """The fastest way that a controller allows; one that does more than steer is asked at every tick."""
    if isinstance(controller, DuelSteering):
        return DuelTicks(controller, world, orders)
    if type(controller) is SteeringController:
        return SteeredTicks(controller, world, orders)
    return ChosenTicks(controller, world, orders)
