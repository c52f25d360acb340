"""The whole figure: a footstep plan and a gesture become a clip on the common body."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion import ik, quaternion
from footwork.motion.clip import Clip
from footwork.motion.kinematics import forward, local_rotations
from footwork.motion.skeleton import Skeleton
from footwork.training.embedded.arms import hang_arms, reach_hands
from footwork.training.embedded.feet import Feet, feet_of
from footwork.training.embedded.flight import fly
from footwork.training.embedded.footsteps import FPS, Plan
from footwork.training.embedded.gesture import Gesture
from footwork.training.embedded.pelvis import pelvis_of
from footwork.training.embedded.trunk import trunk_turns

_SOFT_KNEE = 0.006  # just beyond the stretch that the pelvis allows, so that planted feet are met exactly


def animate(name: str, plan: Plan, body: Skeleton, gesture: Gesture | None = None) -> Clip:
    """The clip of a plan and a gesture: contacts are those of the plan."""
    gesture = gesture or Gesture()
    feet = feet_of(plan, body, (gesture.touches("left", plan.times), gesture.touches("right", plan.times)))
    pelvis = pelvis_of(plan, feet, body, gesture)
    trunk = trunk_turns(plan, pelvis, gesture)

    world = np.tile(quaternion.IDENTITY, (len(plan.times), body.joint_count, 1))
    for joint, turn in trunk.items():
        world[:, body.index(joint)] = turn
    rotations = np.tile(quaternion.IDENTITY, (len(plan.times), body.joint_count, 1))
    spine = body.indices(list(trunk))
    rotations[:, spine] = local_rotations(body, world)[:, spine]
    hang_arms(plan, pelvis, body, gesture, _pitch_of(trunk["chest"]), rotations)
    rotations = reach_hands(plan, body, gesture, pelvis.place, rotations)

    def standing_on_feet(root: NDArray[np.float64]) -> NDArray[np.float64]:
        return plant(body, root, rotations, feet, pelvis.yaw)

    root = fly(plan, body, pelvis.place, standing_on_feet)
    clip = Clip(
        name=name,
        skeleton=body,
        fps=FPS,
        root_position=root,
        rotations=quaternion.unroll(standing_on_feet(root)),
        contacts=plan.standing(),
        labels=plan.labels,
    )
    return clip.cut(plan.shown[0], min(plan.shown[1], clip.frame_count))


def plant(
    body: Skeleton,
    root: NDArray[np.float64],
    rotations: NDArray[np.float64],
    feet: Feet,
    pelvis_yaw: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Local rotations with both legs reaching their ankles and the feet turned as planned.  # (F, J, 4)"""
    planted = np.array(rotations)
    for index, side in enumerate(("left", "right")):
        limb = ik.leg(body, side)
        places, turns = forward(body, root, planted)
        along = feet.ankles[:, index] - places[:, limb.upper]
        knees = quaternion.slerp(
            quaternion.from_yaw(pelvis_yaw), _yaw_only(feet.turns[:, index]), np.full(len(root), 0.6)
        )
        # the pole is kept square to the limb through the axis of the knee, which a raised leg does not upset
        pole = np.cross(along, quaternion.rotate(knees, np.array([1.0, 0.0, 0.0])))
        turns[:, limb.upper], turns[:, limb.lower] = ik.reach(
            places, turns, limb, feet.ankles[:, index], pole, softness=_SOFT_KNEE
        )
        turns[:, limb.tip] = feet.turns[:, index]
        joints = list(limb[:3])
        planted[:, joints] = local_rotations(body, turns)[:, joints]
        planted[:, body.feet[index, 1]] = feet.toes[:, index]
    return planted


def _pitch_of(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far the chests (F, 4) lean forward, radians."""
    up = quaternion.rotate(turns, np.array([0.0, 1.0, 0.0]))
    ahead = quaternion.rotate(turns, np.array([0.0, 0.0, 1.0]))
    return np.arctan2(-ahead[:, 1], np.maximum(up[:, 1], 0.0))


def _yaw_only(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    across = quaternion.rotate(turns, np.array([1.0, 0.0, 0.0]))
    return quaternion.from_yaw(np.arctan2(-across[:, 2], across[:, 0]))
