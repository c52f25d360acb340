"""The example clients run as they stand against a live server."""

import re
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from footwork.runtime.server import Server
from node_tools import installed
from toy_bundle import toy_bundle

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def address():
    server = Server(toy_bundle(), bind="tcp://127.0.0.1:0")
    thread = threading.Thread(target=server.run)
    thread.start()
    yield server.address
    server.stop()
    thread.join()


def run(*command: str | Path, **options) -> str:
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=110, check=False, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def node_client(tmp_path):
    """The call of the Node client, with what it needs."""
    node, folder = installed(EXAMPLES / "node", tmp_path / "node")
    return [*node, str(folder / "client.mjs")]


def test_the_node_client_walks(address, node_client):
    printed = run(*node_client, address)
    assert printed.count("21 joints") == 3
    assert len(re.findall(r"^tick \d+: at \(-?\d", printed, flags=re.MULTILINE)) == 2


def test_steer_prints_where_the_character_is(address):
    lines = run(sys.executable, EXAMPLES / "steer.py", address).splitlines()
    assert [line.split(" s  at (")[0].strip() for line in lines] == ["1.0", "2.0", "3.0"]


def test_the_bare_client_needs_nothing_of_ours_and_gets_poses(address):
    source = (EXAMPLES / "bare_client.py").read_text()
    imported = {line.split()[1] for line in source.splitlines() if line.startswith(("import ", "from "))}
    assert imported == {"math", "struct", "sys", "time", "msgpack", "zmq"}
    assert run(sys.executable, EXAMPLES / "bare_client.py", address).count("21 joints") == 3


@pytest.mark.parametrize(("script", "lines"), [("steer.py", 40), ("bare_client.py", 100), ("node/client.mjs", 100)])
def test_they_are_short(script, lines):
    assert len((EXAMPLES / script).read_text().splitlines()) < lines
