"""What a motion matching controller is set to: the reference form, and the strong one."""

import math
from typing import NamedTuple

from footwork.study.motion_matching.features import Weights


class RootPull(NamedTuple):
    """How a character's root is pulled to the simulated one, as the public reference implementation has it.

    Each tick takes what lies between them by the half-lives, but no more than a share of the character's own speed
    makes good; what is left beyond the limits is taken at once.
    """

    position_halflife: float = 0.1  # s
    rotation_halflife: float = 0.2  # s
    share: float = 0.5  # of the character's own speed and of its own turning
    farthest: float = 0.15  # m
    widest: float = math.pi / 2  # rad


class Turning(NamedTuple):
    """How a character turns towards the heading asked for: about the point where that is charged least."""

    most: float = math.radians(6.0)  # rad a tick
    gain: float = 0.41  # share of what is missing that a tick makes good
    gain_unheaded: float = 0.15  # the same while frames are shown that are not judged by their heading


class MatchingOptions(NamedTuple):
    """One form of motion matching.

    Args:
        weights: of the groups of features.
        search_ticks: ticks from one search to the next.
        sharp_velocity: a velocity asked for that differs by more than this from the last tick's is searched for at
            once, m/s; so is another behaviour.
        sharp_turn: the same of a heading, rad.
        velocity_halflife: of the spring that leads the simulated root to the velocity asked for, s.
        rotation_halflife: of the spring that leads it to the heading asked for, s.
        skipped_end: frames at the end of a clip that are not searched.
        skipped_around: frames on each side of the one shown that are not searched.
        skipped_run_end: frames at the end of a stretch of one behaviour that a search for it leaves out.
        transition_cost: by how much a frame must be nearer than the one shown.
        by_behaviour: whether only frames of the behaviour asked for are searched; without it only a jump is, and the
            other behaviours ask for their speed.
        follows: whether the simulated root follows the character, which turns as ``turning`` says; without it the
            character is pulled to the simulated root as ``pull`` says.
    """

    weights: Weights = Weights()
    search_ticks: int = 3
    sharp_velocity: float = 50.0 / 60.0
    sharp_turn: float = 50.0 / 60.0
    velocity_halflife: float = 0.27
    rotation_halflife: float = 0.27
    skipped_end: int = 10
    skipped_around: int = 10
    skipped_run_end: int = 0
    transition_cost: float = 0.0
    by_behaviour: bool = False
    follows: bool = False
    pull: RootPull = RootPull()
    turning: Turning = Turning()


REFERENCE = MatchingOptions()
"""The public reference implementation's: its times of 60 Hz as ticks of 30 Hz, its sharp changes as rates at 60 Hz."""

STRONG = MatchingOptions(
    weights=Weights(0.46, 0.31, 1.57, 1.66, 0.83),
    search_ticks=93,
    sharp_velocity=11.0,
    sharp_turn=3.6,
    velocity_halflife=0.015,
    rotation_halflife=0.14,
    skipped_end=9,
    skipped_around=31,
    skipped_run_end=10,
    transition_cost=4.0,
    by_behaviour=True,
    follows=True,
    turning=Turning(gain=0.24, gain_unheaded=0.15),
)
"""Tuned by ``tuning`` for the highest Total of its training traces, on mirrored clips that show all behaviours.

Of every leap Total loses nearly a whole tick: so it came to search hardly ever but where another behaviour is asked for
or a clip ends, and to leave headings to turning.
"""
