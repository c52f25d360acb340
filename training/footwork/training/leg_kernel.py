"""Legs that reach for their feet, row by row: ``motion.ik.reach`` for millions of rows.

The same closed form in a loop of its own, because batches of rows spend most of their time on carrying vectors to and
from memory. The tests hold the two to one another.
"""

import math

import numba
from numpy.typing import NDArray

Vector = tuple[float, float, float]
Rotation = tuple[float, float, float, float]
_STRAIGHT = 0.01  # as in motion.ik


@numba.njit(cache=True, nogil=True)
def reach_feet(legs: NDArray, bend: NDArray, places: NDArray, turns: NDArray, targets: NDArray) -> None:
    """Turn thighs and shanks in place so that ankles come to their targets; legs keep their bending planes.

    Args:
        legs: hip, knee and ankle of each leg.  # (feet, 3)
        bend: where a straight knee bends to, in the hip joint's frame.  # (3,)
        places: of all joints before.  # (R, J, 3)
        turns: world rotations of all joints, changed in those of hips and knees.  # (R, J, 4)
        targets: where the ankles shall be, in the frame of ``places``.  # (R, feet, 3)
    """
    for row in range(places.shape[0]):
        for leg in range(legs.shape[0]):
            hip, knee, ankle = legs[leg, 0], legs[leg, 1], legs[leg, 2]
            root = _vector(places[row, hip])
            upper = _minus(_vector(places[row, knee]), root)
            tip = _minus(_vector(places[row, ankle]), root)
            lower = _minus(tip, upper)
            goal = _minus(_vector(targets[row, leg]), root)
            along = _unit(tip, upper)
            pole = _pole(upper, along, _rotated(_rotation(turns[row, hip]), _vector(bend)))
            new_along = _unit(goal, along)
            normal, new_normal = _normal(along, pole), _normal(new_along, pole)
            new_upper, new_lower = _triangle(_length(upper), _length(lower), _length(goal), new_along, new_normal)
            _turn(turns[row, hip], upper, normal, new_upper, new_normal)
            _turn(turns[row, knee], lower, normal, new_lower, new_normal)


@numba.njit(cache=True, nogil=True)
def _pole(upper: Vector, along: Vector, bend: Vector) -> Vector:
    """Where the knee points, leaning to ``bend`` as the leg comes to be straight."""
    offset = _across(upper, along)
    lean = max(_STRAIGHT * _length(upper) - _length(offset), 0.0)
    return _plus(offset, bend, lean)


@numba.njit(cache=True, nogil=True)
def _normal(along: Vector, pole: Vector) -> Vector:
    """The unit normal of the bending plane; any across the leg where the pole lies along it."""
    normal = _cross(along, pole)
    if _length(normal) > 1e-9 * _length(pole):
        return _unit(normal, normal)
    anything = (1.0, 0.0, 0.0) if abs(along[0]) < 0.9 else (0.0, 1.0, 0.0)
    across = _cross(along, anything)
    return _unit(across, across)


@numba.njit(cache=True, nogil=True)
def _triangle(upper: float, lower: float, distance: float, along: Vector, normal: Vector) -> tuple[Vector, Vector]:
    """Both bones of a leg that spans ``distance``, or as near to it as they can, by the law of cosines."""
    held = min(max(distance, abs(upper - lower)), upper + lower)
    foot = (upper * upper - lower * lower + held * held) / (2.0 * max(held, 1e-12))
    foot = min(max(foot, -upper), upper)
    outward = _cross(normal, along)
    high = math.sqrt(upper * upper - foot * foot)
    knee = _plus((foot * along[0], foot * along[1], foot * along[2]), outward, high)
    tip = (held * along[0], held * along[1], held * along[2])
    return knee, _minus(tip, knee)


@numba.njit(cache=True, nogil=True)
def _turn(turn: NDArray, bone: Vector, normal: Vector, new_bone: Vector, new_normal: Vector) -> None:
    """Turn a rotation by that which takes ``bone`` to ``new_bone`` and the bending plane's normal with it."""
    swing = _between(_unit(bone, bone), _unit(new_bone, new_bone))
    axis = _unit(new_bone, new_bone)
    start = _across(_rotated(swing, normal), axis)
    half = 0.5 * math.atan2(_dot(_cross(start, new_normal), axis), _dot(start, new_normal))
    sine = math.sin(half)
    twist = (sine * axis[0], sine * axis[1], sine * axis[2], math.cos(half))
    turned = _product(twist, _product(swing, _rotation(turn)))
    turn[0], turn[1], turn[2], turn[3] = turned


@numba.njit(cache=True, nogil=True)
def _between(start: Vector, end: Vector) -> Rotation:
    """The smallest rotation from one unit vector to another; a half turn about any axis across for opposite ones."""
    cosine = _dot(start, end)
    if cosine < -1.0 + 1e-9:
        helper = (1.0, 0.0, 0.0) if abs(start[0]) < 0.9 else (0.0, 1.0, 0.0)
        axis = _cross(start, helper)
        axis = _unit(axis, axis)
        return axis[0], axis[1], axis[2], 0.0
    axis = _cross(start, end)
    scale = 1.0 / math.sqrt(_dot(axis, axis) + (1.0 + cosine) * (1.0 + cosine))
    return axis[0] * scale, axis[1] * scale, axis[2] * scale, (1.0 + cosine) * scale


@numba.njit(cache=True, nogil=True)
def _product(a: Rotation, b: Rotation) -> Rotation:
    return (
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    )


@numba.njit(cache=True, nogil=True)
def _rotated(q: Rotation, v: Vector) -> Vector:
    axis = (q[0], q[1], q[2])
    twice = _cross(axis, v)
    twice = (2.0 * twice[0], 2.0 * twice[1], 2.0 * twice[2])
    return _plus(_plus(v, twice, q[3]), _cross(axis, twice), 1.0)


@numba.njit(cache=True, nogil=True)
def _vector(values: NDArray) -> Vector:
    return values[0], values[1], values[2]


@numba.njit(cache=True, nogil=True)
def _rotation(values: NDArray) -> Rotation:
    return values[0], values[1], values[2], values[3]


@numba.njit(cache=True, nogil=True)
def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@numba.njit(cache=True, nogil=True)
def _plus(a: Vector, b: Vector, share: float) -> Vector:
    return a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]


@numba.njit(cache=True, nogil=True)
def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@numba.njit(cache=True, nogil=True)
def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@numba.njit(cache=True, nogil=True)
def _length(a: Vector) -> float:
    return math.sqrt(_dot(a, a))


@numba.njit(cache=True, nogil=True)
def _unit(a: Vector, spare: Vector) -> Vector:
    """``a`` at length one, or ``spare`` where it is zero."""
    length = _length(a)
    if length <= 1e-12:
        a, length = spare, _length(spare)
    return a[0] / length, a[1] / length, a[2] / length


@numba.njit(cache=True, nogil=True)
def _across(a: Vector, along: Vector) -> Vector:
    """The part of ``a`` across the unit vector ``along``."""
    return _plus(a, along, -_dot(a, along))
