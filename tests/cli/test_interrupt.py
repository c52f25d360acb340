"""An interrupted build leaves nothing half-written: no file, or the older one as it was."""

import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pty = pytest.importorskip("pty", reason="this system has no pseudo-terminals")
PATIENCE = 240.0


def interrupt_build(out: Path, stage: bytes, *options: str, motions: str = "locomotion") -> tuple[int, str]:
    """Interrupt a real build, watched at a terminal, once it shows a stage; its exit status and last words."""
    command = [sys.executable, "-m", "footwork.cli.main", "build", f"embedded:{motions}", *options, "--out", out]
    shown, hidden = pty.openpty()
    terminal = os.environ | {"COLUMNS": "120", "TERM": "xterm"}
    with subprocess.Popen(command, stderr=hidden, env=terminal, preexec_fn=interruptible) as process:
        os.close(hidden)
        try:
            read_until(shown, stage)
            process.send_signal(signal.SIGINT)
            words = read_until(shown, b"interrupted")
            status = process.wait(PATIENCE)
        finally:
            process.kill()
    os.close(shown)
    return status, words.decode().strip().splitlines()[-1].rpartition("\x1b[2K")[2]


def interruptible() -> None:
    """Take interrupts, though these tests may run behind a shell that has its children ignore them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def read_until(terminal: int, text: bytes) -> bytes:
    said, deadline = b"", time.monotonic() + PATIENCE
    while text not in said:
        assert time.monotonic() < deadline, said
        if select.select([terminal], [], [], 1.0)[0]:
            try:
                said += os.read(terminal, 1 << 16)
            except OSError:
                pytest.fail(f"ended before it said {text}: {said}")
    return said


def test_an_interrupted_build_leaves_nothing_behind(tmp_path):
    assert interrupt_build(tmp_path / "b.footwork", b"reading") == (130, "footwork: interrupted")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_search_leaves_nothing_behind(tmp_path):
    options = ("--graph", "well-connected", "--weights", "1", "--pairing", "neighbours")
    said = interrupt_build(tmp_path / "b.footwork", b"transitions", *options, motions="fighting")
    assert said == (130, "footwork: interrupted")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_build_leaves_an_older_bundle_as_it_was(tmp_path):
    out = tmp_path / "b.footwork"
    out.write_bytes(b"an older one")
    assert interrupt_build(out, b"policy") == (130, "footwork: interrupted")
    assert list(tmp_path.iterdir()) == [out]
    assert out.read_bytes() == b"an older one"
