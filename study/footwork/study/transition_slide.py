"""How far feet slide in blended transitions, beside what they slide in the two motions that are blended.

After Matsunaga and Zordan (2007), who print two figures: from the start of a blend to its end, and along the way
between. They do not say which foot, when and whether over the ground. Ours (conventions.md 7): the ball of each foot,
over the ground, while it stands in the source or in the target; one that stands, lifts and stands again slides twice.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from footwork.motion.alignment import Alignment
from footwork.motion.clip import Clip
from footwork.motion.kinematics import forward
from footwork.motion.metric import Metric
from footwork.motion.skeleton import Skeleton
from footwork.motion.tick import TICK
from footwork.study.blends import AROUND, BLEND, Runs, blended, laid, runs_of
from footwork.study.skating import skating_steps, standing_height, weighted_speeds
from footwork.training.transitions import Minima

STEPS = slice(AROUND, BLEND.stop - 1)  # steps of a run that belong to its blend
CM = 100.0


@dataclass(frozen=True, eq=False)
class FootSlide:
    """What each foot slides in each of M runs, cm.

    Args:
        straight: from the beginning of contact to its end.  # (M, feet)
        arc: along the way between; never less.  # (M, feet)
        seconds: in contact.  # (M, feet)
    """

    straight: NDArray[np.float64]
    arc: NDArray[np.float64]
    seconds: NDArray[np.float64]

    @property
    def stands(self) -> NDArray[np.bool_]:
        """Which feet are in contact for at least one step.  # (M, feet)"""
        return self.seconds > 0.0


@dataclass(frozen=True, eq=False)
class TransitionSlide:
    """M blended transitions: what their feet slide and skate, and what they do in the motions that are blended.

    Args:
        either: of feet that stand in the source or the target.
        both: of feet that stand in both, which is beyond doubt.
        source: of the source's own feet, unblended.
        target: of the target's.
        skating: share of the steps of both feet that skate, in the blend.  # (M,)
        own_skating: mean of source and target.  # (M,)
        weighted: mean speed weighted by height, cm/s, in the blend.  # (M,)
        own_weighted: mean of source and target.  # (M,)
    """

    either: FootSlide
    both: FootSlide
    source: FootSlide
    target: FootSlide
    skating: NDArray[np.float64]
    own_skating: NDArray[np.float64]
    weighted: NDArray[np.float64]
    own_weighted: NDArray[np.float64]

    def own(self, part: str) -> NDArray[np.float64]:
        """A part of FootSlide in the capture: the mean of source and target where the foot stands.  # (M, feet)"""
        values = np.stack([getattr(self.source, part), getattr(self.target, part)])
        stands = np.stack([self.source.stands, self.target.stands])
        return (values * stands).sum(axis=0) / np.maximum(stands.sum(axis=0), 1)


def slide_of_picks(clips: Sequence[Clip], picks: Minima, metric: Metric) -> TransitionSlide:
    """Both transitions of each pick, i to j and then j to i, laid by the metric's own alignment.  # 2 M

    Raises:
        InputError: for picks without room for a blend.
    """
    source, target = np.concatenate([picks.i, picks.j]), np.concatenate([picks.j, picks.i])
    return slide_of_transitions(clips, source, target, metric.align(source, target))


def slide_of_transitions(
    clips: Sequence[Clip], source: ArrayLike, target: ArrayLike, alignment: Alignment
) -> TransitionSlide:
    """Blend each source frame's motion into the target frame's and measure its feet.

    Args:
        clips: laid end to end, of one body.
        source: frames.  # (M,)
        target: frames.  # (M,)
        alignment: how targets go onto sources.  # of (M,)

    Raises:
        InputError: for frames without room for a blend.
    """
    body, ground = clips[0].skeleton, standing_height(tuple(clips))
    before, after = runs_of(clips, source), laid(runs_of(clips, target), alignment)
    balls = [balls_of(body, runs) for runs in (blended(before, after), before, after)]
    blend, own_before, own_after = balls
    skating = [skating_steps(each, ground)[:, STEPS].mean(axis=(1, 2)) for each in balls]
    weighted = [CM * weighted_speeds(each, ground)[:, STEPS].mean(axis=(1, 2)) for each in balls]
    return TransitionSlide(
        either=foot_slide(blend[:, BLEND], (before.contacts | after.contacts)[:, BLEND]),
        both=foot_slide(blend[:, BLEND], (before.contacts & after.contacts)[:, BLEND]),
        source=foot_slide(own_before[:, BLEND], before.contacts[:, BLEND]),
        target=foot_slide(own_after[:, BLEND], after.contacts[:, BLEND]),
        skating=skating[0],
        own_skating=(skating[1] + skating[2]) / 2.0,
        weighted=weighted[0],
        own_weighted=(weighted[1] + weighted[2]) / 2.0,
    )


def balls_of(body: Skeleton, runs: Runs) -> NDArray[np.float64]:
    """Places of the balls of the feet.  # (M, RUN, feet, 3)"""
    return forward(body, runs.root_position, runs.rotations)[0][..., body.feet[:, 1], :]


def foot_slide(balls: ArrayLike, standing: ArrayLike) -> FootSlide:
    """What feet slide while they stand.

    Args:
        balls: places, metres.  # (M, F, feet, 3)
        standing: at which frames.  # (M, F, feet)
    """
    ground = CM * np.asarray(balls, dtype=np.float64)[..., [0, 2]]
    standing = np.asarray(standing, dtype=bool)
    steps = standing[:, 1:] & standing[:, :-1]
    arc = np.where(steps, np.linalg.norm(np.diff(ground, axis=1), axis=-1), 0.0)
    ends = ~np.concatenate([steps[:, 1:], np.zeros_like(steps[:, :1])], axis=1) & steps
    starts = ~np.concatenate([np.zeros_like(steps[:, :1]), steps[:, :-1]], axis=1) & steps
    straight = np.zeros(arc[:, 0].shape)
    # starts and ends of contact come by turns for each foot, so sorted by run, foot and step they pair up
    run, foot, first = np.nonzero(np.moveaxis(starts, 1, -1))
    last = np.nonzero(np.moveaxis(ends, 1, -1))[2] + 1
    np.add.at(straight, (run, foot), np.linalg.norm(ground[run, last, foot] - ground[run, first, foot], axis=-1))
    return FootSlide(straight, arc.sum(axis=1), steps.sum(axis=1) * TICK)
