"""What can be scored: controllers, and what must know beforehand what will be asked of it."""

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.controller import Controller
from footwork.motion.graph import MotionGraph


@runtime_checkable
class Foreseeing(Protocol):
    """What controls a character only where it is told beforehand what will be asked of it."""

    @property
    def graph(self) -> MotionGraph:
        """What its characters move on."""
        ...

    @property
    def present(self) -> tuple[str, ...]:
        """The behaviours that some frame shows."""
        ...

    def knowing(self, heading: NDArray[np.float64], behaviour: NDArray[np.int32]) -> Controller:
        """The controller of one character that is asked for this, tick by tick.

        Args:
            heading: wanted yaw in the world, radians.  # (K,)
            behaviour: index into the graph's behaviours, ``asked.UNANSWERABLE`` for one that no frame shows.  # (K,)
        """
        ...


Contender = Controller | Foreseeing
