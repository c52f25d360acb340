"""Rotations inside compiled loops: quaternions xyzw and vectors as tuples of numbers.

The same formulas for whole arrays are in ``footwork.motion.quaternion``. Compiled callers keep a cache that notices
changes of their own file only: after a change here, delete the ``__pycache__`` folder.
"""

import math

import numba
import numpy as np

# Taylor series of cos(u) and sin(u) / u in u^2, good to 1e-8 up to u = pi / 2, in float32 so that constants do not
# widen the arithmetic. A call of sin or cos would keep the compiler from working on several joints at once.
_C1, _C2, _C3, _C4, _C5, _C6 = (np.float32((-1.0) ** n / math.factorial(2 * n)) for n in range(1, 7))
_S1, _S2, _S3, _S4, _S5, _S6 = (np.float32((-1.0) ** n / math.factorial(2 * n + 1)) for n in range(1, 7))
# arctan(u) / u in u^2
_A1, _A2, _A3, _A4, _A5, _A6, _A7, _A8, _A9 = ((-1.0) ** n / (2 * n + 1) for n in range(1, 10))
_ONE, _TWO, _HALF, _SIXTEENTH = np.float32(1.0), np.float32(2.0), np.float32(0.5), np.float32(0.0625)


@numba.njit(cache=True, nogil=True, forceinline=True)
def exp(x, y, z):
    """The quaternion of a rotation vector under a whole turn: series at a quarter of the angle, doubled.

    It works in the width of its arguments and is good to float32.
    """
    u = _SIXTEENTH * (x * x + y * y + z * z)
    cosine = _ONE + u * (_C1 + u * (_C2 + u * (_C3 + u * (_C4 + u * (_C5 + u * _C6)))))
    sinc = _ONE + u * (_S1 + u * (_S2 + u * (_S3 + u * (_S4 + u * (_S5 + u * _S6)))))
    scale = _HALF * sinc * cosine
    return x * scale, y * scale, z * scale, _ONE - _TWO * u * sinc * sinc


@numba.njit(cache=True, nogil=True, forceinline=True)
def multiply(a, b):
    """The Hamilton product a b."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def log(q):
    """The rotation vector of the shorter way round, in one formula without a call: good to 4e-9 rad.

    With u the tangent of an eighth of the angle it is 8 arctan(u) long.
    """
    sign = -1.0 if q[3] < 0.0 else 1.0
    x, y, z, w = sign * q[0], sign * q[1], sign * q[2], sign * q[3]
    sine = math.sqrt(x * x + y * y + z * z)
    quarter = sine / (1.0 + w)  # tangents of a quarter and an eighth, by the half-angle formula
    root = 1.0 + math.sqrt(1.0 + quarter * quarter)
    eighth = quarter / root
    u = eighth * eighth
    series = _A5 + u * (_A6 + u * (_A7 + u * (_A8 + u * _A9)))
    series = 1.0 + u * (_A1 + u * (_A2 + u * (_A3 + u * (_A4 + u * series))))
    scale = 8.0 * series / ((1.0 + w) * root)
    return x * scale, y * scale, z * scale


@numba.njit(cache=True, nogil=True, forceinline=True)
def cross(a, b):
    """a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@numba.njit(cache=True, nogil=True, forceinline=True)
def along(v, a, u, b, w):
    """v + a u + b w of vectors."""
    return v[0] + a * u[0] + b * w[0], v[1] + a * u[1] + b * w[1], v[2] + a * u[2] + b * w[2]


@numba.njit(cache=True, nogil=True, forceinline=True)
def rotate(q, v):
    """The vector v turned by the quaternion q."""
    axis = q[0], q[1], q[2]
    across = cross(axis, v)
    return along(v, 2.0 * q[3], across, 2.0, cross(axis, across))


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def _size(x):
    """The length of a vector."""
    return math.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def spin(x, q, v):
    """The angular velocity of q = exp(x) where x changes at rate v: the left Jacobian of SO(3) times v.

    With x of length a: v + (1 - cos a) / a^2 x cross v + (a - sin a) / a^3 x cross (x cross v).
    """
    angle, half_sine = _size(x), _size(q)
    tiny = angle < 1e-2
    first = 0.5 if tiny else 2.0 * half_sine * half_sine / (angle * angle)
    second = 1.0 / 6.0 if tiny else (angle - 2.0 * half_sine * q[3]) / (angle * angle * angle)
    across = cross(x, v)
    return along(v, first, across, second, cross(x, across))


@numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
def rate(x, q, spun):
    """The rate at which x changes while q = exp(x) turns at ``spun``: the inverse of ``spin``, for angles up to pi.

    With x of length a: s - x cross s / 2 + (1 - a / 2 cot(a / 2)) / a^2 x cross (x cross s), where s is ``spun``.
    """
    angle, half_sine = _size(x), _size(q)
    tiny = angle < 1e-2
    second = 1.0 / 12.0 if tiny else (1.0 - 0.5 * angle * abs(q[3]) / half_sine) / (angle * angle)
    across = cross(x, spun)
    return along(spun, -0.5, across, second, cross(x, across))


@numba.njit(cache=True, nogil=True, forceinline=True)
def turned(cosine, sine, v):
    """The vector v (3,) turned about +y."""
    return cosine * v[0] + sine * v[2], float(v[1]), cosine * v[2] - sine * v[0]


@numba.njit(cache=True, nogil=True, forceinline=True)
def planar(q, cosine, sine):
    """A rotation in a planar frame, seen from the world: turned about +y by twice the angle of (cosine, sine)."""
    return multiply((0.0, sine, 0.0, cosine), q)


@numba.njit(cache=True, nogil=True, forceinline=True)
def before(spin, q, seconds):
    """The rotation q turning at ``spin``, as it was ``seconds`` before."""
    return multiply(exp(-seconds * spin[0], -seconds * spin[1], -seconds * spin[2]), q)


@numba.njit(cache=True, nogil=True, forceinline=True)
def column3(rows, first, place):
    """Three numbers of one column from row ``first`` on, as a tuple in float64."""
    return float(rows[first, place]), float(rows[first + 1, place]), float(rows[first + 2, place])


@numba.njit(cache=True, nogil=True, forceinline=True)
def column4(rows, first, place):
    """Four numbers of one column from row ``first`` on, as a tuple in float64."""
    return *column3(rows, first, place), float(rows[first + 3, place])
