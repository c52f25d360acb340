"""The common body: twenty-one joints onto which all capture is mapped, so that clips of many people share a graph.

At rest (identity rotations) it stands in a T pose: +y up, +z forward, so +x is its left.
"""

import numpy as np

from footwork.motion.masses import segment_masses
from footwork.motion.skeleton import Skeleton

# The ball of a standing foot, a joint inside it, lies this far above the floor y = 0 (convention).
BALL_HEIGHT = 0.02  # metres
DEFAULT_MASS = 75.0  # kilograms

# name, parent, offset from the parent in metres of a person 1.76 m tall, end site
_TRUNK = [
    ("hips", "", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    ("spine", "hips", (0.0, 0.10, 0.0), (0.0, 0.0, 0.0)),
    ("chest", "spine", (0.0, 0.15, 0.0), (0.0, 0.0, 0.0)),
    ("neck", "chest", (0.0, 0.25, 0.0), (0.0, 0.0, 0.0)),
    ("head", "neck", (0.0, 0.09, 0.01), (0.0, 0.20, 0.0)),
]
_LEFT = [
    ("left_clavicle", "chest", (0.03, 0.19, 0.0), (0.0, 0.0, 0.0)),
    ("left_upper_arm", "left_clavicle", (0.15, 0.01, 0.0), (0.0, 0.0, 0.0)),
    ("left_forearm", "left_upper_arm", (0.29, 0.0, 0.0), (0.0, 0.0, 0.0)),
    ("left_hand", "left_forearm", (0.25, 0.0, 0.0), (0.18, 0.0, 0.0)),
    ("left_thigh", "hips", (0.09, -0.05, 0.0), (0.0, 0.0, 0.0)),
    ("left_shank", "left_thigh", (0.0, -0.42, 0.0), (0.0, 0.0, 0.0)),
    ("left_foot", "left_shank", (0.0, -0.41, 0.0), (0.0, 0.0, 0.0)),
    ("left_toes", "left_foot", (0.0, -0.06, 0.14), (0.0, 0.0, 0.07)),
]


def _mirrored(joint: tuple[str, str, tuple[float, float, float], tuple[float, float, float]]):
    name, parent, (x, y, z), (end_x, end_y, end_z) = joint
    right = str.replace
    return right(name, "left", "right"), right(parent, "left", "right"), (-x, y, z), (-end_x, end_y, end_z)


_JOINTS = _TRUNK + _LEFT + [_mirrored(joint) for joint in _LEFT]
NAMES = tuple(joint[0] for joint in _JOINTS)
PARENTS = np.array([NAMES.index(joint[1]) if joint[1] else -1 for joint in _JOINTS])
FEET = np.array([[NAMES.index(f"{side}_foot"), NAMES.index(f"{side}_toes")] for side in ("left", "right")])


def default_body() -> Skeleton:
    """The common body with the lengths of a person 1.76 m tall and 75 kg."""
    return Skeleton(
        names=NAMES,
        parents=PARENTS,
        offsets=np.array([joint[2] for joint in _JOINTS]),
        ends=np.array([joint[3] for joint in _JOINTS]),
        masses=segment_masses(NAMES, DEFAULT_MASS),
        feet=FEET,
        where="common body",
    )


def rest_height(body: Skeleton) -> float:
    """Height in metres of the hips above the floor while the common body stands in its T pose."""
    drop = sum(body.offsets[body.index(f"left_{part}"), 1] for part in ("thigh", "shank", "foot", "toes"))
    return BALL_HEIGHT - float(drop)
