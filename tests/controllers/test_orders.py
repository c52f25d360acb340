import numpy as np

from footwork.controllers.command import NONE, Command
from footwork.controllers.orders import HOLD_TICKS, LATCH_TICKS, Orders

STOP, WALK, RUN, JUMP, DUCK = range(5)


def asked(orders: Orders, shown: int) -> int:
    return int(orders.at_tick(np.array([shown]))[0])


def walking() -> Orders:
    orders = Orders(1)
    orders.begin(0, 0.0, WALK)
    return orders


def test_a_one_shot_is_asked_for_until_it_has_been_shown_for_a_third_of_a_second():
    orders = walking()
    orders.give(0, Command(0.5, WALK, JUMP), shown=WALK)
    orders.give(0, Command(0.7, RUN), shown=WALK)
    assert [asked(orders, WALK) for _ in range(5)] == [JUMP] * 5
    assert [asked(orders, JUMP) for _ in range(HOLD_TICKS + 3)] == [JUMP] * HOLD_TICKS + [RUN] * 3
    assert asked(orders, WALK) == RUN
    assert orders.heading[0] == 0.7


def test_a_one_shot_that_was_left_is_over():
    orders = walking()
    orders.give(0, Command(0.5, WALK, JUMP), shown=WALK)
    assert [asked(orders, shown) for shown in (WALK, JUMP, WALK, JUMP)] == [JUMP, JUMP, WALK, WALK]


def test_a_one_shot_waits_for_a_second_at_most():
    orders = walking()
    orders.give(0, Command(0.0, WALK, JUMP), shown=WALK)
    assert [asked(orders, WALK) for _ in range(LATCH_TICKS + 2)] == [JUMP] * 30 + [WALK] * 2


def test_a_one_shot_is_ignored_while_the_character_is_in_it():
    orders = walking()
    orders.give(0, Command(0.0, WALK, JUMP), shown=JUMP)
    assert asked(orders, WALK) == WALK


def test_a_key_that_stays_down_asks_once():
    orders = walking()
    for _ in range(3):
        orders.give(0, Command(0.0, WALK, JUMP), shown=WALK)
    assert [asked(orders, JUMP) for _ in range(HOLD_TICKS + 1)][-1] == WALK
    orders.give(0, Command(0.0, WALK, JUMP), shown=WALK)
    assert asked(orders, WALK) == WALK
    orders.give(0, Command(0.0, WALK), shown=WALK)
    orders.give(0, Command(0.0, WALK, JUMP), shown=WALK)
    assert asked(orders, WALK) == JUMP


def test_the_last_one_shot_asked_for_counts():
    orders = walking()
    orders.give(0, Command(0.0, WALK, JUMP), shown=WALK)
    orders.give(0, Command(0.0, NONE, DUCK), shown=WALK)
    assert asked(orders, WALK) == DUCK
    assert [asked(orders, DUCK) for _ in range(HOLD_TICKS + 1)] == [DUCK] * HOLD_TICKS + [WALK]


def test_characters_wait_apart_and_a_new_one_begins_afresh():
    orders = Orders(2)
    orders.give(0, Command(0.0, WALK, JUMP), shown=WALK)
    assert orders.at_tick(np.array([WALK, STOP])).tolist() == [JUMP, STOP]
    orders.begin(0, 1.0, STOP)
    assert orders.at_tick(np.array([WALK, STOP])).tolist() == [STOP, STOP]
    assert orders.heading.tolist() == [1.0, 0.0]


def speed_asked(orders: Orders, shown: int) -> float:
    orders.at_tick(np.array([shown]))
    return float(orders.in_force.asked_speed[0])


def test_a_speed_holds_until_the_next_behaviour_is_asked_for_and_not_while_a_one_shot_is():
    orders = walking()
    assert np.isnan(speed_asked(orders, WALK))
    orders.give(0, Command(0.0, WALK, speed=1.1), shown=WALK)
    assert [speed_asked(orders, WALK) for _ in range(3)] == [1.1] * 3
    orders.give(0, Command(0.0, NONE, JUMP), shown=WALK)
    assert np.isnan(speed_asked(orders, WALK))
    assert [speed_asked(orders, JUMP) for _ in range(HOLD_TICKS + 1)][-1] == 1.1
    orders.give(0, Command(0.0, RUN), shown=WALK)
    assert np.isnan(speed_asked(orders, WALK))
