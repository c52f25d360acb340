"""The server's socket: a ROUTER that never waits for a slow or dead peer."""

import ipaddress
import logging
import time
from enum import Enum

import zmq

from footwork.errors import InputError
from footwork.protocol.address import is_ipv6, port_fits
from footwork.runtime.authentication import Authenticator
from footwork.runtime.connections import Connections
from footwork.runtime.key_folder import KeyFolder

log = logging.getLogger(__name__)

DEFAULT_BIND = "tcp://127.0.0.1:5555"
# A peer whose frames are longer is disconnected; the codec's own limit is lower and gets an error reply.
_FRAME_BYTES = 1 << 13
SEND_QUEUE = 512
_RECEIVE_QUEUE = 512
_SEND_BUFFER = 1 << 16
_HEARTBEAT_MS = 2000
_HANDSHAKE_MS = 5000
MOST_CONNECTIONS = 1024
# A message has two frames, the peer's name and the bytes. What another has beyond a third is passed over, so many
# frames at a time, so that it holds no tick up.
_PASSED_OVER = 256
# Operators of flags are slow: each is made once.
_EVENTS, _INCOMING = int(zmq.EVENTS), int(zmq.POLLIN)
_NOBLOCK, _MORE = int(zmq.NOBLOCK), int(zmq.SNDMORE | zmq.NOBLOCK)


class Sent(Enum):
    """What became of a message."""

    QUEUED = "queued"
    DROPPED = "dropped"
    GONE = "gone"


class Router:
    """A bound ROUTER socket.

    Args:
        bind: where to listen; port 0 or ``*`` takes any free one.
        keys: let in only clients whose CURVE keys are in this folder; without it whoever reaches the address.
        most: how many connections there may be.
        send_queue: how many messages may wait for a peer before more are dropped.

    Raises:
        InputError: for an address that cannot be bound, and a folder of keys that cannot be read.
    """

    def __init__(
        self,
        bind: str = DEFAULT_BIND,
        *,
        keys: KeyFolder | None = None,
        most: int = MOST_CONNECTIONS,
        send_queue: int = SEND_QUEUE,
    ) -> None:
        if not port_fits(bind):
            raise InputError("cannot bind: a port is at most 65535", bind)
        self._context = zmq.Context()
        # From the first: a connection that its peer ends keeps what the socket was made with, however that is closed
        # later, and one that lingers for ever keeps the context from ending.
        self._context.setsockopt(zmq.LINGER, 0)
        self._socket = self._context.socket(zmq.ROUTER)
        options = {
            zmq.ROUTER_MANDATORY: 1,
            zmq.SNDHWM: send_queue,
            zmq.SNDBUF: _SEND_BUFFER,
            zmq.RCVHWM: _RECEIVE_QUEUE,
            zmq.MAXMSGSIZE: _FRAME_BYTES,
            zmq.IPV6: is_ipv6(bind),
            zmq.HEARTBEAT_IVL: _HEARTBEAT_MS,
            zmq.HEARTBEAT_TIMEOUT: 3 * _HEARTBEAT_MS,
            zmq.HANDSHAKE_IVL: _HANDSHAKE_MS,
        }
        for option, value in options.items():
            self._socket.set(option, value)
        self._authenticator = None if keys is None else self._guard(keys)
        # Without what pyzmq's own class adds, which doubles what these take: a server does little else.
        bare = super(zmq.Socket, self._socket)
        self._send, self._receive, self._get = bare.send, bare.recv, bare.get
        self.connections = Connections(self._socket, most)
        self._poller = self._watching()
        self.bytes_in = self.bytes_out = 0
        self._unread = False  # whether there may be more of a message than was read
        self._there = False  # whether a message is known to be there
        self._patience = -1  # milliseconds that a receipt waits for, where it may
        try:
            self._socket.bind(bind)
        except zmq.ZMQError as error:
            self.close()
            raise InputError(f"cannot bind: {error.strerror}, expected such as {DEFAULT_BIND}", bind) from None
        self.address = self._socket.get_string(zmq.LAST_ENDPOINT)
        if keys is None and not is_local(self.address):
            problem = "%s can be reached from other machines, and whoever reaches it may take part; --curve lets in"
            log.warning(f"{problem} those only whose keys you allow", self.address)

    def _guard(self, keys: KeyFolder) -> Authenticator:
        try:
            authenticator = Authenticator(self._context, keys)
        except InputError:
            self._socket.close(linger=0)
            self._context.term()
            raise
        authenticator.put_on(self._socket)
        return authenticator

    def socket(self, kind: int) -> zmq.Socket:
        """A socket of another kind that takes the same clients, to bind elsewhere and to close before this one."""
        socket = self._context.socket(kind)
        if self._authenticator is not None:
            self._authenticator.put_on(socket)
        return socket

    def _watching(self) -> zmq.Poller:
        poller = zmq.Poller()
        poller.register(self._socket, zmq.POLLIN)
        poller.register(self.connections.events, zmq.POLLIN)
        if self._authenticator is not None:
            poller.register(self._authenticator.socket, zmq.POLLIN)
        return poller

    def poll(self, milliseconds: int) -> bool:
        """Whether a message came in, waiting for it for at most so long."""
        end = time.monotonic() + milliseconds / 1000.0
        while True:
            ready = dict(self._poller.poll(milliseconds))
            if self.connections.events in ready:
                self.connections.follow()
            if self._authenticator is not None and self._authenticator.socket in ready:
                self._authenticator.answer()
            milliseconds = int(1000.0 * (end - time.monotonic()))
            self._there = self._socket in ready
            if self._there or milliseconds <= 0:
                return self._there

    def look(self) -> None:
        """Cut connections that are silent or pile up bytes; to be called every tick or so."""
        self.connections.look()

    def gone(self) -> list[bytes]:
        """Peers that are gone and whose messages have been taken, as far as it is known; each is told once."""
        return self.connections.gone()

    @property
    def denied(self) -> int:
        """How many were turned away for their key, or for having none."""
        return 0 if self._authenticator is None else self._authenticator.denied

    def receive(self) -> list[bytes] | None:
        """The next message's first frames, the peer's name before all; None where there is none for now."""
        if self._unread and not self._pass_over():
            return None
        if not (self._there or int(self._get(_EVENTS)) & _INCOMING):
            return None
        return self._after(self._receive(_NOBLOCK))

    def next(self, milliseconds: int) -> list[bytes] | None:
        """As ``receive``, waiting for at most so long: quicker than ``poll``, as it waits for nothing else.

        Who comes and goes meanwhile is noted by ``look``; keys are always seen to. A signal that Python handles makes
        it wait as long again.
        """
        if self._authenticator is not None or self._unread or self._there:
            return self.receive() if self.poll(milliseconds) else None
        if milliseconds != self._patience:
            self._socket.set(zmq.RCVTIMEO, milliseconds)
            self._patience = milliseconds
        try:
            peer = self._receive()
        except zmq.Again:
            return None
        return self._after(peer)

    def _after(self, peer: bytes) -> list[bytes]:
        """A message that begins with a peer's name: all of it is there once that is, a second frame always."""
        frame = self._receive(_NOBLOCK, False)
        self._there, self._unread = False, frame.more
        if not self.connections.knows(peer):
            self.connections.meet(peer, frame)
        data = frame.bytes
        self.bytes_in += len(data)
        return [peer, data, self._receive(_NOBLOCK)] if self._unread else [peer, data]

    def _pass_over(self) -> bool:
        """Pass over what is left of a message with too many frames; whether all of it is."""
        for _ in range(_PASSED_OVER):
            if not self._socket.get(zmq.RCVMORE):
                self._unread = self._there = False  # what is there may have been the rest of that message
                return True
            self._socket.recv(zmq.NOBLOCK)
        return False

    def send(self, peer: bytes, data: bytes) -> Sent:
        """Hand a message to the transport; where the peer's queue is full it is dropped."""
        try:
            self._send(peer, _MORE)
            self._send(data, _NOBLOCK)
        except zmq.Again:
            return Sent.DROPPED
        except zmq.ZMQError as error:
            if error.errno != zmq.EHOSTUNREACH:
                raise
            return Sent.GONE
        self.bytes_out += len(data)
        return Sent.QUEUED

    def close(self, linger: float = 0.0) -> None:
        """Close, giving what is queued ``linger`` seconds to leave."""
        self.connections.close()
        self._socket.close(linger=round(1000.0 * linger))
        if self._authenticator is not None:
            self._authenticator.close()
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
