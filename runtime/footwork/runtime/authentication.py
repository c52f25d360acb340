"""Who may come in: answers libzmq's question (ZAP, ZeroMQ RFC 27) whether a client's CURVE key is allowed.

libzmq asks over an in-process socket once a client has proven that it holds its secret key, and lets nothing of the
client through before it has the answer. The router answers between messages, on its own thread.
"""

import logging

import zmq
from zmq.utils import z85

from footwork.errors import InputError
from footwork.protocol.curve import KeyPair
from footwork.runtime.clock import SECOND, now_ns
from footwork.runtime.key_folder import KeyFolder

log = logging.getLogger(__name__)

_ENDPOINT = "inproc://zeromq.zap.01"
_VERSION = b"1.0"
_DOMAIN = b"footwork"
_AT_ONCE = 16
"""Questions answered before messages get their turn again."""
_LOOK_EVERY = SECOND // 2


class Authenticator:
    """Answers for one context's sockets from a folder of keys.

    What is changed in the folder counts for connections that begin half a second later, or sooner. While it cannot be
    read, nobody new is let in.

    Args:
        context: of the sockets that it answers for; before any of them is bound.
        keys: the folder.

    Attributes:
        denied: how many were turned away.

    Raises:
        InputError: for a folder that cannot be read.
    """

    def __init__(self, context: zmq.Context, keys: KeyFolder) -> None:
        self._keys = keys
        self._allowed = keys.allowed()
        self._looked = now_ns()
        self._told = self._looked - 2 * SECOND
        self.socket = context.socket(zmq.REP)
        self.socket.bind(_ENDPOINT)
        self.denied = 0

    def put_on(self, socket: zmq.Socket) -> None:
        """Let a socket take clients with an allowed key only; before it is bound."""
        pair: KeyPair = self._keys.pair
        socket.set(zmq.CURVE_SERVER, 1)
        socket.set(zmq.CURVE_SECRETKEY, pair.secret)
        socket.set(zmq.ZAP_DOMAIN, _DOMAIN)

    def answer(self) -> None:
        """Answer the questions that wait, or as many as may be answered at once."""
        for _ in range(_AT_ONCE):
            try:
                question = self.socket.recv_multipart(zmq.NOBLOCK)
            except zmq.Again:
                return
            self.socket.send_multipart(self._verdict(question))

    def close(self) -> None:
        """Answer no more; after the sockets it answers for are closed."""
        self.socket.close(linger=0)

    def _verdict(self, question: list[bytes]) -> list[bytes]:
        _, request, domain, address, _, mechanism, *credentials = question
        name = None
        if mechanism == b"CURVE" and domain == _DOMAIN and len(credentials) == 1:
            name = self._name_of(z85.encode(credentials[0]))
        if name is None:
            self._deny(address.decode(errors="replace"))
            return [_VERSION, request, b"400", b"key not allowed", b"", b""]
        log.info("let %s in from %s", name, address.decode(errors="replace"))
        return [_VERSION, request, b"200", b"", name.encode(), b""]

    def _deny(self, address: str) -> None:
        self.denied += 1
        now = now_ns()
        if now - self._told > SECOND:  # who knocks a thousand times a second fills no disk
            self._told = now
            log.warning("turned away a client at %s, its key is not allowed; %d so far", address, self.denied)

    def _name_of(self, key: bytes) -> str | None:
        now = now_ns()
        if now - self._looked > _LOOK_EVERY:
            self._looked = now
            try:
                self._allowed = self._keys.allowed()
            except InputError as error:
                self._allowed = {}
                log.error("nobody new is let in: %s", error)
        return self._allowed.get(key)
