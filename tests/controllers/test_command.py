import math

import numpy as np
import pytest

from footwork.controllers.command import NONE, Command, UnknownBehaviour, UnknownSpeed, Vocabulary
from footwork.errors import InputError
from footwork.motion.keys import behaviour_of_keys, heading_of_keys

ALL = ("stop", "walk", "run", "jump")
WORDS = Vocabulary(ALL, ALL)
FAST_AND_SLOW = Vocabulary(ALL, ALL, {"run": (2.0, 4.0), "walk": (0.5, 1.5)})
WALKER = Vocabulary(ALL, {"stop", "walk"})


@pytest.mark.parametrize(
    ("forward", "strafe", "degrees"),
    [
        (1, 0, 0),
        (0, -1, 90),
        (0, 1, -90),
        (-1, 0, 180),
        (1, -1, 45),
        (1, 1, -45),
        (-1, -1, 135),
        (-1, 1, -135),
        (0, 0, 0),
    ],
)
def test_keys_turn_the_view_to_the_direction_of_travel(forward, strafe, degrees):
    heading = heading_of_keys(0.3, forward, strafe)
    assert math.remainder(heading - 0.3 - math.radians(degrees), 2 * math.pi) == pytest.approx(0.0, abs=1e-12)
    assert float(heading_of_keys(0.3, float(forward), -0.0 + strafe)) == pytest.approx(float(heading))


def test_no_keys_of_either_sign_of_zero_mean_the_view_yaw():
    for forward in (0.0, -0.0):
        for strafe in (0.0, -0.0):
            assert heading_of_keys(1.25, forward, strafe) == 1.25


def test_headings_of_whole_traces_come_at_once():
    view, forward, strafe = np.array([0.0, 1.0]), np.array([1, 0]), np.array([0, -1])
    np.testing.assert_allclose(heading_of_keys(view, forward, strafe), [0.0, 1.0 + np.pi / 2])


def test_behaviour_of_keys():
    assert behaviour_of_keys(0, 0, True, ALL) == "stop"
    assert behaviour_of_keys(0, -1, False, ALL) == "walk"
    assert behaviour_of_keys(-1, 0, True, ALL) == "run"
    assert behaviour_of_keys(1, 0, True, WALKER.present) == "walk"


def test_commands_of_keys_number_the_graphs_behaviours():
    assert WORDS.of_keys(0.5, 1, 0, True) == Command(0.5, 2)
    assert WORDS.of_keys(0.5, 0, 0, True, "jump") == Command(0.5, 0, 3)
    assert WALKER.of_keys(0.5, 1, 0, True) == Command(0.5, 1)


def test_an_outright_one_shot_leaves_the_lasting_behaviour():
    assert WORDS.outright(1.0, "run") == Command(1.0, 2)
    assert WORDS.outright(1.0, "jump") == Command(1.0, NONE, 3)


def test_a_behaviour_that_no_frame_shows_is_refused_with_those_there_are():
    for ask in (lambda: WALKER.outright(0.0, "run"), lambda: WALKER.of_keys(0.0, 1, 0, False, "jump")):
        with pytest.raises(UnknownBehaviour, match=r"no behaviour '(run|jump)', it has stop, walk$"):
            ask()


def test_a_speed_is_asked_of_what_takes_one():
    assert FAST_AND_SLOW.outright(1.0, "walk", 1.1) == Command(1.0, 1, speed=1.1)
    assert FAST_AND_SLOW.outright(1.0, "stop") == Command(1.0, 0)
    for behaviour in ("stop", "jump"):
        with pytest.raises(UnknownSpeed, match=f"'{behaviour}' takes no speed, of its behaviours walk, run do"):
            FAST_AND_SLOW.outright(1.0, behaviour, 1.0)
    with pytest.raises(UnknownSpeed, match="'walk' takes no speed, of its behaviours none do"):
        WORDS.outright(1.0, "walk", 1.0)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -0.1])
def test_speeds_are_finite_and_not_below_nothing(bad):
    with pytest.raises(InputError, match="speed is"):
        FAST_AND_SLOW.outright(0.0, "walk", bad)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_headings_must_be_finite(bad):
    with pytest.raises(InputError, match="heading"):
        WORDS.outright(bad, "walk")
    with pytest.raises(InputError, match="view_yaw"):
        WORDS.of_keys(bad, 1, 0, False)


def test_keys_ask_for_the_middle_of_the_speeds_that_there_are():
    assert FAST_AND_SLOW.of_keys(0.0, 1, 0, run=False).speed == 1.0
    assert FAST_AND_SLOW.of_keys(0.0, 1, 0, run=True).speed == 3.0
    assert FAST_AND_SLOW.of_keys(0.0, 0, 0, run=False).speed is None
    assert WORDS.of_keys(0.0, 1, 0, run=False).speed is None
