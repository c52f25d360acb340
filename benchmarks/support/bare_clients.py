"""DEALER clients on bare TCP sockets: many of them take little of the cores that they share with the server."""

import select
import socket
import struct
from collections.abc import Iterator, Sequence
from typing import Generic, TypeVar

_GREETING = bytes([0xFF, *[0] * 8, 0x7F, 3, 1]) + b"NULL".ljust(20, b"\0") + bytes(32)
_READY = b"\x05READY\x0bSocket-Type\x00\x00\x00\x06DEALER\x08Identity\x00\x00\x00\x00"
_LONG, _COMMAND = 2, 4  # flags of a frame
_PING_HEAD = 7  # its name and how long the other end waits
_READ = 1 << 16


class BareClient:
    """One connection that speaks ZMTP 3.1 (rfc.zeromq.org/spec/37), without security.

    Args:
        address: of a ROUTER, such as ``tcp://127.0.0.1:5555``.
    """

    def __init__(self, address: str) -> None:
        host, _, port = address.removeprefix("tcp://").rpartition(":")
        self.socket = socket.create_connection((host, int(port)))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.sendall(_GREETING)
        self._pending = b""
        while len(self._pending) < len(_GREETING):
            self._pending += self.socket.recv(_READ)
        self._pending = self._pending[len(_GREETING) :]
        self._send(_COMMAND, _READY)
        self.socket.setblocking(False)

    def send(self, message: bytes) -> None:
        """Send a message of one frame, shorter than 256 bytes."""
        self._send(0, message)

    def _send(self, flags: int, body: bytes) -> None:
        self.socket.sendall(bytes([flags, len(body)]) + body)

    def take(self) -> list[bytes]:
        """The messages that have come in.

        Raises:
            ConnectionError: where the server has closed the connection.
        """
        data = self.socket.recv(_READ)
        if not data:
            raise ConnectionError("the server has closed the connection")
        data, messages, at = self._pending + data, [], 0
        while (ends := _frame(data, at)) is not None:
            flags, body, at = data[at], data[ends[0] : ends[1]], ends[1]
            if not flags & _COMMAND:
                messages.append(body)
            elif body.startswith(b"\x04PING"):
                self._send(_COMMAND, b"\x04PONG" + body[_PING_HEAD:])
        self._pending = data[at:]
        return messages


def _frame(data: bytes, at: int) -> tuple[int, int] | None:
    """Where the body of the frame at a place begins and ends; None while it is not whole."""
    if len(data) < at + 2:
        return None
    if not data[at] & _LONG:
        start, size = at + 2, data[at + 1]
    elif len(data) < at + 9:
        return None
    else:
        start, size = at + 9, struct.unpack_from(">Q", data, at + 1)[0]
    return (start, start + size) if start + size <= len(data) else None


_Client = TypeVar("_Client", bound=BareClient)


class Readable(Generic[_Client]):
    """Tells which of some clients have something to read."""

    def __init__(self, clients: Sequence[_Client]) -> None:
        self._poll = select.epoll()
        self._clients = {client.socket.fileno(): client for client in clients}
        for descriptor in self._clients:
            self._poll.register(descriptor, select.EPOLLIN)

    def forget(self, client: _Client) -> None:
        """Tell of a client no more."""
        self._poll.unregister(client.socket)

    def wait(self, seconds: float) -> Iterator[_Client]:
        """Those, after at most so long."""
        for descriptor, _ in self._poll.poll(seconds):
            yield self._clients[descriptor]
