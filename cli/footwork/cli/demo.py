"""``footwork demo``: the main job in one go."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from footwork.cli.default_bundle import build_or_reuse, cache_folder
from footwork.cli.live_view import live_view_files, show_live_view
from footwork.cli.motions import AS_USUAL, Reading, load_motions
from footwork.cli.output import emit, log, progress
from footwork.cli.served import serving
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help answers at once
    from footwork.cli.scripted_player import Played
    from footwork.motion.bundle import Bundle


SCRIPT_SECONDS = 10.0


def demo(
    *,
    headless: bool = False,
    seconds: float | None = None,
    motions: str = "embedded:locomotion",
    reading: Reading = AS_USUAL,
    rate: int = 60,
    cache: Path | None = None,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Build or reuse a bundle, serve it, and let one play: in a browser, or in the terminal where npm is missing.

    Without a terminal, or with --headless or --json, a scripted player drives the character over a real socket, and
    what came of it is printed.

    Example: footwork demo --headless --seconds 5 --json

    Args:
        headless: Let the scripted player play.
        seconds: How long to play; 10 for the scripted player, until interrupted in the live view, unless given.
        motions: A folder of capture in place of the embedded motions.
        reading: How that folder is read.
        rate: Frames sent a second: 30, 60 or 120.
        cache: Where to keep the bundle, in place of the user's cache folder.
        json: Print the summary as one JSON object.
    """
    if seconds is not None and not 0.5 <= seconds <= 3600.0:
        raise InputError(f"{seconds:g} seconds, expected 0.5 to 3600", "--seconds")
    with progress() as report_progress:
        report_progress("reading motions", 0.0)
        dataset = load_motions(motions, reading)
        path, bundle = build_or_reuse(dataset, cache or cache_folder(), report_progress)
    log(f"bundle {path}")
    if not headless and not json and sys.stdin.isatty() and sys.stdout.isatty():
        _let_play(path, rate, seconds)
        return
    with serving(path, rate) as server:
        played = play_at(server.address, seconds or SCRIPT_SECONDS)
    emit(_summary(bundle, server.summary, played), json, "footwork demo")


def _let_play(bundle: Path, rate: int, seconds: float | None) -> None:
    """The live view, or the text view where something that the former needs is missing."""
    try:
        files = live_view_files()
    except InputError as missing:
        log(str(missing))
        log("playing in the terminal instead")
        files = None
    with serving(bundle, rate) as server:
        if files is None:
            from footwork.viewer.text_view import TextView

            TextView(server.address).play(seconds)
        else:
            from footwork.viewer.bridge import Shown

            shown = [Shown("the demo's character", server.address)]
            show_live_view(shown, files, seconds=seconds, look=server.require_running)


def play_at(address: str, seconds: float) -> Played:
    """Play the script as a client of the server at ``address``."""
    from footwork.cli.scripted_player import play
    from footwork.protocol.client import Client

    log(f"a scripted player steers for {seconds:g} s at {address}")
    with Client(address, name="scripted player", timeout=30.0) as client:
        return play(client, seconds)


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
