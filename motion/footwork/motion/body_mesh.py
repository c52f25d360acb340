"""A body to look at: a capsule for every bone, as thick as its mass asks for, of triangles."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.body import BALL_HEIGHT
from footwork.motion.skeleton import Skeleton

_AROUND, _RINGS = 14, 4  # corners of a circle, circles of half a ball
_DENSITY = 1000.0  # kg/m^3, about that of a person
_SLENDER = 0.35  # radius by length of a bone whose mass is unknown
_THINNEST, _THICKEST, _ANKLE = 0.02, 0.25, 0.045  # metres
_WITHIN = 0.98  # balls about one joint lie within one another: surfaces that coincide flicker
_RIGHT_SHADE = 0.55
_UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True, eq=False)
class BodyMesh:
    """Triangles of a body at rest.

    Args:
        points: corners, metres, in the frame of the joint that moves them.  # (V, 3)
        normals: directions out of the body, there.  # (V, 3)
        joint: which joint moves a corner.  # (V,)
        shade: brightness of a corner: right limbs are darker.  # (V,)
        triangles: corners, counterclockwise from outside.  # (T, 3)
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    joint: NDArray[np.intp]
    shade: NDArray[np.float64]
    triangles: NDArray[np.intp]


def body_mesh(skeleton: Skeleton) -> BodyMesh:
    """A capsule from each joint to each of its children, and to the tip of its segment."""
    bones = list(_bones(skeleton))
    capsules = [_capsule(*bone[1:]) for bone in bones]
    corners = len(capsules[0][0])
    joint = np.repeat([bone[0] for bone in bones], corners)
    dark = np.array(["right" in name.lower() for name in skeleton.names])
    return BodyMesh(
        points=np.concatenate([points for points, _ in capsules]),
        normals=np.concatenate([normals for _, normals in capsules]),
        joint=joint,
        shade=np.where(dark, _RIGHT_SHADE, 1.0)[joint],
        triangles=(_triangles() + corners * np.arange(len(bones))[:, None, None]).reshape(-1, 3),
    )


def _bones(skeleton: Skeleton) -> Iterator[tuple[int, NDArray[np.float64], float, float]]:
    """(joint, tip in its frame, radius at the joint, radius at the tip), at least one; bones taper to the next one."""
    radii = _radii(skeleton)
    for joint in range(skeleton.joint_count):
        for number, child in enumerate(skeleton.children(joint)):
            near, far = radii[joint] * _WITHIN**number, min(radii[joint], radii[child]) * _WITHIN
            yield joint, skeleton.offsets[child], near, far
        if skeleton.ends[joint].any() or skeleton.joint_count == 1:
            yield joint, skeleton.ends[joint], radii[joint], radii[joint]


def _radii(skeleton: Skeleton) -> NDArray[np.float64]:
    """Radius at each joint: of a capsule of its mass, as long as its longest bone; soles touch the floor.  # (J,)"""
    lengths = np.linalg.norm(skeleton.ends, axis=1)
    np.maximum.at(lengths, skeleton.parents[1:], np.linalg.norm(skeleton.offsets[1:], axis=1))
    radii = np.where(skeleton.masses > 0.0, _capsule_radii(skeleton.masses / _DENSITY, lengths), _SLENDER * lengths)
    radii = np.clip(radii, _THINNEST, _THICKEST)
    radii[skeleton.feet[:, 0]] = np.minimum(radii[skeleton.feet[:, 0]], _ANKLE)
    radii[skeleton.feet[:, 1]] = BALL_HEIGHT
    return radii


def _capsule_radii(volumes: NDArray[np.float64], lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """r of 4/3 pi r^3 + pi r^2 length = volume, by Newton's method from above.  # (J,)"""
    radii = np.maximum(np.cbrt(volumes), _THINNEST)
    for _ in range(12):
        excess = np.pi * radii**2 * (4.0 / 3.0 * radii + lengths) - volumes
        radii -= excess / (2.0 * np.pi * radii * (2.0 * radii + lengths))
    return radii


def _capsule(tip: NDArray[np.float64], near: float, far: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Corners and normals of a capsule from 0 to ``tip``: two half balls, circle by circle.  # (V, 3) each"""
    down = np.linspace(-np.pi / 2, 0.0, _RINGS + 1)
    rise = np.concatenate([down, -down[::-1]])  # (2 _RINGS + 2,)
    around = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
    flat = np.stack([np.cos(around), np.zeros(_AROUND), np.sin(around)], axis=-1)
    out = np.cos(rise)[:, None, None] * flat + np.sin(rise)[:, None, None] * _UP  # (circles, _AROUND, 3)
    radius = np.repeat([near, far], _RINGS + 1)[:, None, None]
    length = float(np.linalg.norm(tip))
    along = np.repeat([0.0, length], _RINGS + 1)[:, None, None] * _UP
    turn = quaternion.between(_UP, tip) if length > 0.0 else quaternion.IDENTITY
    points, normals = (quaternion.rotate(turn, part.reshape(-1, 3)) for part in (along + radius * out, out))
    return points, quaternion.normalise(normals)


def _triangles() -> NDArray[np.intp]:
    """Triangles between neighbouring circles of a capsule.  # (T, 3)"""
    here = np.arange(_AROUND)
    on = (here + 1) % _AROUND
    low = _AROUND * np.arange(2 * _RINGS + 1)[:, None]
    a, b, c, d = low + here, low + on, low + _AROUND + here, low + _AROUND + on
    return np.stack([np.stack([a, c, b], axis=-1), np.stack([b, c, d], axis=-1)], axis=2).reshape(-1, 3)
