"""The server's socket: a ROUTER that never waits for a slow or dead peer."""

import ipaddress
import logging
from enum import Enum

import zmq

from footwork.errors import InputError
from footwork.protocol.address import is_ipv6, port_fits

log = logging.getLogger(__name__)

DEFAULT_BIND = "tcp://127.0.0.1:5555"
# A peer whose frames are longer is disconnected; the codec's own limit is lower and gets an error reply.
_FRAME_BYTES = 1 << 16
_SEND_QUEUE = 512
_RECEIVE_QUEUE = 512
_HEARTBEAT_MS = 2000
# A message has two frames, the peer's name and the bytes. One of very many frames is read no further than this ...
_FRAMES = 3
# ... and what is left of it is passed over so many frames at a time, so that it holds no tick up.
_PASSED_OVER = 256


class Sent(Enum):
    """What became of a message."""

    QUEUED = "queued"
    DROPPED = "dropped"
    GONE = "gone"


class Router:
    """A bound ROUTER socket.

    Args:
        bind: where to listen; port 0 or ``*`` takes any free one.

    Raises:
        InputError: for an address that cannot be bound.
    """

    def __init__(self, bind: str = DEFAULT_BIND) -> None:
        if not port_fits(bind):
            raise InputError("cannot bind: a port is at most 65535", bind)
        self._context = zmq.Context()
        self._socket = self._context.socket(zmq.ROUTER)
        options = {
            zmq.ROUTER_MANDATORY: 1,
            zmq.SNDHWM: _SEND_QUEUE,
            zmq.RCVHWM: _RECEIVE_QUEUE,
            zmq.MAXMSGSIZE: _FRAME_BYTES,
            zmq.IPV6: is_ipv6(bind),
            zmq.HEARTBEAT_IVL: _HEARTBEAT_MS,
            zmq.HEARTBEAT_TIMEOUT: 3 * _HEARTBEAT_MS,
        }
        for option, value in options.items():
            self._socket.set(option, value)
        try:
            self._socket.bind(bind)
        except zmq.ZMQError as error:
            self.close()
            raise InputError(f"cannot bind: {error.strerror}, expected such as {DEFAULT_BIND}", bind) from None
        self.address = self._socket.get_string(zmq.LAST_ENDPOINT)
        if not is_local(self.address):
            log.warning("%s can be reached from other machines, and whoever reaches it may take part", self.address)

    def poll(self, milliseconds: int) -> bool:
        """Whether something came in, waiting for it for at most so long."""
        return bool(self._socket.poll(milliseconds))

    def receive(self) -> list[bytes] | None:
        """The next message's first frames, the peer's name before all; None where there is none for now."""
        if not self._pass_over():
            return None
        try:
            frames = [self._socket.recv(zmq.NOBLOCK)]
        except zmq.Again:
            return None
        while len(frames) < _FRAMES and self._socket.get(zmq.RCVMORE):
            frames.append(self._socket.recv(zmq.NOBLOCK))  # all of a message is there once its first frame is
        return frames

    def _pass_over(self) -> bool:
        """Pass over what is left of a message with too many frames; whether all of it is."""
        for _ in range(_PASSED_OVER):
            if not self._socket.get(zmq.RCVMORE):
                return True
            self._socket.recv(zmq.NOBLOCK)
        return False

    def send(self, peer: bytes, data: bytes) -> Sent:
        """Hand a message to the transport; where the peer's queue is full it is dropped."""
        try:
            self._socket.send_multipart([peer, data], zmq.NOBLOCK)
        except zmq.Again:
            return Sent.DROPPED
        except zmq.ZMQError as error:
            if error.errno != zmq.EHOSTUNREACH:
                raise
            return Sent.GONE
        return Sent.QUEUED

    def close(self, linger: float = 0.0) -> None:
        """Close, giving what is queued ``linger`` seconds to leave."""
        self._socket.close(linger=round(1000.0 * linger))
        self._context.term()


def is_local(address: str) -> bool:
    """Whether only this machine can reach an address such as ``tcp://127.0.0.1:5555``."""
    scheme, _, rest = address.partition("://")
    if scheme != "tcp":
        return scheme in ("ipc", "inproc")
    host = rest.rpartition(":")[0].strip("[]")
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
