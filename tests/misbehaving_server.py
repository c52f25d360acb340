"""A web server for tests that does what servers and those between do: cut, stall, redirect, answer with pages."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


class Misbehaving(ThreadingHTTPServer):
    """Serves one body under many paths, each in its own way; notes every request.

    Args:
        body: what the file holds.
    """

    daemon_threads = True

    def __init__(self, body: bytes) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.body = body
        self.asked: list[tuple[str, str | None]] = []

    @property
    def address(self) -> str:
        """Where it listens."""
        return f"http://127.0.0.1:{self.server_address[1]}"

    def times(self, path: str) -> int:
        """How often a path was asked for."""
        return sum(asked == path for asked, _ in self.asked)


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: Misbehaving  # type: ignore[assignment]

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        """Say nothing."""

    def do_GET(self) -> None:
        """Answer in the way that the path names."""
        wanted = self.headers.get("Range")
        self.server.asked.append((self.path, wanted))
        getattr(self, self.path.split("/")[1])(int(wanted[6:-1]) if wanted else 0)

    def answer(self, code: int, body: bytes, promised: int | None = None, **headers: str) -> None:
        self.send_response(code)
        self.send_header("Content-Length", str(len(body) if promised is None else promised))
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        self.end_headers()
        self.wfile.write(body)
        if promised is not None:
            self.close_connection = True

    def part(self, start: int, body: bytes, promised: int | None = None) -> None:
        """Answer with some of the bytes from one on."""
        whole = len(self.server.body)
        if start:
            self.answer(206, body, promised, Content_Range=f"bytes {start}-{whole - 1}/{whole}")
        else:
            self.answer(200, body, promised)

    def good(self, start: int) -> None:
        self.part(start, self.server.body[start:])

    def whole(self, start: int) -> None:
        """Knows no ranges."""
        self.answer(200, self.server.body)

    def elsewhere(self, start: int) -> None:
        """Answers a range with another one."""
        body = self.server.body
        self.answer(206 if start else 200, body, Content_Range=f"bytes 0-{len(body) - 1}/{len(body)}")

    def cut(self, start: int) -> None:
        """Breaks off after a third of the file."""
        body = self.server.body
        self.part(start, body[start : start + len(body) // 3 + 1], len(body) - start)

    def cut_whole(self, start: int) -> None:
        """Breaks off, and begins anew each time but the third."""
        body = self.server.body
        if self.server.times(self.path) < 3:
            self.answer(200, body[: len(body) // 2], len(body))
        else:
            self.answer(200, body)

    def wrong(self, start: int) -> None:
        self.answer(200, self.server.body[::-1])

    def longer(self, start: int) -> None:
        self.answer(200, self.server.body + b"x")

    def endless(self, start: int) -> None:
        """Never says how long it is."""
        self.send_response(200)
        self.end_headers()
        self.close_connection = True
        while True:
            try:
                self.wfile.write(self.server.body)
            except OSError:
                return

    def shorter(self, start: int) -> None:
        self.answer(200, self.server.body[:-1])

    def missing(self, start: int) -> None:
        self.answer(404, b"not here")

    def moody(self, start: int) -> None:
        """Overloaded at first."""
        if self.server.times(self.path) < 3:
            self.answer(503, b"later")
        else:
            self.good(start)

    def broken(self, start: int) -> None:
        self.answer(500, b"always")

    def unsatisfiable(self, start: int) -> None:
        if start:
            self.answer(416, b"")
        else:
            self.good(0)

    def page(self, start: int) -> None:
        self.answer(
            200, b"<!doctype html><title>Log in to the network</title>", Content_Type="text/html; charset=utf-8"
        )

    def slow(self, start: int) -> None:
        """Says nothing for long after its first bytes."""
        body = self.server.body
        self.send_response(206 if start else 200)
        self.send_header("Content-Length", str(len(body) - start))
        if start:
            self.send_header("Content-Range", f"bytes {start}-{len(body) - 1}/{len(body)}")
        self.end_headers()
        self.close_connection = True
        try:
            self.wfile.write(body[start : start + len(body) // 2])
            self.wfile.flush()
            time.sleep(0.6 if self.server.times(self.path) < 2 else 0.0)
            self.wfile.write(body[start + len(body) // 2 :])
        except OSError:
            return

    def onward(self, start: int) -> None:
        self.answer(302, b"", Location="/good/file")

    def astray(self, start: int) -> None:
        self.answer(302, b"", Location="ftp://127.0.0.1/file")

    def round_and_round(self, start: int) -> None:
        self.answer(302, b"", Location=self.path + "x")


@contextmanager
def misbehaving(body: bytes) -> Iterator[Misbehaving]:
    """Such a server, while it is needed."""
    server = Misbehaving(body)
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02})
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        thread.join()
        server.server_close()
