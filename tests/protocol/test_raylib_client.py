"""The example client of a game library, in a window on a virtual screen: its character is seen, and moves."""

import importlib.util
import os
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from footwork.runtime.server import Server
from toy_bundle import toy_bundle

CLIENT = Path(__file__).parents[2] / "examples" / "raylib_client.py"
LEFT, RIGHT = (92, 143, 204), (46, 72, 110)


@pytest.fixture
def screen() -> Iterator[str]:
    """The name of a virtual screen."""
    if shutil.which("Xvfb") is None or importlib.util.find_spec("raylib") is None:
        pytest.skip("Xvfb or raylib is not installed")
    command = ["Xvfb", "-displayfd", "1", "-screen", "0", "1024x768x24", "-nolisten", "tcp"]
    running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert running.stdout is not None
    yield f":{running.stdout.readline().strip()}"
    running.terminate()
    running.wait(60)


@pytest.fixture
def address() -> Iterator[str]:
    server = Server(toy_bundle(), bind="tcp://127.0.0.1:0")
    thread = threading.Thread(target=server.run)
    thread.start()
    yield server.address
    server.stop()
    thread.join()


def seen(picture: Path, colour: tuple[int, int, int]) -> np.ndarray:
    """Where a picture has a colour.  # (height, width) bool"""
    from matplotlib.image import imread

    return (np.rint(255 * imread(picture)[..., :3]) == colour).all(axis=-1)


def test_the_character_is_seen_in_the_window_and_moves(screen: str, address: str, tmp_path: Path):
    environment = os.environ | {"DISPLAY": screen, "LIBGL_ALWAYS_SOFTWARE": "1"}
    command = [sys.executable, str(CLIENT), address, "2"]
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=110, check=False
    )
    assert done.returncode == 0, done.stderr
    for colour in (LEFT, RIGHT):
        first, second = (seen(tmp_path / f"walk{number}.png", colour) for number in (1, 2))
        assert min(first.sum(), second.sum()) > 500
        assert (first != second).sum() > 0.2 * first.sum()


def test_it_is_short():
    assert len(CLIENT.read_text().splitlines()) < 100
