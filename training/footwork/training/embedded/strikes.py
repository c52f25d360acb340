"""Single fighting moves as keys around the guard: jab, cross, front kick, block and duck.

Every move starts and ends in the guard, left foot and left shoulder in front. Times are seconds from its start.
"""

from collections import defaultdict

import numpy as np

from footwork.training.embedded.gesture import Gesture

# the guard: bladed to the right, knees soft, rear heel off the ground, fists before the chin
GUARD = {
    "drop": 0.055,
    "pelvis_yaw": -0.60,
    "chest_yaw": -0.55,
    "lean": 0.16,
    "nod": 0.10,
    "right_toe": -0.25,
    "left_hand": 1.0,
    "left_hand_chest": 1.0,
    "left_hand_left": 0.18,
    "left_hand_up": 0.21,
    "left_hand_ahead": 0.30,
    "right_hand": 1.0,
    "right_hand_chest": 1.0,
    "right_hand_left": -0.04,
    "right_hand_up": 0.19,
    "right_hand_ahead": 0.22,
}
_BOUNCE_SECONDS = 0.64

# what each move adds to the guard, as (time, added value); a strike's targets are in the heading's directions
Move = dict[str, list[tuple[float, float]]]


def _there_and_back(start: float, top: float, hold: float, end: float, sizes: dict[str, float]) -> Move:
    return {name: [(start, 0.0), (top, size), (top + hold, size), (end, 0.0)] for name, size in sizes.items()}


def _hand_to(side: str, left: float, up: float, ahead: float) -> dict[str, float]:
    """The added values that bring a hand from the guard to a place in the heading's directions."""
    goal = {"left": left, "up": up, "ahead": ahead, "chest": 0.0}
    return {f"{side}_hand_{name}": value - GUARD[f"{side}_hand_{name}"] for name, value in goal.items()}


def jab() -> tuple[Move, float]:
    """The left fist straight out and back; returns the move and its time."""
    fist = _there_and_back(0.06, 0.22, 0.09, 0.52, _hand_to("left", -0.02, 0.19, 0.68))
    body = {"chest_yaw": -0.28, "pelvis_yaw": -0.12, "back": -0.07, "drop": 0.02, "right_hand_up": 0.03}
    return fist | _there_and_back(0.0, 0.23, 0.04, 0.55, body), 0.6


def cross() -> tuple[Move, float]:
    """The right fist out of the turning hips, the rear foot pivoting on its ball."""
    fist = _there_and_back(0.10, 0.30, 0.04, 0.60, _hand_to("right", 0.0, 0.20, 0.68))
    body = {
        "pelvis_yaw": 0.85,
        "chest_yaw": 1.10,
        "back": -0.10,
        "drop": 0.03,
        "right_swivel": 0.75,
        "right_toe": -0.45,
    }
    guard = {"left_hand_left": -0.06, "left_hand_ahead": -0.10}
    return fist | _there_and_back(0.0, 0.28, 0.05, 0.66, body | guard), 0.72


def front_kick() -> tuple[Move, float]:
    """The rear foot through a high knee into a push at belly height; the foot is off the ground from 0.14 to 0.86 s."""
    foot: Move = {
        "right_foot_up": [(0.20, 0.0), (0.36, 0.56), (0.50, 1.0), (0.54, 1.0), (0.66, 0.54), (0.80, 0.0)],
        "right_foot_ahead": [(0.20, 0.0), (0.36, 0.42), (0.50, 1.14), (0.54, 1.14), (0.66, 0.46), (0.80, 0.0)],
        "right_foot_left": [(0.20, 0.0), (0.36, 0.07), (0.50, 0.12), (0.66, 0.07), (0.80, 0.0)],
        "right_toe": [(0.20, 0.0), (0.36, -0.10), (0.50, 1.35), (0.54, 1.35), (0.66, -0.15), (0.80, 0.0)],
        "right_swivel": [(0.20, 0.0), (0.38, 0.85), (0.62, 0.85), (0.80, 0.0)],
    }
    body = {"pelvis_yaw": 0.85, "chest_yaw": 0.55, "pelvis_pitch": -0.40, "lean": -0.46, "drop": -0.03}
    body |= {"left_swivel": 0.35, "back": 0.02, "right_hand_ahead": 0.04}
    return foot | _there_and_back(0.04, 0.48, 0.06, 0.95, body), 1.0


def block() -> tuple[Move, float]:
    """Both forearms up before the head, behind a tucked chin."""
    hands = {"left_hand_up": 0.20, "left_hand_left": -0.02, "left_hand_ahead": -0.07}
    hands |= {"right_hand_up": 0.17, "right_hand_left": -0.06, "right_hand_ahead": 0.02}
    body = {"lean": 0.16, "nod": 0.30, "drop": 0.06, "back": 0.06, "chest_yaw": 0.15, "tilt": -0.08}
    return _there_and_back(0.0, 0.20, 0.22, 0.72, hands | body), 0.78


def duck() -> tuple[Move, float]:
    """Down under a hook, hips back, fists up."""
    body = {"drop": 0.27, "back": 0.08, "lean": 0.55, "pelvis_pitch": 0.30, "tilt": -0.12, "nod": 0.15}
    body |= {"left_toe": -0.18, "right_toe": -0.30}
    return _there_and_back(0.0, 0.32, 0.12, 0.90, body), 0.95


def sway_back() -> tuple[Move, float]:
    """The trunk away from a punch, while the feet step back."""
    return _there_and_back(0.0, 0.22, 0.10, 0.75, {"lean": -0.26, "pelvis_pitch": -0.10, "nod": 0.12}), 0.8


def gesture_of(moves: list[tuple[float, Move]], seconds: float) -> Gesture:
    """The guard with moves from their start times, in a clip of ``seconds``; moves that overlap add up."""
    added: dict[str, list[list[tuple[float, float]]]] = defaultdict(list)
    for start, move in moves:
        for name, keys in move.items():
            added[name].append([(start + time, value) for time, value in keys])
    added["side"].append(_bounce(seconds, 2 * _BOUNCE_SECONDS, 0.014))
    added["drop"].append(_bounce(seconds, _BOUNCE_SECONDS, 0.006))
    return Gesture({name: _summed(GUARD.get(name, 0.0), added[name]) for name in GUARD.keys() | added.keys()})


def _summed(base: float, parts: list[list[tuple[float, float]]]) -> list[tuple[float, float]]:
    """Keys of a constant and several broken lines together."""
    times = sorted({time for part in parts for time, _ in part}) or [0.0]
    total = np.full(len(times), base)
    for part in parts:
        total += np.interp(times, [time for time, _ in part], [value for _, value in part])
    return list(zip(times, total.tolist(), strict=True))


def _bounce(seconds: float, period: float, size: float) -> list[tuple[float, float]]:
    """A light sway to both sides."""
    count = int(2.0 * seconds / period) + 2
    return [(0.5 * step * period, size if step % 2 else -size) for step in range(count)]
