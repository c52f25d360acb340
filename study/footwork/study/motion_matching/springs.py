"""Springs of the simulated root: critically damped, solved exactly, by half-life.

Source: the public notes and code of Daniel Holden on springs; with half-life h the decay is y = 2 ln 2 / h, as
conventions.md 10 has it for inertialisation.
"""

import math

import numba


@numba.njit(cache=True, nogil=True)
def velocity_after(position, velocity, acceleration, wanted, halflife, seconds):
    """Position, velocity and acceleration after some time of a velocity that springs towards the one wanted.

    All are numbers along one axis, metres and seconds.
    """
    y = 2.0 * math.log(2.0) / halflife
    j0 = velocity - wanted
    j1 = acceleration + j0 * y
    decayed = math.exp(-y * seconds)
    gone = j1 / (y * y) + j0 / y - decayed * (j1 / (y * y) + (j0 + j1 * seconds) / y)
    return (
        position + gone + wanted * seconds,
        decayed * (j0 + j1 * seconds) + wanted,
        decayed * (acceleration - j1 * y * seconds),
    )


@numba.njit(cache=True, nogil=True)
def angle_after(angle, speed, wanted, halflife, seconds):
    """An angle and its speed after some time of springing towards the one wanted, radians."""
    y = 2.0 * math.log(2.0) / halflife
    j0 = angle - wanted
    j1 = speed + j0 * y
    decayed = math.exp(-y * seconds)
    return decayed * (j0 + j1 * seconds) + wanted, decayed * (speed - j1 * y * seconds)


@numba.njit(cache=True, nogil=True)
def share_gone(halflife, seconds):
    """The share of a distance that exponential decay takes away: 1 - 2 ** (-seconds / halflife)."""
    return 1.0 - math.exp(-math.log(2.0) * seconds / halflife)
