"""The shape of a person to draw: each part of the body is the hull of a few balls that ride on joints."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.motion import quaternion
from footwork.motion.body import NAMES
from footwork.motion.skeleton import Skeleton

LEFT, RIGHT, TRUNK, SKIN = "left", "right", "trunk", "skin"
_STICK_RADIUS = 0.015
_ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Ball:
    """A ball at ``place`` in the frame of ``joint``; place and radius in metres."""

    joint: int
    radius: float
    place: tuple[float, float, float] = _ORIGIN


@dataclass(frozen=True)
class Part:
    """A part of the body: the hull of its balls, painted as ``paint``, ``lift`` metres nearer than it is."""

    balls: tuple[Ball, ...]
    paint: str
    lift: float = 0.0


def body_parts(skeleton: Skeleton) -> list[Part]:
    """The parts of a body: flesh on the common body, plain sticks on any other skeleton."""
    if skeleton.names != NAMES:
        return _sticks(skeleton)
    return _trunk(skeleton) + _side(skeleton, "left") + _side(skeleton, "right")


def ball_places(parts: list[Part], places: NDArray, turns: NDArray) -> NDArray[np.float64]:
    """World places of all balls of all parts, one after the other.  # (J, 3), (J, 4) -> (balls, 3)"""
    balls = [ball for part in parts for ball in part.balls]
    joints = [ball.joint for ball in balls]
    return places[joints] + quaternion.rotate(turns[joints], np.array([ball.place for ball in balls]))


def side_of(name: str) -> str:
    """Whether a joint's name says left, right or neither (the trunk), as CMU, ACCAD and the common body name them."""
    low = name.lower()
    if low.startswith("left") or (low[:1] == "l" and not low.startswith("lower")):
        return LEFT
    if low.startswith("right") or low[:1] == "r":
        return TRUNK if low.startswith("root") else RIGHT
    return TRUNK


def _sticks(skeleton: Skeleton) -> list[Part]:
    parts = []
    for joint, name in enumerate(skeleton.names):
        tip = Ball(joint, _STICK_RADIUS)
        if joint:
            parts.append(Part((Ball(int(skeleton.parents[joint]), _STICK_RADIUS), tip), side_of(name)))
        if skeleton.ends[joint].any():
            parts.append(Part((tip, Ball(joint, _STICK_RADIUS, tuple(skeleton.ends[joint]))), side_of(name)))
    return parts


def _trunk(skeleton: Skeleton) -> list[Part]:
    joint = skeleton.index
    height = float(skeleton.ends[joint("head"), 1]) or 0.2
    pelvis = (
        Ball(joint("left_thigh"), 0.078),
        Ball(joint("right_thigh"), 0.078),
        Ball(joint("spine"), 0.098, (0.03, 0.0, 0.0)),
        Ball(joint("spine"), 0.098, (-0.03, 0.0, 0.0)),
    )
    waist = (Ball(joint("hips"), 0.105), Ball(joint("chest"), 0.11))
    ribs = (
        Ball(joint("chest"), 0.105, (0.03, 0.0, 0.0)),
        Ball(joint("chest"), 0.105, (-0.03, 0.0, 0.0)),
        Ball(joint("left_upper_arm"), 0.05, (-0.03, 0.0, 0.0)),
        Ball(joint("right_upper_arm"), 0.05, (0.03, 0.0, 0.0)),
        Ball(joint("neck"), 0.045),
    )
    skull = (
        Ball(joint("head"), 0.088, (0.0, 0.58 * height, 0.0)),
        Ball(joint("head"), 0.058, (0.0, 0.16 * height, 0.035)),
    )
    nose = (
        Ball(joint("head"), 0.014, (0.0, 0.45 * height, 0.085)),
        Ball(joint("head"), 0.018, (0.0, 0.25 * height, 0.098)),
    )
    return [
        Part(waist, TRUNK),
        Part(pelvis, TRUNK),
        Part(ribs, TRUNK),
        Part((Ball(joint("neck"), 0.05), Ball(joint("head"), 0.048)), SKIN),
        Part(skull, SKIN, lift=0.02),
        Part(nose, SKIN),
    ]


def _side(skeleton: Skeleton, side: str) -> list[Part]:
    def joint(name: str) -> int:
        return skeleton.index(f"{side}_{name}")

    fingers = tuple(skeleton.ends[joint("hand")])
    toes = tuple(skeleton.ends[joint("toes")])
    ball_of_foot = skeleton.offsets[joint("toes")]
    heel = (float(ball_of_foot[0]), float(ball_of_foot[1]), -0.35 * abs(float(ball_of_foot[2])))
    foot = (
        Ball(joint("foot"), 0.036),
        Ball(joint("foot"), 0.026, heel),
        Ball(joint("toes"), 0.027),
    )
    return [
        Part((Ball(joint("thigh"), 0.082), Ball(joint("shank"), 0.054)), side),
        Part((Ball(joint("shank"), 0.053), Ball(joint("foot"), 0.034)), side),
        Part(foot, side),
        Part((Ball(joint("toes"), 0.026), Ball(joint("toes"), 0.017, toes)), side),
        Part((Ball(joint("upper_arm"), 0.055), Ball(joint("forearm"), 0.039)), side),
        Part((Ball(joint("forearm"), 0.038), Ball(joint("hand"), 0.027)), side),
        Part((Ball(joint("hand"), 0.03), Ball(joint("hand"), 0.02, fingers)), SKIN),
    ]
