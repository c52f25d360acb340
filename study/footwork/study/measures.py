"""The measures of how a character followed a player: functions of what was asked, shown and taken at each tick.

Source of all definitions: conventions.md 5. Tick k is the command in
force at k/30 s, the edge chosen for it, and the frame which that edge leads to, shown at (k + 1)/30 s; that frame is
the one judged. Times therefore count from the command to the frame: the fastest possible answer takes 1/30 s.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.motion.angle import wrapped
from footwork.motion.task import BEHAVIOURS, HEADED, SteeringTask
from footwork.motion.tick import TICK

STEP = math.radians(15.0)
"""A command that turns by more than this in one tick is a step change; an error within it is settled."""
TASK = SteeringTask()
"""The task that scores are made by, whatever the bundle was solved for: sigma 30 degrees, sigma 1 for smoothness."""
_IS_HEADED = np.array([name in HEADED for name in BEHAVIOURS])


@dataclass(frozen=True, eq=False)
class Followed:
    """What was asked and what came of it, a row a tick.

    Args:
        heading: wanted yaw, radians.  # (K,)
        behaviour: what was asked for, an index into ``task.BEHAVIOURS``.  # (K,)
        jump: number of the jump window that the tick lies in, -1 for none.  # (K,)
        facing: of the frame that the edge leads to, radians.  # (K,)
        shown: behaviour of that frame, an index into ``task.BEHAVIOURS``, -1 for none.  # (K,)
        cost: s of the tick (``charges``), 0 for one that follows the capture.  # (K,)
        switched: whether it left the order of the capture.  # (K,)
        turned: whether the controller added a turn or a shift to it.  # (K,)
    """

    heading: NDArray[np.float64]
    behaviour: NDArray[np.int32]
    jump: NDArray[np.int32]
    facing: NDArray[np.float64]
    shown: NDArray[np.int32]
    cost: NDArray[np.float64]
    switched: NDArray[np.bool_]
    turned: NDArray[np.bool_]

    @property
    def natural(self) -> NDArray[np.bool_]:
        """Ticks that follow the capture and nothing else.  # (K,)"""
        return ~(self.switched | self.turned)

    @property
    def headed(self) -> NDArray[np.bool_]:
        """Ticks at which walk or run is asked for.  # (K,)"""
        return _IS_HEADED[self.behaviour]

    @property
    def error(self) -> NDArray[np.float64]:
        """How far the facing is off the wanted heading, 0..pi.  # (K,)"""
        return np.abs(wrapped(self.heading - self.facing))

    @property
    def control(self) -> NDArray[np.float64]:
        """qc of each tick; 0 where another behaviour is shown than asked for.  # (K,)"""
        return TASK.control_quality(self.heading - self.facing, self.behaviour, self.shown)

    @property
    def transition(self) -> NDArray[np.float64]:
        """qt = exp(-s / sigma) of each tick, 1 for natural edges.  # (K,)"""
        return np.where(self.natural, 1.0, np.exp(-self.cost / TASK.smoothness_sigma))


@dataclass(frozen=True, eq=False)
class Answers:
    """How long each change of a command took to be answered.

    Args:
        seconds: up to the answer, or where there was none up to the next change.  # (changes,)
        answered: whether it was answered before the next change.  # (changes,)
    """

    seconds: NDArray[np.float64]
    answered: NDArray[np.bool_]

    def summary(self) -> dict[str, float | None]:
        """Mean and 95th percentile of the times, None where there was no change."""
        return mean_and_p95(self.seconds)

    @property
    def share(self) -> float | None:
        """The share of changes that were answered, None where there was none."""
        return float(self.answered.mean()) if len(self.answered) else None


def joined(parts: Sequence[Any]) -> Any:
    """Several Followed, or several Answers, one after the other."""
    names = [item.name for item in fields(parts[0])]
    return type(parts[0])(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def answers(changes: NDArray, ends: NDArray, reached: NDArray) -> Answers:
    """Follow each change of a command until it is reached or ends.

    Args:
        changes: ticks at which the command changes, ascending.  # (n,)
        ends: for each the tick at which it is no longer in force.  # (n,)
        reached: whether the frame of a tick does what was asked.  # (K,)
    """
    first = np.append(np.flatnonzero(reached), len(reached))
    hit = first[np.searchsorted(first, changes)]
    answered = hit < ends
    return Answers(np.where(answered, hit - changes + 1, ends - changes) * TICK, answered)


def settling(followed: Followed) -> Answers:
    """Settle time: from each step change of the heading until the error is within 15 degrees.

    A step change is a wanted heading more than 15 degrees away from the last tick's, with walk or run asked for at
    both. It counts as unreached at the next step change, and when walking or running is no longer asked for.
    """
    turned = np.abs(wrapped(np.diff(followed.heading))) > STEP
    going = followed.headed[1:] & followed.headed[:-1]
    changes = np.flatnonzero(turned & going) + 1
    over = np.append(np.flatnonzero((turned & going) | ~followed.headed[1:]) + 1, len(followed.heading))
    ends = over[np.searchsorted(over, changes, side="right")]
    return answers(changes, ends, followed.error <= STEP)


def latencies(followed: Followed) -> Answers:
    """Behaviour latency: from each change of the behaviour asked for until a frame of it is shown, or the next."""
    changes = np.flatnonzero(np.diff(followed.behaviour)) + 1
    ends = np.append(changes[1:], len(followed.behaviour))[: len(changes)]
    return answers(changes, ends, followed.shown == followed.behaviour)


def jumps(followed: Followed) -> dict[str, int]:
    """How many jump windows there were, and in how many a frame of a jump was shown."""
    asked = np.unique(followed.jump[followed.jump >= 0])
    inside = (followed.jump >= 0) & (followed.shown == BEHAVIOURS.index("jump"))
    return {"jumps_asked": len(asked), "jumps_answered": len(np.unique(followed.jump[inside]))}


def quality(followed: Followed) -> dict[str, Any]:
    """Control, Transition and Total: means over ticks, and their product (conventions.md 5).

    ``transition_jumps`` is the mean qt over the ticks that do not just follow the capture, None without any;
    ``switch_share`` and ``turn_share`` are the shares of ticks that leave its order and that add a turn;
    ``total_by_tick`` is the mean of qc qt, a second figure.
    """
    control, transition, jumped = followed.control, followed.transition, ~followed.natural
    return {
        "control": float(control.mean()),
        "transition": float(transition.mean()),
        "transition_jumps": float(transition[jumped].mean()) if jumped.any() else None,
        "switch_share": float(followed.switched.mean()),
        "turn_share": float(followed.turned.mean()),
        "total": float(control.mean() * transition.mean()),
        "total_by_tick": float((control * transition).mean()),
        "heading_error_deg": mean_and_p95(np.degrees(followed.error[followed.headed])),
    }


def mean_and_p95(values: NDArray) -> dict[str, float | None]:
    """Mean and 95th percentile, None where there are no values."""
    if not len(values):
        return {"mean": None, "p95": None}
    return {"mean": float(np.mean(values)), "p95": float(np.percentile(values, 95))}
