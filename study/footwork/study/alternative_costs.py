"""Costs of all pairs of frames under the metrics that Matsunaga and Zordan (2007) weigh against the point cloud.

Both use the uniform metric's window, weights and unit (conventions.md 1 and 2), over clips laid end to end.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.clip import Clip
from footwork.motion.kinematics import clip_places
from footwork.motion.metric import UNIT
from footwork.motion.threads import THREADS
from footwork.motion.window import RADIUS, window_frames, window_weights

REACH = 0.1  # metres that a turn of one radian counts: about what it moves the ends of a segment of 20 cm (convention)


def centre_aligned(clips: Sequence[Clip]) -> NDArray[np.float64]:
    """s with the windows laid onto each other by their middle frames alone, so never under the metric's.  # (N, N)"""
    places, _, windows = _laid_end_to_end(clips)

    def fill(rows: NDArray[np.intp], costs: NDArray[np.float64]) -> None:
        _centre_rows(rows, places, windows, window_weights(), RADIUS, costs)

    return _symmetric(fill, len(places))


def positions_and_orientations(clips: Sequence[Clip], reach: float = REACH) -> NDArray[np.float64]:
    """s that also counts how differently each joint is turned in the world: |d|^2 + (reach angle)^2.  # (N, N)

    Windows are laid onto each other by their points.

    Args:
        clips: of one body.
        reach: what a radian counts, metres.
    """
    places, turns, windows = _laid_end_to_end(clips)

    def fill(rows: NDArray[np.intp], costs: NDArray[np.float64]) -> None:
        _turning_rows(rows, places, turns, windows, window_weights(), reach, costs)

    return _symmetric(fill, len(places))


def _laid_end_to_end(clips: Sequence[Clip]) -> tuple[NDArray, NDArray, NDArray]:
    found = [clip_places(clip) for clip in clips]
    places, turns = (np.concatenate([each[part] for each in found]) for part in (0, 1))
    return places, turns, window_frames([clip.frame_count for clip in clips])


def _symmetric(fill: Callable[[NDArray[np.intp], NDArray[np.float64]], None], count: int) -> NDArray[np.float64]:
    """The matrix whose rows ``fill`` writes from the diagonal on, in square metres, in units of s and mirrored."""
    costs = np.zeros((count, count))
    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(lambda thread: fill(np.arange(thread, count, THREADS), costs), range(THREADS)))
    costs /= UNIT**2
    return costs + np.triu(costs, 1).T


@numba.njit(cache=True, nogil=True)
def _centre_rows(
    rows: NDArray, places: NDArray, windows: NDArray, weights: NDArray, middle: int, costs: NDArray
) -> None:
    for i in rows:
        p = places[windows[i]]
        for j in range(i + 1, costs.shape[0]):
            q = places[windows[j]]
            centre = slice(middle, middle + 1)
            theta, x0, z0 = _aligned(p[centre], q[centre], weights[centre])
            costs[i, j] = _distance(p, q, weights, theta, x0, z0)


@numba.njit(cache=True, nogil=True)
def _turning_rows(
    rows: NDArray, places: NDArray, turns: NDArray, windows: NDArray, weights: NDArray, reach: float, costs: NDArray
) -> None:
    for i in rows:
        p = places[windows[i]]
        for j in range(i + 1, costs.shape[0]):
            q = places[windows[j]]
            theta, x0, z0 = _aligned(p, q, weights)
            turned = _turned(turns, windows[i], windows[j], weights, theta)
            costs[i, j] = _distance(p, q, weights, theta, x0, z0) + reach**2 * turned


@numba.njit(cache=True, nogil=True)
def _aligned(p: NDArray, q: NDArray, weights: NDArray) -> tuple[float, float, float]:
    """Yaw and shift that bring points q onto p (conventions.md 1), all points of a frame alike.  # (F, P, 3) each"""
    px = pz = qx = qz = same = across = total = 0.0
    for frame in range(p.shape[0]):
        w = weights[frame]
        for point in range(p.shape[1]):
            a, b = p[frame, point], q[frame, point]
            px += w * a[0]
            pz += w * a[2]
            qx += w * b[0]
            qz += w * b[2]
            same += w * (a[0] * b[0] + a[2] * b[2])
            across += w * (a[0] * b[2] - a[2] * b[0])
            total += w
    theta = np.arctan2(across - (px * qz - pz * qx) / total, same - (px * qx + pz * qz) / total)
    cosine, sine = np.cos(theta), np.sin(theta)
    return theta, (px - qx * cosine - qz * sine) / total, (pz + qx * sine - qz * cosine) / total


@numba.njit(cache=True, nogil=True)
def _distance(p: NDArray, q: NDArray, weights: NDArray, theta: float, x0: float, z0: float) -> float:
    """Weighted mean square distance of q, laid so, from p."""
    cosine, sine, square = np.cos(theta), np.sin(theta), 0.0
    for frame in range(p.shape[0]):
        for point in range(p.shape[1]):
            a, b = p[frame, point], q[frame, point]
            x = a[0] - (b[0] * cosine + b[2] * sine + x0)
            z = a[2] - (b[2] * cosine - b[0] * sine + z0)
            square += weights[frame] * (x * x + (a[1] - b[1]) ** 2 + z * z)
    return square / p.shape[1]


@numba.njit(cache=True, nogil=True)
def _turned(turns: NDArray, here: NDArray, there: NDArray, weights: NDArray, theta: float) -> float:
    """Weighted mean square angle between rotations, the second turned by a yaw.  # turns (N, J, 4)"""
    cosine, sine, square = np.cos(theta / 2.0), np.sin(theta / 2.0), 0.0
    for k in range(len(here)):
        for joint in range(turns.shape[1]):
            a, b = turns[here[k], joint], turns[there[k], joint]
            same = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
            yawed = a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1]
            angle = 2.0 * np.arccos(min(1.0, abs(cosine * same + sine * yawed)))
            square += weights[k] * angle * angle
    return square / turns.shape[1]
