"""The arms: hanging and swinging against the legs, or reaching with a hand where a gesture wants it."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion import ik, quaternion
from footwork.motion.kinematics import forward
from footwork.motion.skeleton import Skeleton
from footwork.training.embedded.curves import smoothed
from footwork.training.embedded.footsteps import FPS, Plan
from footwork.training.embedded.gesture import Gesture
from footwork.training.embedded.pelvis import Pelvis

_X, _Y, _Z = np.eye(3)
_PARTS = ("left", "up", "ahead")


def hang_arms(
    plan: Plan,
    pelvis: Pelvis,
    body: Skeleton,
    gesture: Gesture,
    lean: NDArray[np.float64],
    rotations: NDArray[np.float64],
) -> None:
    """Write the local rotations of both arms into ``rotations`` (F, J, 4); ``lean`` (F,) is the chest's pitch."""
    times, run = plan.times, plan.run
    for sign, side in ((1.0, "left"), (-1.0, "right")):
        swing = -sign * smoothed(pelvis.split, 0.15, FPS)
        flex = 0.03 - 0.12 * run + (0.42 + 0.33 * run) * swing + lean * (1.0 - 0.5 * run)
        flex = flex + gesture.at(f"{side}_arm", times)
        spread = 0.13 + 0.10 * run + gesture.at(f"{side}_spread", times)
        elbow = 0.28 + 1.25 * run + (0.22 + 0.15 * run) * swing + gesture.at(f"{side}_elbow", times)
        inward = sign * (0.15 + 0.15 * run)
        upper, forearm, hand = body.indices([f"{side}_upper_arm", f"{side}_forearm", f"{side}_hand"])
        hang = _about(_Z, -sign * (0.5 * np.pi - spread))
        rotations[:, upper] = quaternion.multiply(quaternion.multiply(_about(_X, -flex), _about(_Y, -inward)), hang)
        rotations[:, forearm] = _about(_Y, -sign * np.clip(elbow, 0.05, 2.5))
        rotations[:, hand] = _about(_Z, np.full_like(flex, -sign * 0.08))


def _about(axis: NDArray[np.float64], angle: NDArray[np.float64]) -> NDArray[np.float64]:
    return quaternion.from_rotation_vector(np.asarray(angle)[:, None] * axis)


def reach_hands(
    plan: Plan, body: Skeleton, gesture: Gesture, root: NDArray[np.float64], rotations: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Local rotations with the hands at the gesture's targets, as far as it lets them count.  # (F, J, 4)"""
    for sign, side in ((1.0, "left"), (-1.0, "right")):
        share = gesture.at(f"{side}_hand", plan.times)
        if not share.any():
            continue
        limb = ik.arm(body, side)
        places, turns = forward(body, root, rotations)
        chest = body.index("chest")
        frame = quaternion.slerp(
            quaternion.from_yaw(plan.heading), turns[:, chest], gesture.at(f"{side}_hand_chest", plan.times)
        )
        target = places[:, chest] + quaternion.rotate(frame, gesture.vector(f"{side}_hand_", _PARTS, plan.times))
        pole = quaternion.rotate(turns[:, chest], np.array([0.55 * sign, -1.0, -0.25]))
        reached = ik.place_limb(body, root, rotations, limb, target, pole, softness=0.03)
        joints = [limb.upper, limb.lower]
        rotations = rotations.copy()
        rotations[:, joints] = quaternion.slerp(rotations[:, joints], reached[:, joints], share[:, None])
    return rotations
