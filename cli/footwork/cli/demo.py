"""``footwork demo``: the main job in one go."""

from __future__ import annotations

import json as json_module
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from footwork.cli.default_bundle import build_or_reuse, cache_folder
from footwork.cli.motions import AS_USUAL, Reading, load_motions
from footwork.cli.output import emit, log, progress
from footwork.errors import FootworkError, InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.cli.scripted_player import Played
    from footwork.motion.bundle import Bundle


def demo(
    *,
    headless: bool = False,
    seconds: float = 10.0,
    motions: str = "embedded:locomotion",
    reading: Reading = AS_USUAL,
    rate: int = 60,
    cache: Path | None = None,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Build or reuse a bundle, serve it, and drive its character over a real socket with a scripted player.

    Example: footwork demo --headless --seconds 5 --json

    Args:
        headless: Without the live view. So far there is none, so this is always the case.
        seconds: How long to play.
        motions: A folder of capture in place of the embedded motions.
        reading: How that folder is read.
        rate: Frames sent a second: 30, 60 or 120.
        cache: Where to keep the bundle, in place of the user's cache folder.
        json: Print the summary as one JSON object.
    """
    if not 0.5 <= seconds <= 3600.0:
        raise InputError(f"{seconds:g} seconds, expected 0.5 to 3600", "--seconds")
    with progress() as report_progress:
        report_progress("reading motions", 0.0)
        dataset = load_motions(motions, reading)
        path, bundle = build_or_reuse(dataset, cache or cache_folder(), report_progress)
    log(f"bundle {path}")
    with _serving(path, rate) as server:
        played = play_at(server.address, seconds)
    emit(_summary(bundle, server.summary, played), json, "footwork demo")


def play_at(address: str, seconds: float) -> Played:
    """Play the script as a client of the server at ``address``."""
    from footwork.cli.scripted_player import play
    from footwork.protocol.client import Client

    log(f"a scripted player steers for {seconds:g} s at {address}")
    with Client(address, name="scripted player", timeout=30.0) as client:
        return play(client, seconds)


class _Server:
    """``footwork serve`` in a process of its own, as any user would start it."""

    def __init__(self, bundle: Path, rate: int) -> None:
        command = [sys.executable, "-m", "footwork.cli.main", "serve", str(bundle), "--rate", str(rate), "--json"]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        self._process = subprocess.Popen([*command, "--bind", "tcp://127.0.0.1:0"], **pipes)  # noqa: S603 our own command
        self.address = self._listening()
        self.summary: dict[str, Any] = {}

    def _listening(self) -> str:
        said = []
        for line in self._process.stderr:  # type: ignore[union-attr]
            if line.startswith("listening on "):
                return line.removeprefix("listening on ").strip()
            said.append(line)
        raise FootworkError(f"the server did not start: {''.join(said).strip() or 'it said nothing'}")

    def stop(self) -> None:
        self._process.terminate()
        try:
            out, complaints = self._process.communicate(timeout=20.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise FootworkError("the server did not stop within 20 s") from None
        if self._process.returncode != 0:
            raise FootworkError(f"the server failed: {complaints.strip()}")
        self.summary = json_module.loads(out)


@contextmanager
def _serving(bundle: Path, rate: int) -> Iterator[_Server]:
    server = _Server(bundle, rate)
    try:
        yield server
    finally:
        server.stop()


def _summary(bundle: Bundle, server: Mapping[str, Any], played: Played) -> dict[str, object]:
    counts = bundle.provenance["counts"]
    return {
        "frames": counts["frames"],
        "nodes": counts["nodes"],
        "edges": counts["edges"],
        "scc_fraction": counts["scc_nodes"] / counts["frames"],
        "ticks": server["ticks"],
        "late_ticks": server["late_ticks"],
        "tick_us": {name: server["tick_us"][name] for name in ("p50", "p99")},
        "command_to_pose_ms": _percentiles(played.command_to_pose_ms),
        "heading_error_deg": _error(played.heading_error_deg),
        "poses": played.poses,
        "travelled_m": played.travelled_m,
    }


def _percentiles(values: Sequence[float]) -> dict[str, float]:
    return {"p50": _percentile(values, 50), "p99": _percentile(values, 99)}


def _error(values: Sequence[float]) -> dict[str, float]:
    return {"mean": fmean(values) if values else 0.0, "p95": _percentile(values, 95)}


def _percentile(values: Sequence[float], percent: int) -> float:
    import numpy as np

    return float(np.percentile(values, percent)) if values else 0.0
