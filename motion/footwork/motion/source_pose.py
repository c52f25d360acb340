"""A capture's motion seen as the common body: where its joints are and how its segments are turned.

Nothing is scaled or moved to a floor here: lengths are the captured person's own.
"""

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion import quaternion
from footwork.motion.body import NAMES
from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.motion.name_table import END, JointRule, NameTable, frame_of

_LEG_BONES = [
    (f"{side}_{bone}", f"{side}_{tip}")
    for side in ("left", "right")
    for bone, tip in (("thigh", "shank"), ("shank", "foot"))
]
_SHORTEST = 1e-6  # of the capture's unit
_FLAT = 1e-3  # sine of the least angle between a foot's bone and its upward axis


def source_pose(clip: Clip, table: NameTable) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """World places (F, J, 3) in the capture's unit and world rotations (F, J, 4) of the common body's joints.

    The world is turned to +y up and +z forward. Rotations are those of segments whose rest is the common body's T
    pose, as far as the table knows: the bones' directions need not agree with the places to the last degree.

    Raises:
        InputError: where the clip's skeleton lacks a joint that the table names, a foot has no direction, or a bone
            of a leg has no length in some frame.
    """
    places, turns = clip_places(clip)
    joints = {name: clip.skeleton.index(name) for name in _needed(table)}
    ends = {name: clip.skeleton.ends[joint] for name, joint in joints.items()}

    def place_of(name: str) -> NDArray[np.float64]:
        joint = joints[name.removesuffix(END)]
        if name.endswith(END):
            return places[:, joint] + quaternion.rotate(turns[:, joint], ends[name.removesuffix(END)])
        return places[:, joint]

    points = np.stack([_mean([place_of(name) for name in table.joints[joint].place]) for joint in NAMES], axis=1)
    captured = turns[:, [joints[table.joints[joint].turn] for joint in NAMES]]
    frames = np.stack([_rest_frame(joint, points, captured, table) for joint in NAMES])
    _require_legs(points, clip.name)
    return (
        quaternion.rotate(table.world, points),
        quaternion.multiply(table.world, quaternion.multiply(captured, frames)),
    )


def _require_legs(points: NDArray[np.float64], where: str) -> None:
    """Raise InputError, naming bone and frame, where a thigh or a shank has no length, and so no direction."""
    for bone, tip in _LEG_BONES:
        lengths = np.linalg.norm(points[:, NAMES.index(tip)] - points[:, NAMES.index(bone)], axis=-1)
        frame = int(lengths.argmin())
        if not lengths[frame] > _SHORTEST:
            problem = f"the legs have no length ({bone} in frame {frame})"
            raise InputError(f"{problem}, expected thighs, shanks and feet at places of their own", where)


def _needed(table: NameTable) -> set[str]:
    places = {place.removesuffix(END) for rule in table.joints.values() for place in rule.place}
    return places | {rule.turn for rule in table.joints.values()}


def _mean(values: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    return values[0] if len(values) == 1 else np.mean(values, axis=0)


def _rest_frame(
    joint: str, points: NDArray[np.float64], captured: NDArray[np.float64], table: NameTable
) -> NDArray[np.float64]:
    """The rotation from the common body's rest axes to the source joint's own axes, xyzw.  # (4,)"""
    rule = table.joints[joint]
    if joint.endswith("_foot") and len(rule.axes) < 2:
        return _foot_frame(joint, rule, points, captured, table)
    if rule.axes:
        return rule.frame
    return quaternion.conjugate(table.world)  # at rest the source's joints are turned like its world


def _foot_frame(
    joint: str, rule: JointRule, points: NDArray[np.float64], captured: NDArray[np.float64], table: NameTable
) -> NDArray[np.float64]:
    """A foot's frame from its upward axis: its toes point forward, so that a flat foot stays flat."""
    foot, toes = NAMES.index(joint), NAMES.index(joint.replace("_foot", "_toes"))
    bone = quaternion.rotate(quaternion.conjugate(captured[:, foot]), points[:, toes] - points[:, foot])
    up = rule.axes.get("up")
    level = quaternion.rotate(quaternion.conjugate(table.world), [0.0, 1.0, 0.0]) if up is None else np.array(up)
    forward = bone.mean(axis=0)
    if not np.linalg.norm(np.cross(level, forward)) > _FLAT * np.linalg.norm(forward):
        raise InputError(
            f"{joint} and its toes lie straight above each other, expected a foot that points", table.where
        )
    return frame_of({"up": level, "forward": forward})
