"""The simulated root: where the player's wish leads a character's root, by springs, whatever its clips do.

It is kept as seen from the character, so a character that is put elsewhere takes it along. A root is eight numbers:
place x, z, yaw, velocity x, z, acceleration x, z and angular velocity, metres, radians and seconds.
"""

import math

import numba

from footwork.motion.tick import TICK
from footwork.study.motion_matching.springs import angle_after, share_gone, velocity_after

NUMBERS = 8


@numba.njit(cache=True, nogil=True)
def wrapped(angle):
    """The same direction in -pi..pi."""
    return angle - 2.0 * math.pi * math.floor(angle / (2.0 * math.pi) + 0.5)


@numba.njit(cache=True, nogil=True)
def root_after(root, speed, heading, options, seconds):
    """The root after some time of asking for a speed (m/s) and a heading, which is seen from the character too."""
    halflife = options.velocity_halflife
    x, vx, ax = velocity_after(root[0], root[3], root[5], speed * math.sin(heading), halflife, seconds)
    z, vz, az = velocity_after(root[1], root[4], root[6], speed * math.cos(heading), halflife, seconds)
    wanted = root[2] + wrapped(heading - root[2])
    yaw, spin = angle_after(root[2], root[7], wanted, options.rotation_halflife, seconds)
    return x, z, yaw, vx, vz, ax, az, spin


@numba.njit(cache=True, nogil=True)
def move_character(root, by):
    """See the root from where the character is after a planar step ``by`` (x, z, yaw), in place."""
    cosine, sine = math.cos(by[2]), math.sin(by[2])
    root[0] -= by[0]
    root[1] -= by[1]
    root[2] -= by[2]
    for x, z in ((0, 1), (3, 4), (5, 6)):
        root[x], root[z] = root[x] * cosine - root[z] * sine, root[z] * cosine + root[x] * sine


@numba.njit(cache=True, nogil=True)
def pull_to(root, speed, spin, pull):
    """The adjustment (x, z, yaw) that pulls a character of a speed (m/s) and a spin (rad/s) to its root."""
    far, wide = math.hypot(root[0], root[1]), abs(root[2])
    go = min(far * share_gone(pull.position_halflife, TICK), pull.share * speed * TICK)
    part = max(go, far - pull.farthest) / far if far > 0.0 else 0.0
    turn = min(wide * share_gone(pull.rotation_halflife, TICK), pull.share * spin * TICK)
    return part * root[0], part * root[1], math.copysign(max(turn, wide - pull.widest), root[2])
