"""Deadlines: exact, absolute, and what happens after a stall."""

from hypothesis import given
from hypothesis import strategies as st

from footwork.runtime.clock import SECOND, FrameClock


@given(st.sampled_from([30, 60, 120]), st.integers(0, 10**12), st.integers(1, 2000))
def test_deadline_k_is_start_plus_k_over_rate_to_the_nanosecond(rate, start, frames):
    clock = FrameClock(rate, start)
    for _ in range(frames):
        clock.advance(clock.deadline)
    assert clock.deadline == start + frames * SECOND // rate
    assert clock.skipped == 0


def test_late_frames_do_not_move_the_deadlines_after_them():
    clock = FrameClock(30, 0)
    for frame in range(1, 100):
        clock.advance(clock.deadline + SECOND // 20)
        assert clock.deadline == frame * SECOND // 30


def test_a_short_stall_is_caught_up_with():
    clock = FrameClock(30, 0, patience=0.25)
    clock.advance(SECOND // 5)
    assert clock.deadline == SECOND // 30
    assert clock.skipped == 0


def test_a_long_stall_gives_up_the_deadlines_between_and_counts_them():
    clock = FrameClock(30, 0, patience=0.25)
    clock.advance(2 * SECOND)
    assert clock.skipped == 59
    assert 0 <= 2 * SECOND - clock.deadline < clock.period


def test_two_tick_rates_share_every_tick():
    slow, fast = FrameClock(30, 7), FrameClock(120, 7)
    for _ in range(1000):
        assert slow.deadline == fast.deadline
        slow.advance(0)
        for _ in range(4):
            fast.advance(0)
