"""Weights of points that depend on which feet stand at either frame of a pair (conventions.md 8).

After Matsunaga and Zordan (2007): a body's weight is w_mass, the mass that moves when it moves (its own and all
outward of it), and for each of the two frames w_friction = 1 - (its mass and all outward in its limb) where it
supports the character, which the touching bodies do and those inward of them in the same limb.

Their choices kept: masses are shares of the whole body's, so that thresholds do not depend on kilograms, and two
standing feet count in full each. Ours (convention): what touches is a foot, for contacts are known of feet alone; a
segment that has mass is a body, and its inner joint stands for it, save that a foot is halved between its two points,
ankle and ball, so that a foot that turns about either has moved; joints without mass of their own are no bodies; a leg
ends inward before the first joint at which the tree forks.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_shape
from footwork.motion.masses import outward_sums
from footwork.motion.skeleton import Skeleton


@dataclass(frozen=True, eq=False)
class PairWeights:
    """Weights w of the P points of a frame pair: mass + friction of what stands at i + friction of what stands at j.

    Args:
        mass: part that is the same for all pairs, sum 1.  # (P,)
        friction: what each foot adds for each frame of the pair at which it stands.  # (feet, P)

    Raises:
        InputError: for weights that are negative, not finite or do not fit, or mass parts that do not sum to 1.
    """

    mass: NDArray[np.float64]
    friction: NDArray[np.float64]

    def __post_init__(self) -> None:
        for name in ("mass", "friction"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64))
            require_finite(getattr(self, name), name, "pair weights")
            if (getattr(self, name) < 0.0).any():
                raise InputError(f"{name} holds a negative number, expected zero or more", "pair weights")
        require_shape(self.friction, (None, len(self.mass)), "friction", "pair weights")
        if not abs(self.mass.sum() - 1.0) < 1e-9:
            raise InputError(f"mass sums to {self.mass.sum():g}, expected 1", "pair weights")

    def frictions(self, contacts: ArrayLike) -> NDArray[np.float64]:
        """The friction part of frames at which these feet stand.  # (..., feet) -> (..., P)"""
        return np.asarray(contacts, dtype=np.float64) @ self.friction

    def of_pairs(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """The weights of pairs of frames at which these feet stand.  # (..., feet) each -> (..., P)"""
        return self.mass + self.frictions(first) + self.frictions(second)


def dynamics_weights(skeleton: Skeleton) -> PairWeights:
    """The weights of Matsunaga and Zordan for the joints of a skeleton, divided by the sum of w_mass.

    So the dynamics metric is on the scale of the others, and its penalty for what slides is kept. A sum of a pair's
    own weights would cancel it: it runs from 1 where nothing touches to about 5 where both feet stand at both frames.

    Raises:
        InputError: for a skeleton without masses.
    """
    mass, friction = body_weights(skeleton)
    total = mass.sum()
    return PairWeights(_on_points(skeleton, mass) / total, _on_points(skeleton, friction) / total)


def body_weights(skeleton: Skeleton) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """w_mass (J,) of each segment, and w_friction (feet, J) while each foot stands; 0 for those without mass.

    Raises:
        InputError: for a skeleton without masses.
    """
    total = skeleton.masses.sum()
    if not total > 0.0:
        raise InputError("its joints have no masses, expected those of its segments for this metric", skeleton.where)
    body = skeleton.masses > 0.0
    outward = outward_sums(skeleton.parents, skeleton.masses / total)
    friction = np.zeros((len(skeleton.feet), skeleton.joint_count))
    for foot, (ankle, _) in enumerate(skeleton.feet):
        supporting = [joint for joint in limb_inward(skeleton, int(ankle)) if body[joint]]
        friction[foot, supporting] = 1.0 - outward[supporting]
    return np.where(body, outward, 0.0), friction


def limb_inward(skeleton: Skeleton, joint: int) -> list[int]:
    """A joint and those inward of it in its limb: up to the first at which the tree forks, which is of the trunk."""
    limb = [joint]
    while (joint := int(skeleton.parents[joint])) > 0 and len(skeleton.children(joint)) == 1:
        limb.append(joint)
    return limb


def _on_points(skeleton: Skeleton, weights: NDArray) -> NDArray[np.float64]:
    """Weights of bodies as weights of joints: each foot's halved between ankle and ball.  # (..., J)"""
    spread = weights.copy()
    for ankle, ball in skeleton.feet:
        half = weights[..., ankle] / 2.0
        spread[..., ankle] -= half
        spread[..., ball] += half
    return spread
