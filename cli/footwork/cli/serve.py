"""``footwork serve``: the server."""

import math
import time
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from footwork.cli.output import emit, log
from footwork.errors import InputError


def serve(
    bundle: Path,
    /,
    *,
    bind: str = "tcp://127.0.0.1:5555",
    rate: int = 60,
    seconds: float | None = None,
    inertialise: bool = True,
    curve: Path | None = None,
    json: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Serve a bundle's character to game clients over ZeroMQ, until interrupted.

    Example: footwork serve walker.footwork --bind tcp://127.0.0.1:5555 --rate 60

    Args:
        bundle: The bundle to serve.
        bind: Where to listen; port 0 takes any free port. Only this machine can connect unless told otherwise.
        rate: Frames sent a second: 30, 60 or 120.
        seconds: Stop by itself after this long.
        inertialise: Smooth transitions; --no-inertialise shows the bare jumps.
        curve: Let in only clients whose keys are allowed in this folder of `footwork keys`.
        json: Print the summary as one JSON object when done.
    """
    from footwork.motion.bundle import read_bundle
    from footwork.runtime.key_folder import KeyFolder
    from footwork.runtime.server import Server
    from footwork.runtime.signals import stopped_by_signals

    if seconds is not None and not seconds > 0.0:
        raise InputError(f"{seconds:g} seconds, expected more than 0", "--seconds")
    keys = None if curve is None else KeyFolder(curve)
    server = Server(read_bundle(bundle), bind=bind, rate=rate, inertialise=inertialise, keys=keys)
    end = math.inf if seconds is None else time.monotonic() + seconds
    with stopped_by_signals(server):
        log(f"listening on {server.address}")
        server.run(until=lambda: time.monotonic() >= end)
    emit(server.summary(), json, f"{server.address}")
