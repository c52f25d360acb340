"""The text view in a terminal of its own."""

import io
import math
import os
import pty
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Iterator

import msgspec
import pytest
from rich.console import Console

from footwork.protocol import messages as m
from footwork.viewer.text_map import text_map
from footwork.viewer.text_steering import TextSteering
from footwork.viewer.text_view import TextView
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


def test_who_fights_steps_by_where_the_opponent_is_and_sees_how_both_fare():
    fight = msgspec.structs.replace(WELCOME, behaviours=("footwork", "attack", "evade"), opponent="patient")
    console = Console(width=80, height=30, record=True, file=io.StringIO())
    view = TextView("tcp://127.0.0.1:1", console=console)
    for character, x, health in ((0, 0.0, 1.0), (1, 2.0, 0.25)):
        view._take(pose(character, x, health))
    view._steering.take("w", fight)
    assert view._bearing() == pytest.approx(math.pi / 2)
    assert view._steering.wanted(1.5) == m.Keys(view_yaw=1.5, forward=1)
    view._steering.take("j", fight)
    assert view._steering.wanted(0.0) == (0.0, "attack")
    console.print(view._shown(fight))
    said = console.export_text()
    assert "you 100 % health" in said
    assert "patient opponent 25 % health" in said
    assert "j attack" in said
    assert "x" in said.split("from above")[1].split("step nearer")[0]


def pose(character: int, x: float, health: float) -> m.Pose:
    rest = {"acknowledged": 0, "facing": 0.0, "behaviour": 0, "clip": -1, "source_frame": 0, "transition": False}
    root = struct.pack("<3f", x, 0.9, 0.0)
    return m.Pose(tick=1, frame=1, character=character, root=root, rotations=bytes(16), health=health, **rest)
