"""Trunk and head: the chest turns against the pelvis, leans with the gait, and the head looks where the body goes."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.training.embedded.curves import smoothed
from footwork.training.embedded.footsteps import FPS, Plan
from footwork.training.embedded.gesture import Gesture
from footwork.training.embedded.pelvis import Pelvis, turned

_COUNTER_YAW = 0.12  # radians of chest rotation, against the pelvis, per metre between the feet
_LOOK_AHEAD = 9  # frames by which the head leads the body into a turn
_LOOK_LIMIT = 0.7  # radians


def trunk_turns(plan: Plan, pelvis: Pelvis, gesture: Gesture) -> dict[str, NDArray[np.float64]]:
    """World rotations (F, 4) of hips, spine, chest, neck and head, by joint name."""
    times = plan.times
    yaw = plan.heading + _COUNTER_YAW * (1.0 + plan.run) * pelvis.split + gesture.at("chest_yaw", times)
    lean = 0.02 + 0.02 * np.clip(plan.speed[:, 0], -0.5, 1.5) + 0.10 * plan.run + gesture.at("lean", times)
    breath = 0.008 * np.sin(2.0 * np.pi * times / 3.4)
    chest = turned(yaw, lean + breath, pelvis.bank - 0.3 * pelvis.list_ - gesture.at("tilt", times))
    head = _head(plan, gesture)
    return {
        "hips": pelvis.turn,
        "spine": quaternion.slerp(pelvis.turn, chest, np.full(len(times), 0.5)),
        "chest": chest,
        "neck": quaternion.slerp(chest, head, np.full(len(times), 0.5)),
        "head": head,
    }


def _head(plan: Plan, gesture: Gesture) -> NDArray[np.float64]:
    heading = plan.heading
    coming = np.concatenate([heading[_LOOK_AHEAD:], np.full(min(_LOOK_AHEAD, len(heading)), heading[-1])])
    lead = smoothed(_LOOK_LIMIT * np.tanh((coming[: len(heading)] - heading) / _LOOK_LIMIT), 0.3, FPS)
    yaw = heading + lead + gesture.at("look", plan.times)
    return turned(yaw, 0.03 + 0.03 * plan.run + gesture.at("nod", plan.times), np.zeros(len(heading)))
