"""Held keys: the heading and the behaviour that they ask for; one rule for clients, scoring and training."""

from collections.abc import Collection

import numpy as np
from numpy.typing import ArrayLike, NDArray


def heading_of_keys(view_yaw: ArrayLike, forward: ArrayLike, strafe: ArrayLike) -> NDArray[np.float64]:
    """Wanted heading, radians: view yaw + atan2(-strafe, forward), the view yaw itself with no key held.

    Source: traces/PROVENANCE.md, "As steering commands". All arguments broadcast.

    Args:
        view_yaw: where the camera looks, radians.
        forward: -1 back, 0, 1 forward.
        strafe: -1 left, 0, 1 right.
    """
    # Adding 0.0 turns a negative zero into zero: atan2(-0.0, -0.0) is half a turn.
    right, ahead = np.asarray(strafe) + 0.0, np.asarray(forward) + 0.0
    return np.asarray(view_yaw, dtype=np.float64) + np.arctan2(0.0 - right, ahead)


def behaviour_of_keys(forward: float, strafe: float, run: bool, present: Collection[str]) -> str:
    """The behaviour that held keys ask for: stop with no direction, else run or walk; walk where no run is present.

    Source: traces/PROVENANCE.md, "As steering commands".
    """
    if forward == 0 and strafe == 0:
        return "stop"
    return "run" if run and "run" in present else "walk"
