"""Turn warping: what it costs to turn a character by more, or less, than its capture does.

A controller may add a planar transform to a step (an adjustment). Its s is that of conventions.md 2 between the motion
from the step on and the same motion adjusted, without alignment, over those frames of the metric's window that come
after the step (convention)::

    s = sum W_k w |R p + t - p|^2 / UNIT^2
      = 4 sin^2(yaw / 2) M2 + 2 t . (R - 1) (Mx, Mz) + |t|^2 M0

so four moments of a node give it for every adjustment. A turn about a standing foot leaves that foot where it is; in
flight a turn costs least about (Mx, Mz) / M0.
"""

from dataclasses import dataclass

import numpy as np
from numba.extending import register_jitable
from numpy.typing import ArrayLike, NDArray

from footwork.motion.alignment import turn
from footwork.motion.arrays import frozen
from footwork.motion.graph import MotionGraph
from footwork.motion.graph_windows import NONE, GraphWindows, composed
from footwork.motion.metric import UNIT
from footwork.motion.window import RADIUS, window_weights


@dataclass(frozen=True, eq=False)
class TurnWarp:
    """What extra turns go about and cost at each of N nodes, in the node's planar frame; read-only.

    Args:
        pivot: the point (x, z) that a turn goes about, metres: the ball of the foot that stands, midway between the
            balls where both do; where none does, that about which a turn costs least.  # (N, 2)
        moments: M0, Mx, Mz, M2, the sums of 1, x, z and x^2 + z^2 over the window's later frames by the uniform
            metric's weights, divided by UNIT^2.  # (N, 4)
        price: s of a turn about the pivot, divided by 4 sin^2(yaw / 2).  # (N,)
    """

    pivot: NDArray[np.float64]
    moments: NDArray[np.float64]
    price: NDArray[np.float64]


def turn_warp(graph: MotionGraph) -> TurnWarp:
    """The pivots and prices of turns at every node of a graph of the common body.

    The frames after a node are those along natural edges; where there is none, the last is held.
    """
    places = graph.joint_places[..., [0, 2]]  # (N, J, 2)
    moments = _moments_ahead(graph, _moments_of_poses(places))
    pivot = _pivots(places[:, graph.skeleton.feet[:, 1]], graph.contacts, moments[:, 1:3] / moments[:, :1])
    price = moments[:, 3] - 2.0 * (pivot * moments[:, 1:3]).sum(axis=-1) + moments[:, 0] * (pivot**2).sum(axis=-1)
    return TurnWarp(*(frozen(array, np.float64) for array in (pivot, moments, price)))


def adjustment_cost(moments: ArrayLike, adjustment: ArrayLike) -> NDArray[np.float64]:
    """s of adjustments (x, z, yaw), metres and radians.  # (..., 4), (..., 3) -> (...)"""
    m, by = np.asarray(moments, dtype=np.float64), np.asarray(adjustment, dtype=np.float64)
    return cost_of_adjustment(m[..., 0], m[..., 1], m[..., 2], m[..., 3], by[..., 0], by[..., 1], by[..., 2])


def turned(pivot: ArrayLike, yaw: ArrayLike) -> NDArray[np.float64]:
    """The adjustments (x, z, yaw) that are turns about pivots.  # (..., 2), (...) -> (..., 3)"""
    about, yaw = np.asarray(pivot, dtype=np.float64), np.asarray(yaw, dtype=np.float64)
    return np.stack(np.broadcast_arrays(*turn_about(about[..., 0], about[..., 1], yaw)), axis=-1)


@register_jitable
def cost_of_adjustment(m0, mx, mz, m2, x, z, yaw):
    """``adjustment_cost`` in scalars, for compiled callers too."""
    less_cosine, sine = 2.0 * np.sin(0.5 * yaw) ** 2, np.sin(yaw)
    moved = x * (sine * mz - less_cosine * mx) - z * (sine * mx + less_cosine * mz)
    return 2.0 * less_cosine * m2 + 2.0 * moved + (x * x + z * z) * m0


@register_jitable
def turn_about(pivot_x, pivot_z, yaw):
    """``turned`` in scalars, for compiled callers too: (x, z, yaw)."""
    less_cosine, sine = 2.0 * np.sin(0.5 * yaw) ** 2, np.sin(yaw)
    return pivot_x * less_cosine - pivot_z * sine, pivot_x * sine + pivot_z * less_cosine, yaw


def _pivots(
    balls: NDArray[np.float64], contacts: NDArray[np.bool_], otherwise: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The mean of the standing balls, or else another point.  # (N, feet, 2), (N, feet), (N, 2) -> (N, 2)"""
    standing = contacts.sum(axis=-1, keepdims=True)
    mean = (balls * contacts[..., None]).sum(axis=1) / np.maximum(standing, 1)
    return np.where(standing > 0, mean, otherwise)


def _moments_of_poses(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Means of 1, x, z and x^2 + z^2 over the joints of each pose.  # (N, J, 2) -> (N, 4)"""
    one = np.ones((len(places), 1))
    return np.hstack([one, places.mean(axis=1), (places**2).sum(axis=-1).mean(axis=-1, keepdims=True)])


def _moments_ahead(graph: MotionGraph, poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """The window's sums of the moments of the poses that follow, each in its first node's planar frame.  # (N, 4)"""
    windows = GraphWindows(graph)
    following = np.where(windows.after == NONE, np.arange(graph.node_count), windows.after)
    at, place = np.arange(graph.node_count), np.zeros((graph.node_count, 3))
    total = np.zeros_like(poses)
    for weight in window_weights()[RADIUS:] / UNIT**2:
        total += weight * _moved(poses[at], place)
        place = composed(place, windows.step[at])
        at = following[at]
    return total


def _moved(moments: NDArray[np.float64], place: NDArray[np.float64]) -> NDArray[np.float64]:
    """Moments (n, 4) of single poses, each taken through its planar place (n, 3)."""
    x, z, yaw = place.T
    mean_x, mean_z = turn(moments[:, 1], moments[:, 2], yaw)
    square = moments[:, 3] + 2.0 * (mean_x * x + mean_z * z) + x**2 + z**2
    return np.stack([moments[:, 0], mean_x + x, mean_z + z, square], axis=-1)
