"""Points that stand for a pose in the metric, and how much each counts."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.errors import InputError
from footwork.motion.arrays import frozen, require_finite, require_shape
from footwork.motion.skeleton import Skeleton

# Where the points of a segment lie, from its inner joint to its outer one (convention).
ALONG = (0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True, eq=False)
class PointCloud:
    """P points, each on a line between joints, with fixed weights.

    Args:
        shares: share of each joint in each point, 1 in all for each point.  # (P, J)
        weights: of the points, sum 1.  # (P,)

    Raises:
        InputError: for shapes that do not fit and weights that are negative, not finite or all zero; a positive sum
            is scaled to 1.
    """

    shares: NDArray[np.float64]
    weights: NDArray[np.float64]

    def __post_init__(self) -> None:
        weights = np.asarray(self.weights, dtype=np.float64)
        require_finite(weights, "weights", "point cloud")
        if (weights < 0.0).any() or not weights.sum() > 0.0:
            raise InputError("weights must be zero or more, not all zero", "point cloud")
        object.__setattr__(self, "weights", frozen(weights / weights.sum(), np.float64))
        object.__setattr__(self, "shares", frozen(self.shares, np.float64))
        require_shape(self.shares, (len(weights), None), "shares", "point cloud")

    def points(self, places: NDArray) -> NDArray[np.float64]:
        """The points of poses with joints at these places, metres.  # (..., J, 3) -> (..., P, 3)"""
        return self.shares @ np.asarray(places, dtype=np.float64)


def joint_cloud(weights: NDArray) -> PointCloud:
    """One point at each joint that has weight.  # (J,)"""
    weights = np.asarray(weights, dtype=np.float64)
    used = weights > 0.0
    return PointCloud(np.eye(len(weights))[used], weights[used])


def segment_cloud(skeleton: Skeleton, weights: NDArray) -> PointCloud:
    """Points along each segment that has weight, from its joint to that joint's child.

    Args:
        skeleton: the body.
        weights: of the joints' segments.  # (J,)

    Raises:
        InputError: for weight on a segment whose joint has not exactly one child, and weights that are all zero.
    """
    shares, each = [], []
    for joint in np.flatnonzero(weights):
        children = skeleton.children(int(joint))
        if len(children) != 1:
            problem = f"segment {skeleton.names[joint]!r} has {len(children)} outer joints, expected one to have weight"
            raise InputError(problem, skeleton.where)
        for along in ALONG:
            share = np.zeros(skeleton.joint_count)
            share[[joint, children[0]]] = 1.0 - along, along
            shares.append(share)
            each.append(weights[joint] / len(ALONG))
    return PointCloud(np.array(shares).reshape(-1, skeleton.joint_count), np.array(each))
