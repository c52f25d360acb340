from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from footwork.motion.task import BEHAVIOURS
from footwork.study import measures
from footwork.study.measures import Followed

STOP, WALK, RUN, JUMP = range(4)
TICK = measures.TICK


def followed(ticks: int, **given_: Any) -> Followed:
    """A perfect follower that walks straight on, but for what is given (headings and facings in degrees)."""
    base: dict[str, Any] = (
        {"heading": 0.0, "behaviour": WALK, "jump": -1, "cost": 0.0} | {"switched": False, "turned": False} | given_
    )
    base = {"facing": base["heading"], "shown": base["behaviour"]} | base
    kinds = dict.fromkeys(("heading", "facing", "cost"), float) | {"switched": bool, "turned": bool}
    arrays = {name: np.broadcast_to(value, ticks).astype(kinds.get(name, np.int32)) for name, value in base.items()}
    arrays["heading"], arrays["facing"] = np.radians(arrays["heading"]), np.radians(arrays["facing"])
    return Followed(**arrays)


def test_a_perfect_follower_scores_one():
    heading = np.repeat([0.0, 90.0, -170.0, 120.0], 25)
    report = measures.quality(followed(100, heading=heading))
    assert [report[name] for name in ("control", "transition", "total")] == pytest.approx([1.0, 1.0, 1.0])
    assert report["heading_error_deg"]["mean"] == pytest.approx(0.0, abs=1e-9)
    assert report["transition_jumps"] is None
    settled = measures.settling(followed(100, heading=heading))
    np.testing.assert_allclose(settled.seconds, [TICK] * 3)
    assert settled.share == 1.0


def test_a_character_that_ignores_its_orders_scores_as_the_papers_say():
    """conventions.md 5: the mean of the Gaussian of 30 degrees over all headings is 0.21."""
    report = measures.quality(followed(3600, heading=np.arange(3600) / 10.0, facing=0.0))
    assert report["control"] == pytest.approx(0.209, abs=0.001)
    assert report["heading_error_deg"]["mean"] == pytest.approx(90.0, abs=0.1)


def test_control_judges_the_heading_only_where_one_walks_or_runs():
    report = followed(4, behaviour=[STOP, WALK, RUN, JUMP], heading=30.0, facing=0.0)
    np.testing.assert_allclose(report.control, [1.0, np.exp(-0.5), np.exp(-0.5), 1.0])
    np.testing.assert_array_equal(followed(4, shown=[STOP, RUN, JUMP, -1]).control, np.zeros(4))


def test_transition_charges_the_cost_of_ticks_that_switch_or_turn():
    report = measures.quality(
        followed(4, switched=[False, False, True, False], turned=[False, False, False, True], cost=[0.0, 9.0, 1.0, 2.0])
    )
    jumps = (np.exp(-1.0) + np.exp(-2.0)) / 2
    assert (report["switch_share"], report["turn_share"]) == (0.25, 0.25)
    assert report["transition_jumps"] == pytest.approx(jumps)
    assert report["transition"] == pytest.approx(0.5 + 0.5 * jumps)


def test_total_is_the_product_of_means_and_the_mean_of_products_stands_beside_it():
    report = measures.quality(followed(2, shown=[WALK, STOP], switched=[True, False], cost=1.0))
    assert report["total"] == pytest.approx(0.5 * (1 + np.exp(-1)) / 2)
    assert report["total_by_tick"] == pytest.approx(0.5 * np.exp(-1))


def test_settle_time_counts_from_the_step_to_the_first_frame_within_fifteen_degrees():
    settled = measures.settling(followed(10, heading=[0, 0, *[90] * 8], facing=[0, 0, 20, 40, 60, 74, 76, 80, 0, 0]))
    np.testing.assert_allclose(settled.seconds, [5 * TICK])
    assert settled.answered.tolist() == [True]


def test_a_heading_that_steps_again_before_it_is_reached_is_unreached_up_to_then():
    settled = measures.settling(
        followed(9, heading=[0, 90, 90, 90, 180, 180, 180, 180, 180], facing=[0] * 7 + [170] * 2)
    )
    np.testing.assert_allclose(settled.seconds, [3 * TICK, 4 * TICK])
    assert settled.answered.tolist() == [False, True]
    assert settled.share == 0.5


def test_a_heading_that_is_no_longer_asked_for_or_cut_off_by_the_end_is_unreached():
    stopped = followed(8, heading=[0, *[90] * 7], facing=0, behaviour=[WALK] * 4 + [STOP] * 4)
    np.testing.assert_allclose(measures.settling(stopped).seconds, [3 * TICK])
    cut = followed(5, heading=[0, *[90] * 4], facing=0)
    np.testing.assert_allclose(measures.settling(cut).seconds, [4 * TICK])
    assert measures.settling(cut).share == 0.0


def test_small_turns_and_turns_while_standing_are_no_step_changes():
    assert len(measures.settling(followed(20, heading=np.arange(20) * 14.0, facing=0)).seconds) == 0
    assert len(measures.settling(followed(6, heading=[0, 90, 180, 90, 0, 90], behaviour=STOP)).seconds) == 0
    assert len(measures.settling(followed(2, heading=[179, -179])).seconds) == 0


def test_latency_counts_from_the_change_of_behaviour_to_its_first_frame():
    asked = [STOP, STOP, WALK, WALK, WALK, RUN, RUN, STOP]
    late = measures.latencies(followed(8, behaviour=asked, shown=[STOP, STOP, STOP, STOP, WALK, WALK, WALK, WALK]))
    np.testing.assert_allclose(late.seconds, np.array([3, 2, 1]) * TICK)
    assert late.answered.tolist() == [True, False, False]


def test_nothing_asked_gives_none_rather_than_a_number():
    still = followed(5, behaviour=STOP)
    assert measures.latencies(still).summary() == {"mean": None, "p95": None}
    assert measures.latencies(still).share is None
    assert measures.quality(still)["heading_error_deg"] == {"mean": None, "p95": None}
    assert measures.jumps(still) == {"jumps_asked": 0, "jumps_answered": 0}


def test_a_jump_window_is_answered_by_one_frame_inside_it():
    windows = [-1, 0, 0, -1, -1, 1, 1, -1, 2]
    shown = [WALK, WALK, JUMP, JUMP, JUMP, WALK, WALK, JUMP, JUMP]
    assert measures.jumps(followed(9, jump=windows, shown=shown)) == {"jumps_asked": 3, "jumps_answered": 2}


@given(st.integers(0, 2**32 - 1), st.integers(2, 60))
def test_answers_agree_with_walking_through_the_ticks(seed, ticks):
    random = np.random.default_rng(seed)
    asked, shown = random.integers(0, 4, ticks), random.integers(-1, 4, ticks)
    late = measures.latencies(followed(ticks, behaviour=asked, shown=shown))
    seconds, answered = [], []
    for start in range(1, ticks):
        if asked[start] == asked[start - 1]:
            continue
        now = start
        while now < ticks and asked[now] == asked[start] and shown[now] != asked[start]:
            now += 1
        hit = now < ticks and asked[now] == asked[start]
        seconds.append((now - start + hit) * TICK)
        answered.append(hit)
    np.testing.assert_allclose(late.seconds, seconds)
    assert late.answered.tolist() == answered


def test_joined_traces_weigh_by_their_ticks():
    parts = [followed(10), followed(30, shown=STOP)]
    assert measures.quality(measures.joined(parts))["control"] == pytest.approx(0.25)


def test_the_behaviours_are_numbered_as_this_file_takes_them():
    assert BEHAVIOURS == ("stop", "walk", "run", "jump")
