"""Bounds on connections that libzmq does not set by itself: how many there are, and what one may pile up.

libzmq holds the frames of a message in memory until its last one has come, without any limit: a million frames of one
byte, 3 MB sent, are 64 MB held. So a connection is cut that sends many bytes without a message becoming whole, as the
kernel counts them (TCP_INFO); whole messages cannot come in between, as frames of two messages never mix.

Monitor events and messages tell the file descriptor of a connection, which is libzmq's: it is looked at only, and shut
down through a duplicate once that is sure to be still the same connection.
"""

import logging
import socket
import struct
import sys
from dataclasses import dataclass

import zmq
from zmq.utils.monitor import parse_monitor_message

from footwork.runtime.clock import SECOND, now_ns

log = logging.getLogger(__name__)

SILENT_SECONDS = 5.0
"""Who is connected for longer without a whole message is cut."""
PILED_BYTES = 1 << 15
"""Who sends more than this without a message becoming whole is cut; at least twice what one frame may have."""
PILED_A_SECOND = 64
"""Bytes a second that may pile up besides: heartbeats are no messages, and who only listens sends nothing else."""
_LOOKED_AT = 128
"""Connections looked at in one go."""
_EVENTS_AT_ONCE = 512
_FOLLOWED = 4
"""How many times as many of them are noted at a look, for who does nothing else between two of these."""
_TCP_INFO_BYTES = 136
_RECEIVED_AT = 128  # tcpi_bytes_received, Linux 4.1 and later


@dataclass
class Connection:
    """One TCP connection.

    Args:
        descriptor: libzmq's own, never closed here.
        remote: the other end's address, None where it had gone already.
        began: monotonic nanoseconds.
        peer: the name that the ROUTER gave it, empty until its first message.
        heard: whether a message came since it was last looked at.
        received: bytes it had sent when a message last came, as far as known.
        since: monotonic nanoseconds of that.
    """

    descriptor: int
    remote: object
    began: int
    peer: bytes = b""
    heard: bool = False
    received: int | None = None
    since: int = 0


class Connections:
    """The connections of one bound socket.

    Args:
        watched: the socket, before it is bound.
        most: how many connections there may be. For another, the oldest is cut that has not said anything yet.
        silent: who is connected for so many seconds without a whole message is cut; infinite where none is expected.

    Attributes:
        cut: how many were cut.
    """

    def __init__(self, watched: zmq.Socket, most: int, silent: float = SILENT_SECONDS) -> None:
        self._watched = watched
        self._most = most
        self._silent = silent
        self.events = watched.get_monitor_socket(zmq.EVENT_ACCEPTED | zmq.EVENT_DISCONNECTED)
        self._by_descriptor: dict[int, Connection] = {}
        self._by_peer: dict[bytes, Connection] = {}
        self._gone: list[bytes] = []
        self._gone_before: list[bytes] = []
        self._next = 0
        self._told = now_ns() - 2 * SECOND
        self.cut = 0

    def __len__(self) -> int:
        return len(self._by_descriptor)

    def knows(self, peer: bytes) -> bool:
        """Note that a whole message came; whether it is known which connection the peer has."""
        connection = self._by_peer.get(peer)
        if connection is None:
            return False
        connection.heard = True
        return True

    def meet(self, peer: bytes, frame: zmq.Frame) -> None:
        """Learn from a frame of a peer's message which connection it has; other transports than TCP have none.

        Where too many came and went of late to be sure, its next message tells.
        """
        try:
            descriptor = int(frame.get("__fd"))
        except zmq.ZMQError:
            return
        # The descriptor may have been another connection's until just now: all that came and went is noted first.
        if not self.follow():
            return
        connection = self._by_descriptor.get(descriptor)
        if connection is not None:
            self._part(connection)
            connection.peer, connection.heard = peer, True
            self._by_peer[peer] = connection

    def follow(self) -> bool:
        """Take note of connections that came and went; whether of all of them."""
        for _ in range(_EVENTS_AT_ONCE):
            try:
                event = parse_monitor_message(self.events.recv_multipart(zmq.NOBLOCK))
            except zmq.Again:
                return True
            self._forget(int(event["value"]))
            if event["event"] == zmq.EVENT_ACCEPTED:
                self._begin(int(event["value"]))
        return False

    def _begin(self, descriptor: int) -> None:
        if len(self._by_descriptor) >= self._most:
            self._make_room()
        if len(self._by_descriptor) >= self._most:
            self._cut(Connection(descriptor, _remote(descriptor), now_ns()), "there are enough connections already")
        else:
            self._by_descriptor[descriptor] = Connection(descriptor, _remote(descriptor), now_ns())

    def _make_room(self) -> None:
        silent = next((one for one in self._by_descriptor.values() if not one.peer), None)
        if silent is not None:
            self._cut(silent, "there are enough connections already, and it said nothing yet")

    def _forget(self, descriptor: int) -> None:
        connection = self._by_descriptor.pop(descriptor, None)
        if connection is not None:
            self._part(connection)

    def _part(self, connection: Connection) -> None:
        if self._by_peer.pop(connection.peer, None) is not None:
            self._gone.append(connection.peer)

    def gone(self) -> list[bytes]:
        """Peers whose connection was gone at the last call already, so that their last messages have been taken."""
        told, self._gone_before, self._gone = self._gone_before, self._gone, []
        return told

    def look(self) -> None:
        """Cut those that are silent or pile up bytes; some at a time, the others at later calls."""
        for _ in range(_FOLLOWED):
            if self.follow():
                break
        descriptors = list(self._by_descriptor)
        first = self._next if self._next < len(descriptors) else 0
        self._next = first + _LOOKED_AT
        now = now_ns()
        for descriptor in descriptors[first : self._next]:
            connection = self._by_descriptor[descriptor]
            problem = self._problem(connection, now)
            if problem:
                self._cut(connection, problem)

    def forgive(self, nanoseconds: int) -> None:
        """Hold nobody to what came in, or did not, while nothing was taken for so long."""
        for connection in self._by_descriptor.values():
            connection.began += nanoseconds
            if connection.peer:
                connection.received = None

    def _problem(self, connection: Connection, now: int) -> str:
        if connection.heard:
            connection.heard, connection.received = False, None
            return ""
        if not connection.peer and now - connection.began > self._silent * SECOND:
            return f"no message in {self._silent:g} s"
        received = _received(connection.descriptor)
        if connection.received is None:
            connection.received, connection.since = received if connection.peer else 0, now
        piled = received - connection.received
        most = PILED_BYTES + PILED_A_SECOND * (now - connection.since) // SECOND
        return f"{piled} bytes and no whole message" if piled > most else ""

    def _cut(self, connection: Connection, problem: str) -> None:
        self._forget(connection.descriptor)
        self.cut += 1
        _shut(connection)
        now = now_ns()
        if now - self._told > SECOND:
            self._told = now
            log.warning("cut the connection of %s: %s; %d cut so far", connection.remote, problem, self.cut)

    def close(self) -> None:
        """Watch no more; before the socket is closed."""
        self._watched.disable_monitor()
        self.events.close(linger=0)


def _remote(descriptor: int) -> object:
    try:
        with socket.fromfd(descriptor, socket.AF_INET, socket.SOCK_STREAM) as handle:
            return handle.getpeername()
    except OSError:
        return None


def _shut(connection: Connection) -> None:
    """Shut a connection down, libzmq notices and closes it; nothing where the descriptor is another's by now."""
    try:
        with socket.fromfd(connection.descriptor, socket.AF_INET, socket.SOCK_STREAM) as handle:
            if handle.getpeername() == connection.remote:
                handle.shutdown(socket.SHUT_RDWR)
    except OSError:
        pass  # it is gone


def _received(descriptor: int) -> int:
    """Bytes that ever came in on a connection; 0 where that cannot be known (not Linux, not TCP, gone)."""
    if sys.platform != "linux":
        return 0
    try:
        handle = socket.socket(socket.AF_INET, socket.SOCK_STREAM, 0, descriptor)
    except OSError:
        return 0
    try:
        info = handle.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, _TCP_INFO_BYTES)
        return struct.unpack_from("=Q", info, _RECEIVED_AT)[0] if len(info) == _TCP_INFO_BYTES else 0
    except OSError:
        return 0
    finally:
        handle.detach()  # it is libzmq's
