"""Between browsers and a server: serves the page over HTTP, and to each page a session of its own over a WebSocket."""

import http
import json
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple, Self

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from footwork.errors import InputError
from footwork.protocol.curve import CurveKeys
from footwork.viewer.allowed_hosts import AllowedHosts
from footwork.viewer.page import FloodError, Page, told
from footwork.viewer.page_files import PageFile
from footwork.viewer.server_link import ServerLink

SOCKET = "/socket/"
"""Where a page's WebSocket connects, followed by the number of the server."""
ABOUT = "/about.json"
"""Where the page asks whom it shows."""
FILM = "/film.msgpack"
"""Where a film lies that is shown in place of what servers do."""
CHARACTERS = 8
# The protocol's limit is 1,024, which is answered; beyond this a connection is closed.
_MOST_BYTES = 8192
_TRY_LATER, _TOO_MUCH = 1013, 1008
_HEADERS = {
    "Content-Security-Policy": "default-src 'self'; img-src 'self' blob:; frame-ancestors 'none'; base-uri 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-cache",
}


class Shown(NamedTuple):
    """A server whose character is played: a title for people, and its address."""

    title: str
    address: str


class Bridge:
    """Listens as long as its ``async with`` block lasts.

    Args:
        servers: whose characters a page shows side by side, all by the same keys.
        files: the page's files by their path.
        listen: host and port, such as ``127.0.0.1:0``; port 0 takes any free one.
        hosts: further names that the page may be opened by, such as ``game.local:8000``.
        characters: how many may be played at once over all pages; one more is refused with a message.
        curve: keys for a server that lets in only those it knows.

    Attributes:
        address: of the page, such as ``http://127.0.0.1:34567/``.

    Raises:
        InputError: on entering, for a host and port where nothing can listen.
    """

    def __init__(
        self,
        servers: Sequence[Shown],
        files: Mapping[str, PageFile],
        *,
        listen: str = "127.0.0.1:0",
        hosts: Iterable[str] = (),
        characters: int = CHARACTERS,
        curve: CurveKeys | None = None,
    ) -> None:
        titles = [server.title for server in servers]
        about = json.dumps({"titles": titles, "film": FILM if FILM in files else None}).encode()
        self._files = dict(files) | {ABOUT: PageFile("application/json", about)}
        self._servers = {f"{SOCKET}{number}": server.address for number, server in enumerate(servers)}
        self._listen, self._curve = listen, curve
        self._host, self._port = host_and_port(listen)
        self._more_hosts, self._most, self._played = tuple(hosts), characters, 0
        self.address = ""

    async def __aenter__(self) -> Self:
        options = {"max_size": _MOST_BYTES, "max_queue": 64, "compression": None, "close_timeout": 1.0}
        answering = serve(self._play, self._host, self._port, process_request=self._answer, **options)
        try:
            self._listening: Server = await answering
        except (OSError, OverflowError) as error:
            problem = getattr(error, "strerror", None) or str(error)
            raise InputError(f"{problem}, expected such as 127.0.0.1:0", self._listen) from None
        port = self._listening.sockets[0].getsockname()[1]
        self._hosts = AllowedHosts(port, self._more_hosts)
        shown = f"[{self._host}]" if ":" in self._host else self._host
        self.address = f"http://{shown}:{port}/"
        return self

    async def __aexit__(self, *exception: object) -> None:
        self._listening.close()
        await self._listening.wait_closed()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """The answer to a request over HTTP, None for a page's socket to be opened."""
        if not self._hosts.has_host(_only(request.headers, "Host")):
            return _said(http.HTTPStatus.FORBIDDEN, f"this page is at {self._hosts}, nowhere else\n")
        path = _path(request)
        if path not in self._servers:
            return self._file(path)
        if not self._hosts.has_origin(_only(request.headers, "Origin")):
            return _said(http.HTTPStatus.FORBIDDEN, f"only pages of {self._hosts} may play here\n")
        return None

    def _file(self, path: str) -> Response:
        file = self._files.get(path)
        if file is None:
            return _said(http.HTTPStatus.NOT_FOUND, "no such file\n")
        return _response(http.HTTPStatus.OK, file.media_type, file.content)

    async def _play(self, socket: ServerConnection) -> None:
        if self._played >= self._most:
            await socket.send(told("refused", f"{self._most} characters are being played, which is all that may be"))
            await socket.close(_TRY_LATER, "too many pages")
            return
        self._played += 1
        try:
            address = self._servers[_path(socket.request)]
            await Page(socket, ServerLink(address, "live view", self._curve)).play()
        except FloodError:
            await socket.close(_TOO_MUCH, "too many messages")
        finally:
            self._played -= 1


def host_and_port(listen: str) -> tuple[str, int]:
    """The parts of ``HOST:PORT``; an IPv6 host stands in brackets.

    Raises:
        InputError: for anything else.
    """
    host, _, port = listen.rpartition(":")
    if not host or not port.isdecimal() or int(port) > 65535:
        raise InputError("expected HOST:PORT, such as 127.0.0.1:0", repr(listen))
    return host.strip("[]"), int(port)


def _path(request: Request | None) -> str:
    return "" if request is None else request.path.partition("?")[0]


def _only(headers: Headers, name: str) -> str | None:
    """The value of a header that stands there once."""
    values = headers.get_all(name)
    return values[0] if len(values) == 1 else None


def _said(status: http.HTTPStatus, text: str) -> Response:
    return _response(status, "text/plain; charset=utf-8", text.encode())


def _response(status: http.HTTPStatus, media_type: str, content: bytes) -> Response:
    about = {"Content-Type": media_type, "Content-Length": str(len(content)), "Connection": "close"}
    return Response(status.value, status.phrase, Headers(_HEADERS | about), content)
