"""How well fighters shadow: by a rule that looks one segment ahead, or by a table of costs to come.

Two fighters do nothing but shadow one another. Facing is the bearing of the opponent, distance is between hips. In half
of the trials they are left alone; in the others one of them is pushed away from the opponent and turned.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.fighting_style import STYLES, FightingStyle
from footwork.controllers.shadowing import TableShadowing
from footwork.motion.angle import wrapped
from footwork.motion.tick import TICK, TICK_RATE
from footwork.runtime.match import FightGround, Match
from footwork.study.bootstrap import Estimate, ratio

PUSH, TURN = 2.0, np.radians(90.0)
"""Metres away from the opponent, and radians, to either side in turn."""
NEAR, FACING = 0.3, np.radians(30.0)
"""Errors of distance and facing under which, both at once, a fighter has recovered."""
PATIENCE = 20.0
"""Seconds after which it counts as not recovered."""
SETTLING = 10.0
"""Seconds before anything is measured."""


@dataclass(frozen=True)
class Trials:
    """What came of some trials: means with 95 % intervals over matches.

    Args:
        distance: error of the distance kept, metres.
        facing: error of the facing, degrees.
        distance_p95: 95th percentile of all ticks, metres.
        facing_p95: likewise, degrees.
        moving: how fast fighters go over the ground, m/s.
        recovery: seconds until a fighter that was pushed has recovered, PATIENCE where it has not.
        recovered: the share that has.
    """

    distance: Estimate
    facing: Estimate
    distance_p95: float
    facing_p95: float
    moving: Estimate
    recovery: Estimate
    recovered: float

    def record(self) -> dict[str, object]:
        """JSON-able."""
        return {name: part._asdict() if isinstance(part, Estimate) else part for name, part in vars(self).items()}


def shadowing_trials(
    ground: FightGround,
    table: TableShadowing | None,
    *,
    turn: float,
    matches: int = 8,
    pushes: int = 40,
    seconds: float = 180.0,
) -> Trials:
    """Let two usual fighters shadow one another, without chance in what they choose.

    Args:
        ground: of the bundle.
        table: what both shadow by, None for the rule.
        turn: how far they may turn beyond their capture, degrees a tick at most.
        matches: how many are left alone, from seed 0 on.
        pushes: in how many a fighter is pushed, from the next seed on.
        seconds: that each of those left alone takes.
    """
    style = replace(STYLES["balanced"], turn=turn, variety=0.0, roam=0.0)
    alone = [_left_alone(_shadowing(ground, style, table, seed), seconds) for seed in range(matches)]
    pushed = [_recovery(_shadowing(ground, style, table, matches + number), number % 2) for number in range(pushes)]
    apart = [np.abs(distances(places) - style.distance) for places in alone]
    off = [np.degrees(np.abs(bearings(places))) for places in alone]
    speed = [np.hypot(*np.moveaxis(np.diff(places[..., :2], axis=0), -1, 0)) * TICK_RATE for places in alone]
    return Trials(
        distance=_mean(apart),
        facing=_mean(off),
        distance_p95=float(np.quantile(np.concatenate(apart), 0.95)),
        facing_p95=float(np.quantile(np.concatenate(off), 0.95)),
        moving=_mean(speed),
        recovery=_mean([np.array([seconds]) for seconds in pushed]),
        recovered=float(np.mean(np.array(pushed) < PATIENCE)),
    )


def distances(places: NDArray) -> NDArray[np.float64]:
    """Between both fighters over the ground, metres.  # (T, 2, 3) -> (T,)"""
    return np.hypot(places[:, 0, 0] - places[:, 1, 0], places[:, 0, 1] - places[:, 1, 1])


def bearings(places: NDArray) -> NDArray[np.float64]:
    """The direction in which each fighter has the other less its own facing, radians.  # (T, 2, 3) -> (T, 2)"""
    way = places[:, ::-1, :2] - places[:, :, :2]
    return wrapped(np.arctan2(way[..., 0], way[..., 1]) - places[..., 2])


def _shadowing(ground: FightGround, style: FightingStyle, table: TableShadowing | None, seed: int) -> Match:
    """A match in which both have shadowed for a while."""
    match = Match(ground, (style, style), seed, shadowing=table, inertialise=False, foot_lock=False)
    for who in (0, 1):
        match.choose(who, activity="shadow")
    match.play(round(SETTLING * TICK_RATE))
    return match


def _left_alone(match: Match, seconds: float) -> NDArray[np.float64]:
    match.play(round(seconds * TICK_RATE))
    return match.track.place


def _recovery(match: Match, side: int) -> float:
    """Seconds until fighter 0, pushed away and turned, has recovered."""
    (x, z, yaw), (other_x, other_z, _) = match.world.place.copy()
    away = np.array([x - other_x, z - other_z])
    away *= PUSH / max(float(np.hypot(*away)), 1e-6)
    match.world.teleport(0, x + away[0], z + away[1], yaw + (TURN if side else -TURN))
    match.play(round(PATIENCE * TICK_RATE))
    places = match.track.place
    near = np.abs(distances(places) - STYLES["balanced"].distance) < NEAR
    done = near & (np.abs(bearings(places)[:, 0]) < FACING)
    return float((np.argmax(done) + 1) * TICK) if done.any() else PATIENCE


def _mean(parts: Sequence[NDArray]) -> Estimate:
    """Over all that matches hold, with the interval of drawing whole matches."""
    return ratio([part.sum() for part in parts], [part.size for part in parts])
