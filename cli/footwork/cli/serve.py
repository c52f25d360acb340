"""``footwork serve``: the server."""

from __future__ import annotations

import logging
import math
import time
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from footwork.cli.default_bundle import cache_folder
from footwork.cli.output import compiling, emit, log
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time it is imported where it is needed, so that --help loads no numerics
    from footwork.motion.bundle import Bundle
    from footwork.runtime.monitoring import Monitoring
    from footwork.runtime.opponent import Opponent
    from footwork.runtime.server import Server

Off = Parameter(negative=())
_MOST_SEED = 2**32


def serve(
    *bundles: str,
    bind: str = "tcp://127.0.0.1:5555",
    rate: int = 60,
    seconds: float | None = None,
    inertialise: bool = True,
    lock_step: Annotated[bool, Off] = False,
    spectate: str | None = None,
    record: Path | None = None,
    opponent: str | None = None,
    config: Path | None = None,
    seed: int = 0,
    curve: Path | None = None,
    metrics: str | None = None,
    watch: Annotated[bool, Off] = False,
    shared: Annotated[bool, Off] = False,
    realtime: Annotated[bool, Off] = False,
    log_format: Annotated[Literal["text", "json"] | None, Parameter(name="--log")] = None,
    json: Annotated[bool, Off] = False,
) -> None:
    """Serve the characters of a bundle, or of several, to game clients over ZeroMQ, until interrupted.

    SIGTERM ends it with a bye to all clients; SIGHUP lets it read the bundles again and go on with those.

    Example: footwork serve walker.footwork --bind tcp://127.0.0.1:5555 --rate 60

    Args:
        bundles: What to serve: files, or NAME=FILE; clients that name no bundle play the first. Without NAME it is the
            file's own name without its ending.
        bind: Where to listen; port 0 takes any free port. Only this machine can connect unless told otherwise.
        rate: Frames sent a second: 30, 60 or 120.
        seconds: Stop by itself after this long.
        inertialise: Smooth transitions; --no-inertialise shows the bare jumps.
        lock_step: Make ticks when the clients ask for them, not by a clock.
        spectate: Where spectators may watch all characters, such as tcp://127.0.0.1:5556.
        record: Record what takes effect, for `footwork replay`, into a new file in this folder.
        opponent: Let every character fight an AI of this style, as in `footwork fight`; for bundles of fighters.
        config: Styles and rules of those fights (TOML), as in `footwork fight`.
        seed: Where opponents begin and what they make of chance.
        curve: Let in only clients whose keys are allowed in this folder of `footwork keys`.
        metrics: Answer /health and /metrics (Prometheus) over HTTP here, such as 127.0.0.1:9095.
        watch: Read a bundle again whenever its file is replaced, as at SIGHUP.
        shared: Keep bundles in memory that all servers on this machine share which serve the same ones.
        realtime: Take real-time priority and keep memory from being swapped out, where the system permits it.
        log_format: Log what happens on stderr, as text or one JSON object a line; otherwise only warnings.
        json: Print the summary as one JSON object when done.
    """
    from footwork.cli.named_bundles import named_bundles
    from footwork.runtime.key_folder import KeyFolder
    from footwork.runtime.logs import logging_to_stderr
    from footwork.runtime.realtime import take_realtime
    from footwork.runtime.reload import Reloader
    from footwork.runtime.server import Server
    from footwork.runtime.signals import answering_signals

    if seconds is not None and not seconds > 0.0:
        raise InputError(f"{seconds:g} seconds, expected more than 0", "--seconds")
    opponents = _opponents(opponent, config, seed)
    paths = named_bundles(bundles)
    with ExitStack() as held:
        if log_format is not None:
            held.enter_context(logging_to_stderr(log_format))
        read = _read_shared if shared else _read
        tell = log if log_format is None else logging.getLogger(__name__).info
        with compiling(tell):
            server = Server(
                {name: read(path) for name, path in paths.items()},
                bind=bind,
                rate=rate,
                inertialise=inertialise,
                lockstep=lock_step,
                spectate=spectate,
                keys=None if curve is None else KeyFolder(curve),
                record=record,
                opponent=opponents,
            )
        if metrics is not None:
            held.enter_context(_monitored(server, metrics))
        reloader = held.enter_context(Reloader(server, paths, read=read, watch=watch))
        for problem in take_realtime() if realtime else ():
            tell(problem)
        held.enter_context(answering_signals(server, reloader.ask))
        tell(f"listening on {server.address}")
        if server.gallery_address is not None:
            tell(f"spectators at {server.gallery_address}")
        end = math.inf if seconds is None else time.monotonic() + seconds
        server.run(until=lambda: time.monotonic() >= end)
    emit(server.summary(), json, f"{server.address}")


def _opponents(style: str | None, config: Path | None, seed: int) -> Opponent | None:
    from footwork.runtime.opponent import opponent_named

    if style is None:
        if config is not None:
            raise InputError("is of fights, expected --opponent too", "--config")
        return None
    if not 0 <= seed <= _MOST_SEED:
        raise InputError(f"{seed}, expected 0 to {_MOST_SEED}", "--seed")
    return opponent_named(style, config, seed)


def _monitored(server: Server, address: str) -> Monitoring:
    """Health and metrics of a server; where they cannot be served, it ends what it began."""
    from footwork.runtime.monitoring import Monitoring

    try:
        return Monitoring(server, address)
    except InputError:
        server.close()
        raise


def _read(path: Path) -> Bundle:
    from footwork.motion.bundle import read_bundle

    return read_bundle(path)


def _read_shared(path: Path) -> Bundle:
    from footwork.runtime.shared_bundle import shared_bundle

    return shared_bundle(path, cache_folder() / "served")
