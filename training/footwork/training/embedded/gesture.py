"""What a clip does besides stepping: keyed curves of time for crouching, leaning, twisting, hands and single feet."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from footwork.training.embedded.curves import Keys, keyed, smoothed
from footwork.training.embedded.feet import FootTouches
from footwork.training.embedded.footsteps import FPS

_BLUR = 0.12  # keys are rounded off over this time, seconds


@dataclass(frozen=True, eq=False)
class Gesture:
    """Named curves, each zero where it is not keyed.

    ``curves`` may hold: ``drop``, ``back`` and ``side`` (of the pelvis down, back and to the left, metres),
    ``pelvis_yaw``, ``pelvis_pitch``, ``chest_yaw``, ``lean`` (chest forward), ``tilt`` (chest to the left), ``nod``
    (head down), ``look`` (head to the left), radians; for each side ``left_`` and ``right_``: ``swivel``, ``toe``
    (foot's yaw and pitch), ``foot_left``, ``foot_up``, ``foot_ahead`` (metres), ``arm`` (flexion), ``spread``
    (abduction) and ``elbow`` (radians), ``hand`` (share 0..1 that the hand's targets count), ``hand_left``,
    ``hand_up``, ``hand_ahead`` (its target from the chest's joint in the heading's directions, metres) and
    ``hand_chest`` (share by which those directions turn with the chest).
    """

    curves: Mapping[str, Keys] = field(default_factory=dict)

    def at(self, name: str, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """The curve ``name`` at ``times`` (F,)."""
        if name not in self.curves:
            return np.zeros_like(times)
        return smoothed(keyed(self.curves[name], times), _BLUR, FPS)

    def vector(self, prefix: str, parts: tuple[str, str, str], times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Three curves side by side.  # (F, 3)"""
        return np.stack([self.at(prefix + part, times) for part in parts], axis=-1)

    def touches(self, side: str, times: NDArray[np.float64]) -> FootTouches:
        """What it adds to the foot on ``side``, left or right."""
        return FootTouches(
            swivel=self.at(f"{side}_swivel", times),
            pitch=self.at(f"{side}_toe", times),
            offset=self.vector(f"{side}_foot_", ("left", "up", "ahead"), times),
        )
