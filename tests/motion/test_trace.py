import hashlib
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.asked import askable
from footwork.motion.task import BEHAVIOURS
from footwork.motion.trace import COLUMNS, Trace, jump_windows, read_trace, steering_commands
from shared_data import TRACES, needs_traces

ALL = ("stop", "walk", "run", "jump")


def trace_of(rows: Sequence[tuple[int, int, int, float, int]]) -> Trace:
    """Rows of forward, strafe, run, turn in degrees, attack."""
    forward, strafe, run, turn, attack = np.array(rows, dtype=float).T
    return Trace("made", *(forward, strafe, run > 0, np.radians(turn), attack > 0, attack * 0 > 0))


def names(commands) -> list[str]:
    return [BEHAVIOURS[index] for index in commands.behaviour]


def test_the_latest_source_tick_not_after_each_tick_is_taken():
    # source ticks at 0, 1/35 .. 7/35; controller ticks k/30 fall on 0, 1, 2, 3, 4, 5 and then 7, for 6/30 = 7/35
    commands = steering_commands(trace_of([(1, 0, 0, 10, 0)] * 8), 0.0, ALL)
    np.testing.assert_allclose(np.degrees(commands.heading), [10, 20, 30, 40, 50, 60, 80])


def test_heading_is_the_view_from_the_own_facing_on_plus_the_direction_of_the_keys():
    rows = [(1, 0, 0, 0, 0), (0, -1, 0, 0, 0), (0, 1, 0, 0, 0), (1, 1, 0, 5, 0), (0, 0, 0, 5, 0), (-1, 0, 0, 0, 0)]
    commands = steering_commands(trace_of(rows), np.radians(30.0), ALL)
    relative = np.round(np.degrees(commands.heading) - 30.0, 9) % 360.0
    np.testing.assert_allclose(relative, [0, 90, 270, 320, 10, 190], atol=1e-9)


def test_behaviour_is_stop_walk_or_run_and_run_is_walk_without_running():
    rows = [(0, 0, 1, 0, 0), (1, 0, 0, 0, 0), (0, 1, 1, 0, 0)]
    assert names(steering_commands(trace_of(rows), 0.0, ALL)) == ["stop", "walk", "run"]
    assert names(steering_commands(trace_of(rows), 0.0, ("stop", "walk"))) == ["stop", "walk", "walk"]


def test_a_press_of_attack_opens_a_window_unless_one_opened_within_two_seconds():
    attack = np.zeros(200, dtype=bool)
    attack[[10, 40, 79, 80, 160]] = True
    windows = jump_windows(attack)
    # 79 is 69 ticks after 10; 80 is held since 79, so it is no press; 160 is the next one taken
    assert np.flatnonzero(windows == 0).tolist() == list(range(10, 22))
    assert np.flatnonzero(windows == 1).tolist() == list(range(160, 172))
    assert windows.max() == 1


def test_exactly_two_seconds_is_enough():
    attack = np.zeros(100, dtype=bool)
    attack[[0, 70]] = True
    assert jump_windows(attack).max() == 1


def test_a_jump_overrides_standing_and_walking():
    rows = [(0, 0, 0, 0, 0)] * 3 + [(0, 0, 0, 0, 1)] + [(0, 0, 0, 0, 0)] * 40
    commands = steering_commands(trace_of(rows), 0.0, ALL)
    assert names(commands)[:3] == ["stop"] * 3
    assert names(commands).count("jump") == (commands.jump == 0).sum() in (10, 11)


def write(path: Path, rows: list[str], header: str = ",".join(COLUMNS)) -> Path:
    path.write_text("\n".join([header, *rows]) + "\n")
    return path


GOOD = ["0,1,0,0,1.40625,0,0", "1,-1,1,1,-90,1,1"]


def test_a_file_is_read_whatever_the_order_of_its_columns(tmp_path):
    trace = read_trace(write(tmp_path / "a.csv", GOOD))
    assert (trace.ticks, trace.name) == (2, "a.csv")
    np.testing.assert_allclose(np.degrees(trace.yaw_delta), [1.40625, -90.0])
    mixed = [",".join(reversed(row.split(","))) for row in GOOD]
    other = read_trace(write(tmp_path / "b.csv", mixed, ",".join(reversed(COLUMNS))))
    np.testing.assert_array_equal(other.forward, trace.forward)
    np.testing.assert_array_equal(other.attack, [False, True])


@pytest.mark.parametrize(
    ("rows", "header", "said"),
    [
        (GOOD, "tick,forward,strafe", "no column run, yaw_delta_deg, attack, use, expected tick,"),
        (GOOD, ",".join([*COLUMNS[:-1], "run"]), "no column use"),
        (GOOD, ",".join([*COLUMNS, "run"]), "column run is there twice"),
        (GOOD[:1], None, "expected at least 2"),
        ([], None, "expected at least 2"),
        ([GOOD[0], "1,x,0,0,0,0,0"], None, ":3: 'x' is not a number"),
        ([GOOD[0], "1,nan,0,0,0,0,0"], None, "not a finite number"),
        ([GOOD[0], "1,0,0,0,1e999,0,0"], None, "not a finite number"),
        ([GOOD[0], "1,2,0,0,0,0,0"], None, "forward is 2, expected -1 to 1"),
        ([GOOD[0], "1,0.5,0,0,0,0,0"], None, "whole number"),
        ([GOOD[0], "1,0,0,0,181,0,0"], None, "expected -180 to 180"),
        ([GOOD[0], "1,0,0"], None, "3 cells"),
        ([*GOOD, "3,0,0,0,0,0,0"], None, ":4: tick 3, expected 2"),
        ([GOOD[0], "0,0,0,0,0,0,0"], None, "tick 0, expected 1"),
        ([*GOOD, "2,0,0,0,0,0,0", "4,0,0,0,0,0,0"], None, ":5: tick 4, expected 3"),
        (["1,0,0,0,0,0,0", "2,0,0,0,0,0,0"], None, "tick 1, expected 0"),
        (
            [f"{2 * row},0,0,0,0,0,0" for row in range(9)],
            None,
            "every row is 2 ticks on (17.5 rows a second), expected 35",
        ),
        (["0,0,0,0,0,0,0", "0.0333,0,0,0,0,0,0"], None, ":3: tick is 0.0333, expected a whole number"),
    ],
)
def test_a_bad_file_is_refused_with_its_place(tmp_path, rows, header, said):
    path = write(tmp_path / "bad.csv", rows, header or ",".join(COLUMNS))
    with pytest.raises(InputError, match=re.escape(said)) as caught:
        read_trace(path)
    assert str(path) in str(caught.value)


@pytest.mark.parametrize("data", [b"", b"\n\n", b"\xff\xfe\x00\x01", b"\0" * 50])
def test_what_is_no_table_is_refused(tmp_path, data):
    (tmp_path / "bad.csv").write_bytes(data)
    with pytest.raises(InputError):
        read_trace(tmp_path / "bad.csv")


@needs_traces
def test_recorded_players_have_the_lengths_that_their_provenance_states():
    lengths = {path.name: read_trace(path).ticks for path in TRACES.glob("*.csv")}
    assert lengths["freedoom1_demo1_p1.csv"] == 1531
    assert sum(lengths.values()) == 33506


def test_a_trace_knows_the_digest_of_its_file(tmp_path):
    path = write(tmp_path / "a.csv", GOOD)
    assert read_trace(path).digest == hashlib.sha256(path.read_bytes()).hexdigest()


def test_a_character_is_asked_to_go_on_where_it_cannot_do_what_is_asked():
    asked = np.array([BEHAVIOURS.index(name) for name in ("jump", "walk", "jump", "stop", "jump")])
    numbered = ("walk", "stop", "jump")
    for present, given in (
        (("walk", "stop"), ["stop", "walk", "walk", "stop", "stop"]),
        (("walk",), ["walk"] * 5),
        (numbered, ["jump", "walk", "jump", "stop", "jump"]),
    ):
        assert [numbered[index] for index in askable(asked, numbered, present)] == given
