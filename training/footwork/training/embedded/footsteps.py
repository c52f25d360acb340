"""The footstep plan: where the body goes, and when and where each foot stands.

A plan is written as a series of stands and steps in the body's own directions. The body's path comes first; each
contact is then put beside the place that the body passes in the middle of that contact.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from footwork.training.embedded.curves import smoothed

LEFT, RIGHT = 0, 1
FPS = 30
RATE = 240.0  # samples a second of the path's integration
_SETTLED = 1.0  # a contact at an end of the clip counts as this much longer, seconds


@dataclass(frozen=True)
class Gait:
    """How feet are set down and lifted; angles in radians, toes up positive.

    Args:
        half_width: distance of a foot from the path, metres.
        ahead: distance of the ball of the foot before the hip in the middle of a contact, metres.
        toe_out: yaw of the feet away from the path.
        strike: pitch of the foot at landing.
        push: pitch of the foot at lifting.
        trail: pitch of the foot early in its swing.
        middle: pitch of the foot in the middle of its swing.
        rise: height of the swing, metres.
        peel: time over which the heel lifts before the toes, seconds.
        arrive: speed of the foot at landing, as a share of its mean speed in the swing.
        arc: exponents of the swing's rise and fall (see ``curves.hump``).
        home: whether feet are set down at the planner's homes rather than by ``half_width``, ``ahead`` and ``toe_out``.
        run: 0 for a walk's arms and trunk, 1 for a run's.
    """

    half_width: float
    ahead: float
    toe_out: float
    strike: float
    push: float
    trail: float
    middle: float
    rise: float
    peel: float
    arrive: float = 0.0
    arc: tuple[float, float] = (2.0, 3.0)
    home: bool = False
    run: float = 0.0


def _degrees(strike: float, push: float, trail: float, middle: float) -> tuple[float, float, float, float]:
    return math.radians(strike), math.radians(push), math.radians(trail), math.radians(middle)


# width, ahead, toe-out, then strike, push, trail and middle, then rise and peel
STAND = Gait(0.085, 0.11, math.radians(8), *_degrees(0, 0, 0, 0), 0.0, 0.2, home=True)
WALK = Gait(0.055, 0.05, math.radians(6), *_degrees(20, -52, -60, -12), 0.055, 0.28, arrive=0.35)
SHUFFLE = Gait(0.085, 0.11, math.radians(8), *_degrees(0, -22, -24, -6), 0.07, 0.2, home=True)
RUN = Gait(0.035, -0.005, math.radians(4), *_degrees(6, -48, -85, -45), 0.18, 0.18, arrive=0.5, run=1.0)
GUARD_STEP = Gait(0.0, 0.0, 0.0, *_degrees(0, -12, -10, 0), 0.05, 0.1, home=True)
HOP = Gait(0.085, 0.11, math.radians(8), *_degrees(-16, -50, -52, -34), 0.25, 0.16, arc=(1.15, 1.15), home=True)
LEAP = Gait(0.05, 0.04, math.radians(5), *_degrees(6, -48, -75, -54), 0.16, 0.24, arrive=0.5, run=0.4)


@dataclass(frozen=True)
class Contact:
    """One foot on the ground: from when to when (seconds), where its ball is (metres) and how it comes and goes."""

    foot: int
    start: float
    end: float
    x: float
    z: float
    yaw: float
    strike: float
    push: float
    gait: Gait  # of the step that ends in this contact
    next_gait: Gait  # of the step that follows it


@dataclass(frozen=True, eq=False)
class Plan:
    """The finished plan, sampled at 30 Hz.

    Args:
        times: seconds.  # (F,)
        path: x, z of the body, metres.  # (F, 2)
        heading: yaw of the body's way, unwrapped.  # (F,)
        speed: forward and leftward speed, m/s.  # (F, 2)
        run: 0 walking to 1 running.  # (F,)
        contacts: for each foot its contacts in order.
        labels: one word a frame.  # (F,)
        takeoffs: (landing time, height of the centre of mass above standing) of each step, for those with a flight.
        shown: first frame of the clip and the one after its last; the rest is run-up and run-out.
    """

    times: NDArray[np.float64]
    path: NDArray[np.float64]
    heading: NDArray[np.float64]
    speed: NDArray[np.float64]
    run: NDArray[np.float64]
    contacts: tuple[tuple[Contact, ...], tuple[Contact, ...]]
    labels: NDArray[np.str_]
    takeoffs: tuple[tuple[float, float], ...]
    shown: tuple[int, int]

    def standing(self) -> NDArray[np.bool_]:
        """Which feet stand on the ground at each frame.  # (F, 2)"""
        return np.stack([_inside(self.times, contacts) for contacts in self.contacts], axis=-1)

    def flights(self) -> list[tuple[float, float]]:
        """The spans of time in which no foot stands, seconds."""
        spans = sorted((contact.start, contact.end) for foot in self.contacts for contact in foot)
        flights, reached = [], spans[0][1]
        for start, end in spans[1:]:
            if start > reached + 1e-9:
                flights.append((reached, start))
            reached = max(reached, end)
        return flights


def _inside(times: NDArray[np.float64], contacts: tuple[Contact, ...]) -> NDArray[np.bool_]:
    return np.any([(times >= contact.start) & (times <= contact.end) for contact in contacts], axis=0)


@dataclass(frozen=True)
class _Leg:
    """One stretch of the path at even speed."""

    seconds: float
    ahead: float
    left: float
    turn: float
    gait: Gait
    label: str


@dataclass(frozen=True)
class _Swing:
    foot: int
    lift: float
    land: float
    gait: Gait
    stride: float  # 0 for a step on the spot to 1 for a usual walking step and more: scales the foot's roll


@dataclass
class Planner:
    """Writes a plan step by step; ``now`` is the landing of the last step.

    ``homes`` are the places of left and right foot beside the path while standing: left, ahead (metres), yaw.
    """

    homes: tuple[tuple[float, float, float], tuple[float, float, float]] = (
        (STAND.half_width, STAND.ahead, STAND.toe_out),
        (-STAND.half_width, STAND.ahead, -STAND.toe_out),
    )
    smoothing: float = 0.5
    now: float = 0.0
    opening: float | None = None
    closing: float | None = None
    _legs: list[_Leg] = field(default_factory=list)
    _swings: list[_Swing] = field(default_factory=list)
    _takeoffs: list[tuple[float, float]] = field(default_factory=list)

    def stand(self, seconds: float, label: str = "idle") -> "Planner":
        """Stay for a while."""
        return self.go(seconds, label=label)

    def go(
        self,
        seconds: float,
        ahead: float = 0.0,
        left: float = 0.0,
        turn: float = 0.0,
        label: str = "idle",
        gait: Gait = STAND,
    ) -> "Planner":
        """Move the body for a while without a landing at the end; metres and radians over the whole of it."""
        self._legs.append(_Leg(seconds, ahead, left, turn, gait, label))
        self.now += seconds
        return self

    def step(
        self,
        foot: int,
        seconds: float,
        ahead: float = 0.0,
        left: float = 0.0,
        turn: float = 0.0,
        gait: Gait = WALK,
        swing: float | None = None,
        label: str = "walk",
        takeoff: float = -0.045,
    ) -> "Planner":
        """Move the body for ``seconds`` and end with the landing of ``foot`` after ``swing`` seconds in the air.

        Args:
            foot: LEFT or RIGHT.
            seconds: since the last landing.
            ahead: the body's way forward, metres.
            left: the body's way to the left, metres.
            turn: the change of heading, radians.
            gait: how the foot moves.
            swing: time of the foot off the ground; None for a usual walk or run.
            label: what the frames are called.
            takeoff: height of the centre of mass above standing at both ends of a flight, metres.
        """
        share = 1.25 if gait.run > 0.5 else 0.84
        swing = share * seconds if swing is None else swing
        self.go(seconds, ahead, left, turn, label, gait)
        stride = min(abs(ahead) / 0.7, 1.15) if gait is WALK else 1.0
        self._swings.append(_Swing(foot, self.now - swing, self.now, gait, stride))
        self._takeoffs.append((self.now, takeoff))
        return self

    def swing(self, foot: int, lift: float, land: float, gait: Gait, takeoff: float = 0.0) -> "Planner":
        """Take a foot off the ground between two times, whatever the body does; ``takeoff`` as in ``step``."""
        self._swings.append(_Swing(foot, lift, land, gait, 1.0))
        self._takeoffs.append((land, takeoff))
        return self

    def open(self) -> "Planner":
        """Begin the clip here: what came before only brings the body into its stride."""
        self.opening = self.now
        return self

    def close(self) -> "Planner":
        """End the clip here."""
        self.closing = self.now
        return self

    def plan(self) -> Plan:
        """The finished plan."""
        count = round(self.now * RATE) + 1
        fine = np.arange(count) / RATE
        ahead, left, turn, run = self._speeds(fine)
        heading = np.concatenate([[0.0], np.cumsum(turn[:-1]) / RATE])
        speed = np.stack(
            [left * np.cos(heading) + ahead * np.sin(heading), ahead * np.cos(heading) - left * np.sin(heading)],
            axis=-1,
        )
        path = np.concatenate([np.zeros((1, 2)), np.cumsum(speed[:-1], axis=0) / RATE])
        every = slice(None, None, round(RATE / FPS))
        return Plan(
            times=fine[every],
            path=path[every],
            heading=heading[every],
            speed=np.stack([ahead, left], axis=-1)[every],
            run=run[every],
            contacts=(self._contacts(LEFT, fine, path, heading), self._contacts(RIGHT, fine, path, heading)),
            labels=self._labels(fine[every]),
            takeoffs=tuple(self._takeoffs),
            shown=(round((self.opening or 0.0) * FPS), round((self.closing or self.now) * FPS) + 1),
        )

    def _leg_of(self, times: NDArray[np.float64]) -> NDArray[np.intp]:
        ends = np.cumsum([leg.seconds for leg in self._legs])
        return np.minimum(np.searchsorted(ends, times, side="right"), len(self._legs) - 1)

    def _speeds(self, fine: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        which = self._leg_of(fine)
        rows = [
            [leg.ahead / leg.seconds, leg.left / leg.seconds, leg.turn / leg.seconds, leg.gait.run]
            for leg in self._legs
        ]
        return list(smoothed(np.array(rows)[which], self.smoothing, RATE).T)

    def _labels(self, times: NDArray[np.float64]) -> NDArray[np.str_]:
        return np.array([leg.label for leg in self._legs])[self._leg_of(times)]

    def _contacts(
        self, foot: int, fine: NDArray[np.float64], path: NDArray[np.float64], heading: NDArray[np.float64]
    ) -> tuple[Contact, ...]:
        swings = sorted((swing for swing in self._swings if swing.foot == foot), key=lambda swing: swing.lift)
        resting = _Swing(foot, self.now + _SETTLED, -_SETTLED, STAND, 1.0)
        contacts = []
        for before, after in zip([resting, *swings], [*swings, resting], strict=True):
            middle = 0.5 * (before.land + after.lift)
            standing = STAND in (before.gait, after.gait) or after.lift - before.land > 1.0
            gait = STAND if standing else before.gait
            at = int(np.clip(round(middle * RATE), 0, len(fine) - 1))
            x, z, yaw = self._place(foot, gait, path[at], heading[at])
            strike, push = before.gait.strike * before.stride, after.gait.push * min(1.0, 0.4 + 0.6 * after.stride)
            contacts.append(Contact(foot, before.land, after.lift, x, z, yaw, strike, push, before.gait, after.gait))
        return tuple(contacts)

    def _place(self, foot: int, gait: Gait, path: NDArray[np.float64], heading: float) -> tuple[float, float, float]:
        side = 1.0 if foot == LEFT else -1.0
        home = self.homes[foot] if gait.home else (side * gait.half_width, gait.ahead, side * gait.toe_out)
        left, ahead, yaw = home
        x = path[0] + left * math.cos(heading) + ahead * math.sin(heading)
        z = path[1] + ahead * math.cos(heading) - left * math.sin(heading)
        return float(x), float(z), float(heading + yaw)
