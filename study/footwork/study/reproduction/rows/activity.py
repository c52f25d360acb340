"""Whether transitions are chosen where there is much going on."""

import numpy as np
from numpy.typing import NDArray

from footwork.motion.clip import Clip
from footwork.motion.kinematics import central_velocity, clip_places
from footwork.study.bootstrap import Estimate, ratio
from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.compared_metrics import (
    INTERVALS,
    METRICS,
    RESAMPLED,
    MetricSet,
    clips_of,
    none_there,
    ranking_of,
    sets_of,
)
from footwork.study.reproduction.row import OURS, Cause, Cell, Column, Judgement, Result, Row, Table, judged
from footwork.study.reproduction.workbench import Workbench

CLAIM = "The transitions that the dynamics metric chooses lie in active phases"


def run(bench: Workbench) -> Result:
    """Mean speed of all joints at the picks and over all frames."""
    sets = sets_of(bench)
    if not sets:
        return none_there(f"{CLAIM}.")
    found = {one: _activity(bench, one) for one in sets}
    columns = [Column("set"), Column("all frames", "m/s", OURS), Column("middle frame", "m/s", OURS)]
    columns += [Column(f"{name} picks", "m/s", OURS) for name in METRICS]
    lines: list[list[Cell]] = [
        [one.name, mean, middle, *(estimate.words(2) for estimate in picks.values())]
        for one, (mean, middle, picks) in found.items()
    ]
    return Result(
        judgements=[_judged(one, *found[one]) for one in sets],
        tables=[Table("Mean speed of the joints", columns, lines)],
        numbers={
            one.name: {"mean": mean, "median": middle, "picks": {name: of._asdict() for name, of in picks.items()}}
            for one, (mean, middle, picks) in found.items()
        },
        notes=[
            "At both frames of a pick; as many picks of each metric as the paper takes. Middle frame: the median over "
            "all frames, half of which are slower.",
            INTERVALS,
            RESAMPLED,
        ],
    )


def _activity(bench: Workbench, one: MetricSet) -> tuple[float, float, dict[str, Estimate]]:
    speeds = np.concatenate([joint_speeds(clip) for clip in clips_of(bench, one)])
    picks = {}
    for name in METRICS:
        chosen = ranking_of(bench, one, name).first(one.count)
        picks[name] = ratio((speeds[chosen.i] + speeds[chosen.j]) / 2.0, np.ones(len(chosen.i)))
    return float(speeds.mean()), float(np.median(speeds)), picks


def joint_speeds(clip: Clip) -> NDArray[np.float64]:
    """Mean speed of a clip's joints in the world at each frame, m/s.  # (F,)"""
    velocities = central_velocity(clip_places(clip)[0], clip.fps)
    return np.linalg.norm(velocities, axis=-1).mean(axis=-1)


def _judged(one: MetricSet, mean: float, middle: float, picks: dict[str, Estimate]) -> Judgement:
    ours = picks["dynamics"]
    reason = (
        f"{ours.words(2, 'm/s')} at the picks, {mean:.2f} m/s on average and {middle:.2f} m/s at the middle frame; "
        f"the uniform metric's picks {picks['uniform'].words(2, 'm/s')}."
    )
    holds = ours.low is not None and ours.low > middle and (ours.value or 0.0) > mean
    return judged(f"{CLAIM} ({one.name}).", holds, reason, Cause.DATA)


ROW = Row(
    name="M-P",
    order=70,
    paper=matsunaga_zordan.PAPER,
    place="text",
    title="Activity at the chosen points",
    claim="The chosen transitions fall in active phases of the motion, not in those where people stand still.",
    published={},
    run=run,
)
