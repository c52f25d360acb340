"""The live view from the command line: the bridge for as long as people play, and their browser opened on it."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
import webbrowser
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from footwork.cli.default_bundle import cache_folder
from footwork.cli.output import log
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed: they are an extra
    from footwork.protocol.curve import CurveKeys
    from footwork.viewer.bridge import Shown
    from footwork.viewer.page_files import PageFile

_LOOK_SECONDS = 0.3


def live_view_files() -> Mapping[str, PageFile]:
    """The page's files, fetched by npm at the first time where they were not packed.

    Raises:
        InputError: where anything that the live view needs is missing; the message says what helps.
    """
    try:
        import websockets  # noqa: F401
    except ImportError:
        raise InputError("the live view needs websockets: pip install 'footwork[view]'; or play with --text") from None
    from footwork.viewer.npm_files import NpmError, npm_files
    from footwork.viewer.page_files import page_files

    try:
        return page_files(npm_files(cache_folder()))
    except NpmError as error:
        raise InputError(f"{error}; or play with --text") from None


def show_live_view(
    servers: Sequence[Shown],
    files: Mapping[str, PageFile],
    *,
    listen: str = "127.0.0.1:0",
    hosts: Sequence[str] = (),
    curve: CurveKeys | None = None,
    seconds: float | None = None,
    open_browser: bool = True,
    look: Callable[[], None] = lambda: None,
) -> None:
    """Serve the page until interrupted.

    Args:
        servers: whose characters are shown, side by side.
        files: of the page.
        listen: host and port of the page.
        hosts: further names that the page may be opened by.
        curve: keys for servers that let in only those they know.
        seconds: for how long, where not until interrupted.
        open_browser: whether to open one, where there is a display.
        look: called now and then; what it raises ends the view.
    """
    from footwork.viewer.bridge import Bridge

    async def show() -> None:
        async with Bridge(servers, files, listen=listen, hosts=hosts, curve=curve) as bridge:
            log(f"live view at {bridge.address}")
            if open_browser and _has_display():
                webbrowser.open(bridge.address)
            await _until_interrupted(seconds, look)

    asyncio.run(show())


async def _until_interrupted(seconds: float | None, look: Callable[[], None]) -> None:
    loop, stop = asyncio.get_running_loop(), asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        loop.add_signal_handler(number, stop.set)
    end = loop.time() + seconds if seconds is not None else float("inf")
    while not stop.is_set() and loop.time() < end:
        look()
        try:
            await asyncio.wait_for(stop.wait(), min(_LOOK_SECONDS, max(0.0, end - loop.time())))
        except TimeoutError:
            continue


def _has_display() -> bool:
    return sys.platform in ("darwin", "win32") or any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))
