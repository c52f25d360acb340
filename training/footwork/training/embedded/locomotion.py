"""The embedded clips for steering: standing, walking, turning, running, jumping, ducking and picking up.

Every clip begins and ends standing and passes through the same walk and the same run, so that a motion graph over
them holds together.
"""

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from footwork.motion.body import default_body
from footwork.motion.clip import Clip
from footwork.training.embedded import walking
from footwork.training.embedded.curves import Keys
from footwork.training.embedded.figure import animate
from footwork.training.embedded.footsteps import HOP, LEAP, LEFT, RIGHT, SHUFFLE, Planner
from footwork.training.embedded.gesture import Gesture
from footwork.training.embedded.walking import FAST, JOG, NORMAL, SLOW, SPRINT, Pace, other

_REST = 0.4  # time of standing at both ends of a clip, seconds
Written = tuple[Planner, Gesture | None]
Phrase = tuple[int, Pace, float]  # steps, pace, turn of each step in degrees


def embedded_clips() -> list[Clip]:
    """The clips for steering, at 30 Hz on the common body, labelled, with the contacts they were planned with."""
    return list(_animated())


@cache
def _animated() -> tuple[Clip, ...]:
    """They take a second to make, and are asked for again and again."""
    body = default_body()
    clips = []
    for name, write in _clips().items():
        planner, gesture = write()
        clips.append(animate(name, planner.plan(), body, gesture))
    return tuple(clips)


def _clips() -> dict[str, Callable[[], Written]]:
    clips: dict[str, Callable[[], Written]] = {
        "idle": _idle,
        "walk_normal": lambda: _walk(LEFT, [(6, NORMAL, 0.0)]),
        "walk_slow": lambda: _walk(RIGHT, [(4, SLOW, 0.0), (1, NORMAL, 0.0)]),
        "walk_paces": lambda: _walk(RIGHT, [(2, NORMAL, 0.0), (4, FAST, 0.0), (2, NORMAL, 0.0)]),
        "jump": _jump,
        "walk_leap": _walk_leap,
        "run_leap": _run_leap,
        "duck": _duck,
        "walk_duck": _walk_duck,
        "pick": _pick,
        "run": lambda: _run(LEFT, [(4, JOG, 0.0), (5, SPRINT, 0.0)]),
        "run_short": lambda: _run(RIGHT, [(3, SPRINT, 0.0)]),
        "walk_run_walk": _walk_run_walk,
    }
    for side, foot, sign in (("left", LEFT, 1.0), ("right", RIGHT, -1.0)):
        for name, write in _turns(foot, sign).items():
            clips[f"{name}_{side}"] = write
    return clips


def _turns(inner: int, sign: float) -> dict[str, Callable[[], Written]]:
    """The clips that turn to one side: ``sign`` is 1 to the left, -1 to the right, ``inner`` the foot on that side."""
    outer = other(inner)
    return {
        "curve_wide": lambda: _walk_curve(outer, [(5, NORMAL, 12.0 * sign)]),
        "curve_tight": lambda: _walk_curve(inner, [(5, SLOW, 28.0 * sign)]),
        "turn_90": lambda: _walk_curve(inner, [(3, Pace(0.50, 0.36), 30.0 * sign)], label="turn"),
        "turn_180": lambda: _walk_curve(outer, [(4, Pace(0.50, 0.24), 45.0 * sign)], label="turn"),
        "spot_90": lambda: _spot(inner, 3, 90.0 * sign),
        "spot_180": lambda: _spot(inner, 5, 180.0 * sign),
        "run_curve": lambda: _run_curve(outer, [(5, SPRINT, 14.0 * sign)]),
        "run_turn_90": lambda: _run_curve(inner, [(3, JOG, 32.0 * sign)]),
        "run_turn_180": lambda: _run_curve(outer, [(4, Pace(0.34, 0.45), 46.0 * sign)]),
    }


def _idle() -> Written:
    """Weight shifted from side to side, through the pose that all starts begin in: from there every start is open."""
    planner = Planner().stand(4.8)
    passes = [0.0, 0.7, 1.4, 2.0, 2.7, 3.4, 4.0, 4.6]
    middles = [0.5 * (start + end) for start, end in pairwise(passes)]
    leans = [0.014, -0.016, 0.01, -0.018, 0.012, -0.014, 0.01]
    still: Keys = [(time, 0.0) for time in passes]
    sway = sorted(still + list(zip(middles, leans, strict=True)))
    look = sorted(still + [(time, 9.0 * lean) for time, lean in zip(middles, leans, strict=True)])
    return planner, Gesture({"side": sway, "look": look, "chest_yaw": [(time, 0.2 * turn) for time, turn in look]})


def _walk(foot: int, phrases: list[Phrase]) -> Written:
    planner = Planner().stand(_REST)
    foot = walking.start_walk(planner, foot, phrases[0][1])
    for steps, pace, turn in phrases:
        foot = walking.walk(planner, foot, steps, pace, turn)
    walking.stop_walk(planner, foot, phrases[-1][1])
    return planner.stand(_REST), None


def _enter_walk(foot: int) -> tuple[Planner, int]:
    """Already walking: the clip opens in the stride."""
    planner = Planner().stand(_REST)
    foot = walking.walk(planner, walking.start_walk(planner, foot), 1)
    return planner.open(), walking.walk(planner, foot, 2)


def _leave_walk(planner: Planner, foot: int) -> Planner:
    """Two steps straight on, where the clip closes in the stride."""
    foot = walking.walk(planner, foot, 2)
    planner.close()
    walking.stop_walk(planner, walking.walk(planner, foot, 1))
    return planner.stand(_REST)


def _enter_run(foot: int) -> tuple[Planner, int]:
    planner = Planner().stand(_REST)
    foot = walking.run(planner, walking.start_run(planner, foot), 2)
    return planner.open(), walking.run(planner, foot, 2)


def _leave_run(planner: Planner, foot: int) -> Planner:
    foot = walking.run(planner, foot, 2)
    planner.close()
    walking.stop_run(planner, walking.run(planner, foot, 1))
    return planner.stand(_REST)


def _walk_curve(foot: int, phrases: list[Phrase], label: str = "walk") -> Written:
    planner, foot = _enter_walk(foot)
    for steps, pace, turn in phrases:
        foot = walking.walk(planner, foot, steps, pace, turn, label=label)
    return _leave_walk(planner, foot), None


def _run_curve(foot: int, phrases: list[Phrase]) -> Written:
    planner, foot = _enter_run(foot)
    for steps, pace, turn in phrases:
        foot = walking.run(planner, foot, steps, pace, turn)
    return _leave_run(planner, foot), None


def _spot(foot: int, steps: int, turn: float) -> Written:
    planner = Planner().stand(_REST)
    walking.turn_on_the_spot(planner, foot, steps, turn)
    # the feet come together facing the new way: nothing turns any more, so it is no turn to ask for
    planner.step(other(foot) if steps % 2 else foot, 0.44, gait=SHUFFLE, swing=0.38, label="idle")
    return planner.stand(_REST), None


def _run(foot: int, phrases: list[Phrase]) -> Written:
    planner = Planner().stand(_REST)
    foot = walking.start_run(planner, foot)
    for steps, pace, turn in phrases:
        foot = walking.run(planner, foot, steps, pace, turn)
    walking.stop_run(planner, foot)
    return planner.stand(_REST), None


def _walk_run_walk() -> Written:
    planner, foot = _enter_walk(RIGHT)
    foot = walking.run(planner, walking.quicken(planner, foot), 5)
    return _leave_walk(planner, walking.slow_down(planner, foot)), None


def _jump() -> Written:
    """From standing, off both feet: crouch with the arms back, arms up into the flight, landing in the knees."""
    planner = Planner().stand(_REST).go(0.62, label="jump")
    up, down = planner.now, planner.now + 0.44
    for foot in (LEFT, RIGHT):
        planner.swing(foot, up, down, HOP, takeoff=0.04)
    planner.go(0.44, label="jump").go(0.65, label="jump").stand(_REST)
    arms: Keys = [
        (up - 0.6, 0.0),
        (up - 0.25, -0.9),
        (up + 0.02, 1.9),
        (down, 0.9),
        (down + 0.3, 0.2),
        (down + 0.7, 0.0),
    ]
    lean: Keys = [
        (up - 0.6, 0.0),
        (up - 0.22, 0.75),
        (up, 0.05),
        (down - 0.05, 0.1),
        (down + 0.22, 0.55),
        (down + 0.7, 0.0),
    ]
    drop: Keys = [(up - 0.6, 0.0), (up - 0.22, 0.27), (up, 0.0), (down, 0.03), (down + 0.22, 0.22), (down + 0.7, 0.0)]
    back: Keys = [(time, 0.3 * value) for time, value in drop]
    elbow: Keys = [(up - 0.6, 0.0), (up - 0.25, 0.2), (up, 0.7), (down, 0.5), (down + 0.6, 0.0)]
    curves = {"drop": drop, "back": back, "lean": lean, "pelvis_pitch": [(t, 0.4 * v) for t, v in lean]}
    heels: Keys = [(up - 0.6, 0.0), (up - 0.25, -0.10), (up, 0.0), (down + 0.1, 0.0)]
    curves |= {f"{side}_toe": heels for side in ("left", "right")}
    curves |= {f"{side}_arm": arms for side in ("left", "right")} | {
        f"{side}_elbow": elbow for side in ("left", "right")
    }
    return planner, Gesture(curves)


class Leap(NamedTuple):
    """A long flight: its step and the one out of it, the time in the air, the leading foot's swing (seconds), and
    the height of the centre of mass above standing at both ends (metres)."""

    step: Pace
    onward: Pace
    flight: float
    swing: float
    takeoff: float


_WALKING_LEAP = Leap(Pace(0.64, 1.02), Pace(0.46, 0.78), 0.34, 0.58, -0.035)
_RUNNING_LEAP = Leap(Pace(0.57, 1.70), Pace(0.37, 1.08), 0.30, 0.66, -0.015)


def _leap(planner: Planner, foot: int, leap: Leap) -> Gesture:
    """A leap that lands on ``foot``, and the step out of it with the other one."""
    start = planner.now
    planner.step(foot, *leap.step, gait=LEAP, swing=leap.swing, label="jump", takeoff=leap.takeoff)
    land = planner.now
    planner.step(other(foot), *leap.onward, gait=LEAP, swing=leap.onward.seconds + leap.flight, label="jump")
    drop: Keys = [(start - 0.2, 0.0), (start + 0.1, 0.05), (land - leap.flight, 0.0)]
    spread: Keys = [(start, 0.0), (land - 0.5 * leap.flight, 0.45), (land + 0.3, 0.0)]
    return Gesture({"drop": drop, "left_spread": spread, "right_spread": spread})


def _walk_leap() -> Written:
    planner, foot = _enter_walk(RIGHT)
    gesture = _leap(planner, foot, _WALKING_LEAP)
    return _leave_walk(planner, foot), gesture


def _run_leap() -> Written:
    planner, foot = _enter_run(RIGHT)
    gesture = _leap(planner, foot, _RUNNING_LEAP)
    return _leave_run(planner, foot), gesture


def _ducking(down: float, low: float, up: float, end: float) -> Gesture:
    """Bend at hips and knees between ``down`` and ``end``, lowest from ``low`` to ``up`` (seconds)."""
    shape: Keys = [(down, 0.0), (low, 1.0), (up, 1.0), (end, 0.0)]
    sizes = {
        "drop": 0.21,
        "back": 0.07,
        "lean": 0.85,
        "pelvis_pitch": 0.4,
        "nod": 0.15,
        "left_toe": -0.08,
        "right_toe": -0.08,
    }
    sizes |= {"left_elbow": 0.5, "right_elbow": 0.5, "left_arm": 0.15, "right_arm": 0.15}
    return Gesture({name: [(time, size * share) for time, share in shape] for name, size in sizes.items()})


def _duck() -> Written:
    planner = Planner().stand(_REST)
    start = planner.now
    planner.go(1.7, label="duck").stand(_REST)
    return planner, _ducking(start, start + 0.5, start + 1.0, start + 1.7)


def _walk_duck() -> Written:
    planner, foot = _enter_walk(LEFT)
    start = planner.now
    foot = walking.walk(planner, foot, 4, Pace(0.54, 0.55), label="duck")
    end = planner.now
    return _leave_walk(planner, foot), _ducking(start - 0.1, start + 0.6, end - 0.6, end + 0.1)


def _pick() -> Written:
    """Squat, reach for the floor before the feet with both hands, stand up."""
    planner = Planner().stand(_REST)
    start = planner.now
    planner.go(2.3, label="pick").stand(_REST)
    shape: Keys = [(start, 0.0), (start + 0.9, 1.0), (start + 1.25, 1.0), (start + 2.25, 0.0)]
    sizes = {
        "drop": 0.46,
        "back": 0.12,
        "lean": 1.05,
        "pelvis_pitch": 0.55,
        "nod": 0.75,
        "left_toe": -0.22,
        "right_toe": -0.22,
    }
    for sign, side in ((1.0, "left"), (-1.0, "right")):
        sizes |= {f"{side}_hand": 1.0}
        sizes |= {f"{side}_hand_left": 0.13 * sign, f"{side}_hand_up": -0.42, f"{side}_hand_ahead": 0.34}
    return planner, Gesture({name: [(time, size * share) for time, share in shape] for name, size in sizes.items()})
