"""The innermost loops of interpolation: poses between two sources, and where joints are for given rotations."""

import math

import numba
import numpy as np
from numpy.typing import NDArray

# where the series of slerp is exact to double precision: up to 50 degrees between two rotations
_SERIES_FROM, _TERMS = 0.9, 12


@numba.njit(cache=True, nogil=True)
def blend(
    turns: NDArray,
    points: NDArray,
    chain: NDArray,
    position: NDArray,
    bounds: NDArray,
    weight: NDArray,
    move: NDArray,
    blended_turns: NDArray,
    blended_points: NDArray,
) -> None:
    """Mix two sources at the given positions on their curves: rotations by slerp, points linearly.

    Args:
        turns: curves of rotations, of joint 0 first and of the feet last in the world.  # (F, J + feet, 4)
        points: curves of points in the world.  # (F, 1 + feet, 3)
        chain: chain of each row.  # (R,)
        position: where each row is on the curves of the first and second source, frames.  # (R, 2)
        bounds: first and last frame of the first source's clip, then of the second's.  # (C, 4)
        weight: share of the first source.  # (C,)
        move: yaw, x and z that align the second source to the first.  # (C, 3)
        blended_turns: the result.  # (R, J + feet, 4)
        blended_points: the result.  # (R, 1 + feet, 3)
    """
    rows, tracks, spots = position.shape[0], turns.shape[1], points.shape[1]
    series = np.empty((2, _TERMS))
    begun = -1
    world_from = tracks - (spots - 1)
    taps = np.empty((2, 4))
    at = np.empty((2, 4), dtype=np.int64)
    for row in range(rows):
        c = chain[row]
        for source in range(2):
            _taps(position[row, source], bounds[c, 2 * source], bounds[c, 2 * source + 1], at[source], taps[source])
        share, yaw = float(weight[c]), float(move[c, 0])
        if c != begun:
            _terms(1.0 - share, series[0])
            _terms(share, series[1])
            begun = c
        half_sine, half_cosine = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
        for track in range(tracks):
            a = _rotation(turns, track, at[0], taps[0])
            b = _rotation(turns, track, at[1], taps[1])
            if track == 0 or track >= world_from:
                b = _turned(b, half_sine, half_cosine)
            x, y, z, w = _slerp(b, a, share, series)
            blended_turns[row, track, 0], blended_turns[row, track, 1] = x, y
            blended_turns[row, track, 2], blended_turns[row, track, 3] = z, w
        sine, cosine = math.sin(yaw), math.cos(yaw)
        for spot in range(spots):
            ax, ay, az = _point(points, spot, at[0], taps[0])
            bx, by, bz = _point(points, spot, at[1], taps[1])
            blended_points[row, spot, 0] = share * ax + (1.0 - share) * (bx * cosine + bz * sine + move[c, 1])
            blended_points[row, spot, 1] = share * ay + (1.0 - share) * by
            blended_points[row, spot, 2] = share * az + (1.0 - share) * (bz * cosine - bx * sine + move[c, 2])


@numba.njit(cache=True, nogil=True)
def _taps(position: float, low: int, high: int, at: NDArray, taps: NDArray) -> None:
    """The four frames round a position held inside low..high, and their weights in the cubic through them.

    Catmull-Rom: it meets the frames, and a parabola exactly, so that a captured fall stays one.
    """
    held = min(max(position, float(low)), float(high))
    frame = min(math.floor(held), high)
    t = held - frame
    for k in range(4):
        at[k] = min(max(frame - 1 + k, low), high)
    taps[0] = t * (-0.5 + t * (1.0 - 0.5 * t))
    taps[1] = 1.0 + t * t * (1.5 * t - 2.5)
    taps[2] = t * (0.5 + t * (2.0 - 1.5 * t))
    taps[3] = t * t * (0.5 * t - 0.5)


@numba.njit(cache=True, nogil=True)
def _rotation(turns: NDArray, track: int, at: NDArray, taps: NDArray) -> tuple[float, float, float, float]:
    a, b, c, d = turns[at[0], track], turns[at[1], track], turns[at[2], track], turns[at[3], track]
    x = taps[0] * a[0] + taps[1] * b[0] + taps[2] * c[0] + taps[3] * d[0]
    y = taps[0] * a[1] + taps[1] * b[1] + taps[2] * c[1] + taps[3] * d[1]
    z = taps[0] * a[2] + taps[1] * b[2] + taps[2] * c[2] + taps[3] * d[2]
    w = taps[0] * a[3] + taps[1] * b[3] + taps[2] * c[3] + taps[3] * d[3]
    scale = 1.0 / math.sqrt(x * x + y * y + z * z + w * w)
    return x * scale, y * scale, z * scale, w * scale


@numba.njit(cache=True, nogil=True)
def _point(points: NDArray, spot: int, at: NDArray, taps: NDArray) -> tuple[float, float, float]:
    x = y = z = 0.0
    for k in range(4):
        p = points[at[k], spot]
        x += taps[k] * p[0]
        y += taps[k] * p[1]
        z += taps[k] * p[2]
    return x, y, z


@numba.njit(cache=True, nogil=True)
def _turned(
    q: tuple[float, float, float, float], half_sine: float, half_cosine: float
) -> tuple[float, float, float, float]:
    """The rotation q followed by a yaw."""
    x, y, z, w = q
    return (
        half_cosine * x + half_sine * z,
        half_cosine * y + half_sine * w,
        half_cosine * z - half_sine * x,
        half_cosine * w - half_sine * y,
    )


@numba.njit(cache=True, nogil=True)
def _terms(share: float, terms: NDArray) -> None:
    """Terms of sin(share * angle) / sin(angle) in powers of cos(angle) - 1 (Eberly 2011)."""
    terms[0] = share
    for i in range(1, terms.shape[0]):
        terms[i] = terms[i - 1] * (share * share - i * i) / (i * (2 * i + 1))


@numba.njit(cache=True, nogil=True)
def _slerp(
    a: tuple[float, float, float, float], b: tuple[float, float, float, float], share: float, series: NDArray
) -> tuple[float, float, float, float]:
    """The rotation a ``share`` of the shorter way from a to b; ``series`` are the terms for 1 - share and share."""
    cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
    sign = 1.0
    if cosine < 0.0:
        cosine, sign = -cosine, -1.0
    if cosine > _SERIES_FROM:
        # several times faster than sines, and without their nothing by nothing for equal rotations
        first, second, below = 0.0, 0.0, cosine - 1.0
        for i in range(_TERMS - 1, -1, -1):
            first, second = first * below + series[0, i], second * below + series[1, i]
    else:
        angle = math.acos(cosine)
        inverse = 1.0 / math.sin(angle)
        first, second = math.sin((1.0 - share) * angle) * inverse, math.sin(share * angle) * inverse
    second *= sign
    return (
        first * a[0] + second * b[0],
        first * a[1] + second * b[1],
        first * a[2] + second * b[2],
        first * a[3] + second * b[3],
    )


@numba.njit(cache=True, nogil=True)
def place_joints(
    joints: NDArray, parents: NDArray, offsets: NDArray, local: NDArray, places: NDArray, turns: NDArray
) -> None:
    """Forward kinematics with joint 0 at the origin, of some joints.

    Args:
        joints: those to place, parents before children, others being placed already.  # (K,)
        parents: of all joints.  # (J,)
        offsets: in their parents' frames.  # (J, 3)
        local: rotations; more of them than joints are not looked at.  # (R, >= J, 4)
        places: the result.  # (R, J, 3)
        turns: world rotations, the result.  # (R, J, 4)
    """
    for row in range(local.shape[0]):
        for joint in joints:
            q = local[row, joint]
            if joint == 0:
                places[row, 0] = 0.0
                # one by one: the message that Numba has ready for rows of another length takes seconds to compile
                for k in range(4):
                    turns[row, 0, k] = q[k]
                continue
            parent = parents[joint]
            p = turns[row, parent]
            turns[row, joint, 0] = p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1]
            turns[row, joint, 1] = p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0]
            turns[row, joint, 2] = p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3]
            turns[row, joint, 3] = p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2]
            dx, dy, dz = _rotated(p, offsets[joint])
            places[row, joint, 0] = places[row, parent, 0] + dx
            places[row, joint, 1] = places[row, parent, 1] + dy
            places[row, joint, 2] = places[row, parent, 2] + dz


@numba.njit(cache=True, nogil=True)
def localise(joints: NDArray, parents: NDArray, turns: NDArray, local: NDArray) -> None:
    """Write the local rotations of some joints, none of them joint 0, that give their world rotations.

    Args:
        joints: which.  # (K,)
        parents: of all joints.  # (J,)
        turns: world rotations.  # (R, J, 4)
        local: the result.  # (R, >= J, 4)
    """
    for row in range(turns.shape[0]):
        for joint in joints:
            p, q = turns[row, parents[joint]], turns[row, joint]
            local[row, joint, 0] = p[3] * q[0] - p[0] * q[3] - p[1] * q[2] + p[2] * q[1]
            local[row, joint, 1] = p[3] * q[1] + p[0] * q[2] - p[1] * q[3] - p[2] * q[0]
            local[row, joint, 2] = p[3] * q[2] - p[0] * q[1] + p[1] * q[0] - p[2] * q[3]
            local[row, joint, 3] = p[3] * q[3] + p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


@numba.njit(cache=True, nogil=True)
def centres_of_mass(centres: NDArray, shares: NDArray, places: NDArray, turns: NDArray, result: NDArray) -> None:
    """Centres of mass of poses.

    Args:
        centres: of the segments in their joints' frames.  # (J, 3)
        shares: of the segments in the body's mass.  # (J,)
        places: of the joints.  # (R, J, 3)
        turns: their world rotations.  # (R, J, 4)
        result: the centres.  # (R, 3)
    """
    for row in range(places.shape[0]):
        x = y = z = 0.0
        for joint in range(places.shape[1]):
            if shares[joint] > 0.0:
                dx, dy, dz = _rotated(turns[row, joint], centres[joint])
                x += shares[joint] * (places[row, joint, 0] + dx)
                y += shares[joint] * (places[row, joint, 1] + dy)
                z += shares[joint] * (places[row, joint, 2] + dz)
        result[row, 0], result[row, 1], result[row, 2] = x, y, z


@numba.njit(cache=True, nogil=True)
def _rotated(q: NDArray, v: NDArray) -> tuple[float, float, float]:
    tx = 2.0 * (q[1] * v[2] - q[2] * v[1])
    ty = 2.0 * (q[2] * v[0] - q[0] * v[2])
    tz = 2.0 * (q[0] * v[1] - q[1] * v[0])
    return (
        v[0] + q[3] * tx + q[1] * tz - q[2] * ty,
        v[1] + q[3] * ty + q[2] * tx - q[0] * tz,
        v[2] + q[3] * tz + q[0] * ty - q[1] * tx,
    )


@numba.njit(cache=True, nogil=True)
def align_starts(places: NDArray, start: NDArray, last: NDArray, frames: int, move: NDArray) -> None:
    """The yaw and shift that bring the first frames of second segments closest to those of first ones.

    All joints of all frames count alike; frames past a clip's end repeat its last. The closed form is that of
    ``motion.alignment``, summed in one order whatever pairs are asked for, so that poses come out the same again.

    Args:
        places: world places of joints.  # (F, J, 3)
        start: first frames of the two segments of each pair.  # (P, 2)
        last: last frames of their clips.  # (P, 2)
        frames: how many frames to compare.
        move: the result, yaw and x, z of the second's origin.  # (P, 3)
    """
    count = float(frames * places.shape[1])
    for pair in range(start.shape[0]):
        ax = az = bx = bz = 0.0
        for k in range(frames):
            a = places[min(start[pair, 0] + k, last[pair, 0])]
            b = places[min(start[pair, 1] + k, last[pair, 1])]
            for joint in range(places.shape[1]):
                ax += a[joint, 0]
                az += a[joint, 2]
                bx += b[joint, 0]
                bz += b[joint, 2]
        ax, az, bx, bz = ax / count, az / count, bx / count, bz / count
        sine = cosine = 0.0
        for k in range(frames):
            a = places[min(start[pair, 0] + k, last[pair, 0])]
            b = places[min(start[pair, 1] + k, last[pair, 1])]
            for joint in range(places.shape[1]):
                px, pz = a[joint, 0] - ax, a[joint, 2] - az
                qx, qz = b[joint, 0] - bx, b[joint, 2] - bz
                sine += px * qz - pz * qx
                cosine += px * qx + pz * qz
        yaw = math.atan2(sine, cosine)
        move[pair, 0] = yaw
        move[pair, 1] = ax - (bx * math.cos(yaw) + bz * math.sin(yaw))
        move[pair, 2] = az - (bz * math.cos(yaw) - bx * math.sin(yaw))
