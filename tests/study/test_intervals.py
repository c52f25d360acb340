import numpy as np
import pytest

from footwork.study.bootstrap import Estimate
from footwork.study.foot_slide import Slide
from footwork.study.intervals import intervals, scored_gain, total, total_gain
from footwork.study.measures import Followed, quality


def walker(good: int, ticks: int = 10, cost: float = 0.0) -> Followed:
    """Does as it is told at so many ticks, and stands at the rest."""
    zeros, no = np.zeros(ticks), np.zeros(ticks, bool)
    shown = np.where(np.arange(ticks) < good, 1, 0)
    asked, jump = np.ones(ticks, np.int32), np.full(ticks, -1)
    return Followed(zeros, asked, jump, zeros, shown, np.full(ticks, cost), no | (cost > 0.0), no)


def bounds(estimate: Estimate) -> list[float]:
    assert estimate.low is not None
    assert estimate.high is not None
    return [estimate.low, estimate.high]


def test_the_interval_of_total_holds_the_total_and_shrinks_to_it_for_equal_traces():
    parts = [walker(good) for good in (2, 4, 6, 8)]
    low, high = bounds(total(parts))
    assert low < 0.5 < high
    assert total(parts).value == pytest.approx(0.5)
    assert bounds(total([parts[0]] * 3)) == pytest.approx([0.2, 0.2])


def test_long_traces_weigh_more():
    parts = [walker(10, cost=0.5), walker(0, 30, cost=1.0)]
    transition = (10 * np.exp(-0.5) + 30 * np.exp(-1.0)) / 40
    assert total(parts).value == pytest.approx(0.25 * transition)


def test_what_two_controllers_have_in_common_does_not_widen_the_interval_of_their_difference():
    one = [walker(good) for good in (1, 4, 6, 9)]
    other = [walker(good - 1) for good in (1, 4, 6, 9)]
    gain = total_gain(one, other)
    assert gain.value == pytest.approx(0.1)
    assert bounds(gain) == pytest.approx([0.1, 0.1])
    apart = np.ptp(bounds(total(one)))
    assert apart > 0.2


def test_the_difference_is_the_same_from_reports_as_from_ticks():
    one, other = [walker(3, 10), walker(9, 20, 0.3)], [walker(2, 10, 0.1), walker(9, 20)]
    reports = [{"traces": [{"ticks": len(part.heading)} | quality(part) for part in parts]} for parts in (one, other)]
    found, known = scored_gain(reports[0], reports[1]), total_gain(one, other)
    assert [found.value, *bounds(found)] == pytest.approx([known.value, *bounds(known)])


def test_every_figure_has_its_interval_and_one_trace_has_none():
    parts, slides = [walker(3, cost=0.2), walker(8, cost=0.2)], [Slide(0.01, 1.0), Slide(0.03, 1.0)]
    found = intervals(parts, slides)
    assert found is not None
    assert found["control"] == pytest.approx([0.3, 0.8])
    assert found["transition_jumps"] == pytest.approx([np.exp(-0.2)] * 2)
    assert found["heading_error_deg"] == pytest.approx([0.0, 0.0])
    assert found["foot_slide_cm_s"] == pytest.approx([1.0, 3.0])
    assert intervals(parts[:1], slides[:1]) is None
