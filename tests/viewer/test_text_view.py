"""The text view in a terminal of its own."""

import os
import pty
import subprocess
import sys
import termios
import time
from collections.abc import Iterator

import pytest

from footwork.protocol import messages as m
from footwork.viewer.text_map import text_map
from footwork.viewer.text_steering import TextSteering
from served import serving

SECONDS = 90.0
WELCOME = m.Welcome(
    version=1,
    tick=0,
    tick_rate=30,
    frame_rate=60,
    joints=(),
    parents=(),
    offsets=(),
    ends=(),
    behaviours=("stop", "walk", "run", "jump", "wave"),
    clips=(),
)


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    ours, theirs = pty.openpty()
    yield ours, theirs
    os.close(ours)
    os.close(theirs)


def read_until(file: int, words: bytes) -> None:
    said, end = b"", time.monotonic() + SECONDS
    while words not in said:
        assert time.monotonic() < end, said.decode(errors="replace")
        said += os.read(file, 65536)


def test_it_is_played_in_a_terminal_and_leaves_it_as_it_was(terminal):
    ours, theirs = terminal
    before = termios.tcgetattr(theirs)
    with serving() as server:
        command = [sys.executable, "-m", "footwork.cli.main", "play", server.address, "--text"]
        playing = subprocess.Popen(
            command, stdin=theirs, stdout=theirs, stderr=theirs, env=os.environ | {"TERM": "xterm"}
        )
        read_until(ours, b"position")
        os.write(ours, b"w")
        read_until(ours, b"walk")
        os.write(ours, b"q")
        assert playing.wait(SECONDS) == 0
    assert termios.tcgetattr(theirs) == before


def test_without_a_terminal_it_ends_after_its_time():
    with serving() as server:
        command = [sys.executable, "-m", "footwork.cli.main", "play", server.address, "--text", "--seconds", "0.5"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
    assert done.returncode == 0, done.stderr
    assert "behaviour" in done.stdout


def test_keys_set_what_goes_on():
    steering = TextSteering()
    assert steering.take("war", WELCOME)
    wanted = steering.wanted()
    assert isinstance(wanted, m.Keys)
    assert (wanted.forward, wanted.run) == (1, True)
    assert wanted.view_yaw > 0.0
    assert not steering.take("", WELCOME)
    assert steering.wanted() == wanted
    steering.take("2", WELCOME)
    assert steering.wanted() == (wanted.view_yaw, "wave")
    steering.take("s9x", WELCOME)
    assert steering.wanted() == m.Keys(view_yaw=wanted.view_yaw, forward=0, run=True)
    steering.take("q", WELCOME)
    assert steering.ended


def test_the_map_shows_where_one_went_and_looks():
    lines = text_map([(0.0, -1.0), (0.5, 0.0)], 0.0, 9, 5).splitlines()
    assert lines[2][4] == "↑"
    assert lines[4][6] == "·"  # a metre back is two lines down, half a metre to the right is two to the right
    assert text_map([(0.0, 0.0)], 1.5708, 9, 5).splitlines()[2][4] == "←"
    assert text_map([(0.0, 0.0)], 0.0, 41, 11).count("+") == 2
