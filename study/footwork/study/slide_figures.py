"""The figures by which the foot skate of chosen transitions is told, with confidence intervals over the picks."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.study.bootstrap import Estimate, ratio, relative_difference
from footwork.study.transition_slide import FootSlide, TransitionSlide

Sums = tuple[NDArray[np.float64], NDArray[np.float64]]  # what each transition brings, and what it is divided by  # (M,)


class SlideFigure(NamedTuple):
    """A figure: its name, unit, and what transitions bring to it in the blend and in the capture they are made of."""

    name: str
    unit: str
    blend: Callable[[TransitionSlide], Sums]
    own: Callable[[TransitionSlide], Sums]


def _each_foot(part: str) -> SlideFigure:
    """Mean over (transition, foot) of the feet that stand in the source or the target."""
    name = {"straight": "start to end", "arc": "arc length"}[part]
    return SlideFigure(
        name,
        "cm",
        lambda slide: _over(getattr(slide.either, part), slide.either.stands),
        lambda slide: _over(slide.own(part), slide.source.stands | slide.target.stands),
    )


def _each_transition(name: str, unit: str, blend: str, own: str, scale: float) -> SlideFigure:
    def mean_of(part: str) -> Callable[[TransitionSlide], Sums]:
        return lambda slide: (scale * getattr(slide, part), np.ones(len(slide.skating)))

    return SlideFigure(name, unit, mean_of(blend), mean_of(own))


def _over(amount: NDArray, count: NDArray) -> Sums:
    """Sums over the feet of each transition.  # (M, feet) each"""
    return amount.sum(axis=1), count.sum(axis=1).astype(np.float64)


def _per_second(slide: FootSlide) -> Sums:
    return _over(slide.arc, slide.seconds)


def _own_per_second(slide: TransitionSlide) -> Sums:
    (arc, seconds), (more, longer) = _per_second(slide.source), _per_second(slide.target)
    return arc + more, seconds + longer


def _whole(amount: NDArray) -> Sums:
    return amount.sum(axis=1), np.ones(len(amount))


FIGURES = (
    _each_foot("straight"),
    _each_foot("arc"),
    SlideFigure(
        "arc of both feet", "cm", lambda slide: _whole(slide.either.arc), lambda slide: _whole(slide.own("arc"))
    ),
    SlideFigure("slide in contact", "cm/s", lambda slide: _per_second(slide.both), _own_per_second),
    _each_transition("skating ratio", "%", "skating", "own_skating", 100.0),
    _each_transition("weighted by height", "cm/s", "weighted", "own_weighted", 1.0),
)


def figures_of(slide: TransitionSlide) -> dict[str, tuple[Estimate, Estimate]]:
    """Each figure in the blends and in their sources.

    Args:
        slide: of both transitions of each pick, as ``slide_of_picks`` gives it; intervals are over picks.
    """
    return {
        figure.name: (ratio(*_of_picks(figure.blend(slide))), ratio(*_of_picks(figure.own(slide))))
        for figure in FIGURES
    }


def gains(slide: TransitionSlide, other: TransitionSlide, partner: NDArray[np.intp]) -> Mapping[str, Estimate]:
    """How far each figure of the blends lies above another's, as a share of it (negative: less skate).

    Args:
        slide: of both transitions of each of M picks.
        other: of both transitions of each of K others.
        partner: for each pick the other that is nearly the same, -1 for none.  # (M,)
    """
    return {
        figure.name: relative_difference(
            *_joined(_of_picks(figure.blend(slide)), _of_picks(figure.blend(other)), partner)
        )
        for figure in FIGURES
    }


def _of_picks(sums: Sums) -> Sums:
    """Both transitions of a pick as one.  # (2 M,) -> (M,)"""
    amount, count = (each.reshape(2, -1).sum(axis=0) for each in sums)
    return amount, count


def _joined(mine: Sums, others: Sums, partner: NDArray[np.intp]) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """Both metrics' picks as one list of things: an other's pick that is nearly a pick of mine joins it."""
    things, own = len(others[0]), len(mine[0])
    thing = np.where(partner >= 0, partner, things + np.arange(own))
    kept, number = np.unique(np.concatenate([np.arange(things), thing]), return_inverse=True)
    sums = np.zeros((4, len(kept)))
    for row, part in enumerate(mine):
        np.add.at(sums[row], number[things:], part)
    for row, part in enumerate(others, start=2):
        np.add.at(sums[row], number[:things], part)
    return sums[0], sums[1], sums[2], sums[3]
