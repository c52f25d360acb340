"""What is shown of all characters at one moment."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class PoseFrames(NamedTuple):
    """What is shown of every slot at one moment; rows of slots that hold no character mean nothing.

    The arrays are the simulation's own, the same at every step and show, which write over what they hold.

    Args:
        root: place of joint 0 in the world, metres.  # (capacity, 3) float32
        rotations: local rotations xyzw, joint 0 in the world.  # (capacity, J, 4) float32
        facing: yaw at the tick's moment, radians.  # (capacity,)
        behaviour: index into ``Simulation.behaviours``, -1 for none of them.  # (capacity,)
        clip: the source clip of the greater weight, an index into the graph's clips.  # (capacity,)
        source_frame: frame of that clip at 30 Hz.  # (capacity,)
        transition: whether the last move left the captured order.  # (capacity,) bool
        health: of fighters, 1 at the beginning of a round; None where nobody fights.  # (capacity,)
        stamina: of fighters, 1 when rested; None where nobody fights.  # (capacity,)
    """

    root: NDArray[np.float32]
    rotations: NDArray[np.float32]
    facing: NDArray[np.float64]
    behaviour: NDArray[np.int32]
    clip: NDArray[np.int32]
    source_frame: NDArray[np.int32]
    transition: NDArray[np.bool_]
    health: NDArray[np.float64] | None = None
    stamina: NDArray[np.float64] | None = None
