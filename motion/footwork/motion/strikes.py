"""Strikes: at which frames of attacks a limb reaches its target, which limb, and how fast it came."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_range, require_shape
from footwork.motion.fighting_points import LIMBS
from footwork.motion.graph import MotionGraph


@dataclass(frozen=True, eq=False)
class Strikes:
    """S strikes of a graph, by rising node.

    Args:
        node: the frame of first contact.  # (S,)
        limb: which of LIMBS strikes.  # (S,)
        speed: the greatest speed of that limb on its way there, m/s.  # (S,)

    Raises:
        InputError: for arrays that do not fit together, nodes that do not rise, and limbs that are none.
    """

    node: NDArray[np.int32]
    limb: NDArray[np.int16]
    speed: NDArray[np.float32]
    where: str = "strikes"

    def __post_init__(self) -> None:
        for name, kind in (("node", np.int32), ("limb", np.int16), ("speed", np.float32)):
            object.__setattr__(self, name, frozen(getattr(self, name), kind))
            require_shape(getattr(self, name), (len(self.node),), name, self.where)
        if (np.diff(self.node) <= 0).any() or (self.node < 0).any():
            raise InputError("nodes that do not rise, expected each strike at a frame of its own", self.where)
        require_range(self.limb, 0, len(LIMBS), "limb", self.where)
        require_finite(self.speed, "speed", self.where)
        if (self.speed < 0.0).any():
            raise InputError(f"speed holds {self.speed.min():g}, expected 0 or more", self.where)

    def __len__(self) -> int:
        return len(self.node)

    def require_fits(self, graph: MotionGraph) -> None:
        """Raise InputError unless all nodes are in ``graph``."""
        require_range(self.node, 0, graph.node_count, "node", self.where)

    def rows(self, graph: MotionGraph) -> list[dict[str, str | int | float]]:
        """JSON-able: clip, frame, limb and speed of each."""
        return [
            {
                "clip": graph.clips[graph.clip[node]],
                "frame": int(graph.frame[node]),
                "limb": LIMBS[limb],
                "speed": round(float(speed), 2),
            }
            for node, limb, speed in zip(self.node, self.limb, self.speed, strict=True)
        ]
