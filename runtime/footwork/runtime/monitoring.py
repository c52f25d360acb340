"""What watches over a server asks by HTTP: ``/health``, and ``/metrics`` in Prometheus' format.

It runs on threads of its own and only reads. Whoever reaches the address may read along, so it belongs on loopback or
in a private network.
"""

import ipaddress
import logging
import socket
import threading
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, ClassVar, Self

import msgspec

from footwork.errors import InputError
from footwork.runtime.clock import SECOND, now_ns
from footwork.runtime.metrics import exposition
from footwork.runtime.server import Server

log = logging.getLogger(__name__)

STALLED_SECONDS = 1.0
"""A server whose loop has not gone round for longer is not well."""
_PATIENCE = 5.0
_AT_ONCE = 16


def health_of(server: Server) -> dict[str, Any]:
    """Whether ticks are being made, and how many were."""
    silent = (now_ns() - server.pulse) / SECOND
    status = "ok" if silent < STALLED_SECONDS else "stalled"
    return {"status": status, "ticks": server.ticks, "seconds_since_last": round(silent, 3), **server.population()}


class Monitoring:
    """Answers over HTTP for as long as it is entered.

    Args:
        server: what is watched.
        bind: host and port such as ``127.0.0.1:9095``; port 0 takes any free one.

    Raises:
        InputError: for an address that cannot be bound.
    """

    def __init__(self, server: Server, bind: str) -> None:
        host, _, port = bind.rpartition(":")
        if not (host and port.isdecimal() and int(port) < 1 << 16):
            raise InputError(f"{bind!r}, expected an address such as 127.0.0.1:9095", "metrics")
        handler = type("_Handler", (_Handler,), {"server_watched": server, "turns": threading.Semaphore(_AT_ONCE)})
        try:
            self._http = _Quiet((host.strip("[]"), int(port)), handler)
        except OSError as error:
            raise InputError(f"cannot bind: {error.strerror or error}", bind) from None
        self.address = f"http://{host}:{self._http.server_address[1]}"

    def __enter__(self) -> Self:
        threading.Thread(target=self._http.serve_forever, name="monitoring", daemon=True).start()
        log.info("health and metrics at %s/health and %s/metrics", self.address, self.address)
        if not _is_loopback(self._http.server_address[0]):
            log.warning("whoever reaches %s may read them, expected loopback or a private network", self.address)
        return self

    def __exit__(self, *exception: object) -> None:
        self._http.shutdown()
        self._http.server_close()


class _Quiet(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False  # a peer that stalls shall not hold the server's end up

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Peers come and go; it is nobody's concern."""
        log.debug("a request of %s failed", client_address, exc_info=True)


class _Handler(BaseHTTPRequestHandler):
    timeout = _PATIENCE
    server_watched: ClassVar[Server]
    turns: ClassVar[threading.Semaphore]

    def handle(self) -> None:
        """Answer one request, unless too many are being answered."""
        if self.turns.acquire(blocking=False):
            # ``timeout`` is for each piece: who sends one byte at a time would hold a turn for ever
            patience = threading.Timer(_PATIENCE, self._hang_up)
            patience.start()
            try:
                super().handle()
            finally:
                patience.cancel()
                self.turns.release()

    def _hang_up(self) -> None:
        with suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)

    def do_GET(self) -> None:
        """Answer ``/health`` and ``/metrics``."""
        if self.path == "/health":
            health = health_of(self.server_watched)
            self._answer(200 if health["status"] == "ok" else 503, "application/json", msgspec.json.encode(health))
        elif self.path == "/metrics":
            self._answer(*self._metrics())
        else:
            self._answer(404, "text/plain", b"there are /health and /metrics\n")

    def _metrics(self) -> tuple[int, str, bytes]:
        try:
            return 200, *exposition(self.server_watched)
        except InputError as error:
            return 501, "text/plain", f"{error}\n".encode()

    def _answer(self, status: int, kind: str, body: bytes) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        """Nothing: whoever asks every second fills no log."""


def _is_loopback(host: object) -> bool:
    return ipaddress.ip_address(str(host)).is_loopback
