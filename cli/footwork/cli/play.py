"""``footwork play``: a character that one steers oneself, in a browser or in a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from footwork.cli.live_view import live_view_files, show_live_view
from footwork.cli.served import Served, serving
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time it is imported where it is needed, so that --help loads nothing more
    from footwork.protocol.curve import CurveKeys
    from footwork.viewer.page_files import PageFile

Off = Parameter(negative=())
FIGHT_SECONDS = 60.0
_ADDRESSES = ("tcp://", "ipc://")


def play(
    target: str,
    other: str | None = None,
    /,
    *,
    text: Annotated[bool, Off] = False,
    fight: Annotated[bool, Off] = False,
    styles: str = "balanced,balanced",
    seed: int = 0,
    opponent: str | None = None,
    config: Path | None = None,
    bundle: Path | None = None,
    start: float = 0.0,
    listen: str = "127.0.0.1:0",
    host: Annotated[Sequence[str], Parameter(negative=())] = (),
    rate: int = 60,
    seconds: float | None = None,
    open_browser: Annotated[bool, Parameter(name="--open")] = True,
    key: Path | None = None,
    server_key: Path | None = None,
) -> None:
    """Play a bundle's character, or one of a server that runs, or look at a recording, until interrupted.

    Prints the address of the live view and opens it in a browser where there is a display.

    Example: footwork play walker.footwork

    Args:
        target: A bundle, a server's address such as tcp://127.0.0.1:5555, or a recording of `footwork serve --record`
            or `footwork fight --record`.
        other: Another one, to be played side by side by the same keys.
        text: Play in the terminal instead of a browser.
        fight: Watch two AI fighters on a bundle that `footwork fight` takes, of --seconds, else of a minute.
        styles: How they fight, as in `footwork fight`.
        seed: What `footwork fight` is given for the same fight; of an opponent, see `footwork serve`.
        opponent: Fight an AI of this style, on a bundle that `footwork fight` takes.
        config: Styles and rules of that fight (TOML), as in `footwork fight`.
        bundle: The bundle that a recording was made with.
        start: Where in a recording to begin, seconds; --seconds of it are shown, ten minutes at most.
        listen: Where the page is served; port 0 takes any free one. Only this machine reaches it unless told otherwise.
        host: A further name that the page may be opened by, such as game.local:8000; may be given several times.
        rate: Frames sent a second: 30, 60 or 120, where a bundle is served.
        seconds: Stop by itself after this long.
        open_browser: Open a browser; --no-open only prints the address.
        key: The secret key file of this client, for a server started with --curve.
        server_key: That server's public key file.
    """
    if seconds is not None and not seconds > 0.0:
        raise InputError(f"{seconds:g} seconds, expected more than 0", "--seconds")
    curve = _curve(key, server_key)
    recorded = _is_recorded(target, bundle)
    if fight or recorded:
        _require_only_watched(opponent, config)
        if text or other is not None:
            raise InputError("a fight or a recording is looked at alone and in a browser", target)
        if recorded:
            film = _film_of_recording(Path(target), bundle, start, seconds)
        else:
            film = _film_of_fight(_bundle(target), styles, seed, seconds)
        shown = {**live_view_files(), **_as_file(film)}
        show_live_view([], shown, listen=listen, hosts=host, open_browser=open_browser)
        return
    files = None if text else live_view_files()
    targets = [target] if other is None else [target, other]
    with _servers(targets, rate, _fight_options(opponent, config, seed)) as (addresses, served):
        if files is None:
            from footwork.viewer.text_view import TextView

            TextView(addresses[0], curve).play(seconds)
            return

        from footwork.viewer.bridge import Shown

        def look() -> None:
            for server in served:
                server.require_running()

        show_live_view(
            [Shown(_title(target), address) for target, address in zip(targets, addresses, strict=True)],
            files,
            listen=listen,
            hosts=host,
            curve=curve,
            seconds=seconds,
            open_browser=open_browser,
            look=look,
        )


def _require_only_watched(opponent: str | None, config: Path | None) -> None:
    """Refuse what is for those who fight themselves."""
    for option, given in {"--opponent": opponent, "--config": config}.items():
        if given is not None:
            raise InputError("is for a fight of one's own; one that is watched has --styles or was recorded", option)


def _fight_options(opponent: str | None, config: Path | None, seed: int) -> list[str]:
    """What makes a server of a bundle one where people fight an AI; nothing where they do not."""
    if opponent is None and config is None:
        return []
    chosen = [] if opponent is None else ["--opponent", opponent]
    return [*chosen, *([] if config is None else ["--config", str(config)]), "--seed", str(seed)]


@contextmanager
def _servers(targets: Sequence[str], rate: int, options: Sequence[str]) -> Iterator[tuple[list[str], list[Served]]]:
    """Addresses of all targets, and servers of those that are bundles."""
    with ExitStack() as held:
        addresses, served = [], []
        for target in targets:
            if not target.startswith(_ADDRESSES):
                served.append(held.enter_context(serving(_bundle(target), rate, options)))
            elif options:
                raise InputError("is for bundles; a server that runs has opponents or none", "--opponent")
            addresses.append(target if target.startswith(_ADDRESSES) else served[-1].address)
        yield addresses, served


def _film_of_fight(bundle: Path, styles: str, seed: int, seconds: float | None) -> bytes:
    from footwork.cli.fight_film import fight_film

    return fight_film(bundle, [name.strip() for name in styles.split(",")], seed, seconds or FIGHT_SECONDS)


def _film_of_recording(recording: Path, bundle: Path | None, start: float, seconds: float | None) -> bytes:
    from footwork.cli.recorded_film import recorded_film

    if bundle is None:
        raise InputError("a recording holds no motion itself, expected the bundle that it was made with", "--bundle")
    return recorded_film(recording, bundle, start, seconds)


def _is_recorded(target: str, bundle: Path | None) -> bool:
    """Whether a target is a recording; where it is not, there must be no bundle for one."""
    from footwork.cli.recorded_film import is_recording

    recorded = not target.startswith(_ADDRESSES) and is_recording(_bundle(target))
    if bundle is not None and not recorded:
        raise InputError(f"is for recordings, and {target} is none", "--bundle")
    return recorded


def _as_file(film: bytes) -> dict[str, PageFile]:
    """A film as a file of the page."""
    from footwork.viewer.bridge import FILM
    from footwork.viewer.page_files import PageFile

    return {FILM: PageFile("application/octet-stream", film)}


def _title(target: str) -> str:
    return target if target.startswith(_ADDRESSES) else Path(target).name


def _bundle(target: str) -> Path:
    path = Path(target)
    if not path.is_file():
        raise InputError(
            "no such file, expected a bundle, a recording or an address such as tcp://127.0.0.1:5555", path
        )
    return path


def _curve(key: Path | None, server_key: Path | None) -> CurveKeys | None:
    from footwork.protocol.curve import CurveKeys

    if key is None and server_key is None:
        return None
    if key is None or server_key is None:
        raise InputError("expected both or neither", "--key and --server-key")
    return CurveKeys.read(key, server_key)
