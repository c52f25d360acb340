"""``footwork replay``: a recording once more, to the same bytes."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from footwork.cli.output import emit, log
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time it is imported where it is needed, so that --help loads no numerics
    from footwork.runtime.replay import Shown

Off = Parameter(negative=())
DEPARTED = 1


def replay(
    recording: Path,
    /,
    *,
    bundle: Path,
    verify: Annotated[bool, Off] = False,
    speed: Literal["max"] | float = "max",
    json: Annotated[bool, Off] = False,
) -> int:
    """Make a recording of `footwork serve --record` or `footwork fight --record` once more, without clients.

    The same version on the same kind of processor makes the same bytes. What it printed as the digest of all poses
    shown tells two replays apart; --verify compares the state of all characters with the one recorded, every two
    seconds and at the end.

    Example: footwork replay 20261122T141503Z-4711.footrec --bundle walker.footwork --verify

    Args:
        recording: The recording; one that was cut off by a crash is replayed up to its last whole record.
        bundle: The bundle that it was made with.
        verify: Compare states; the exit status is 1 where one differs.
        speed: How many times real time, such as 1, or max.
        json: Print what came of it as one JSON object.
    """
    from footwork.motion.bundle import read_bundle
    from footwork.runtime.fight_recording import is_fight, replay_fight
    from footwork.runtime.recording import read_recording
    from footwork.runtime.replay import Replay, processor

    if speed != "max" and not speed > 0.0:
        raise InputError(f"{speed:g}, expected max or a number above 0", "--speed")
    read = read_recording(recording)
    made_with, hold = read_bundle(bundle), None if speed == "max" else _at(speed, read.first)
    start = time.perf_counter()
    outcome = replay_fight(read, made_with, hold) if is_fight(read) else Replay(read, made_with).run(hold)
    seconds = time.perf_counter() - start
    report = {
        "ticks": outcome.ticks,
        "characters": outcome.characters,
        "commands": outcome.commands,
        "whole": read.whole,
        "states": outcome.states,
        "departed_at": outcome.departed,
        "poses": outcome.poses,
        "seconds": seconds,
        "times_real_time": outcome.ticks / 30.0 / seconds,
        "recorded_on": read.header.processor,
        "replayed_on": processor(),
    }
    emit(report, json, f"{recording}")
    if not verify or outcome.departed is None:
        return 0
    log(f"footwork: {recording}: departs after tick {outcome.agreed}, by tick {outcome.departed}")
    return DEPARTED


def _at(speed: float, first: int) -> Shown:
    """Holds a replay back to so many times real time."""
    start = time.monotonic()

    def hold(tick: int, _: object) -> None:
        time.sleep(max(0.0, start + (tick - first) / (30.0 * speed) - time.monotonic()))

    return hold
