"""A session with a server for an asyncio program: it tells when the server is gone and comes back to it."""

from contextlib import suppress

import zmq
import zmq.asyncio

from footwork.protocol import messages as m
from footwork.protocol.address import connect
from footwork.protocol.client import DEFAULT_ADDRESS
from footwork.protocol.codec import SERVER_MESSAGE_BYTES
from footwork.protocol.connection import Connection, Role, State
from footwork.protocol.curve import CurveKeys
from footwork.protocol.errors import RESUME, RefusedError

# A server shows 30 frames a second at least, or answers a ping: one that does neither for so long is gone.
SILENCE_SECONDS = 1.0
_PINGS = 3
_QUEUE = 64


class LostError(Exception):
    """The server ended the session or is silent; the reason is for people."""


class ServerLink:
    """One session over one DEALER socket.

    Args:
        address: of the server.
        name: for the server's log.
        curve: keys for a server that lets in only those it knows.

    Attributes:
        welcome: the last one that came, None before the first; kept over connections.
    """

    def __init__(self, address: str, name: str, curve: CurveKeys | None = None) -> None:
        self._address, self._name, self._curve = address, name, curve
        self._connection = Connection(Role.CLIENT)
        self._socket: zmq.asyncio.Socket | None = None
        self.welcome: m.Welcome | None = None

    @property
    def is_open(self) -> bool:
        """Whether there is a session now."""
        return self._socket is not None and self._connection.state is State.OPEN

    async def open(self) -> m.Welcome:
        """Begin a session, or go on with the one that was lost where the server still has it; its welcome.

        Raises:
            LostError: where no server answers, or it takes nobody in.
            PeerError: for a server that does not keep to the protocol.
        """
        token = b"" if self.welcome is None else self.welcome.token
        try:
            self.welcome = await self._greet(token)
        except RefusedError as refusal:
            if refusal.code != RESUME:
                raise LostError(f"the server refuses: {refusal}") from None
            self.welcome = await self._greet(b"")
        return self.welcome

    async def _greet(self, token: bytes) -> m.Welcome:
        self.drop()
        self._connection, self._socket = Connection(Role.CLIENT), self._connected()
        await self.send(m.Hello(version=m.PROTOCOL_VERSION, client=self._name, resume=token))
        answer, _ = await self._next(SILENCE_SECONDS)
        if isinstance(answer, m.Welcome):
            return answer
        if isinstance(answer, m.Error):
            raise RefusedError(answer.code, answer.message)
        raise LostError("the server does not answer")

    def _connected(self) -> zmq.asyncio.Socket:
        socket = zmq.asyncio.Context.instance().socket(zmq.DEALER)
        socket.set(zmq.LINGER, 0)
        socket.set(zmq.MAXMSGSIZE, SERVER_MESSAGE_BYTES)
        socket.set(zmq.RCVHWM, _QUEUE)
        socket.set(zmq.SNDHWM, _QUEUE)
        if self._curve is not None:
            self._curve.put_on(socket)
        connect(socket, self._address, DEFAULT_ADDRESS)
        return socket

    async def send(self, message: m.FromClient) -> None:
        """Send a message.

        Raises:
            LocalError: for one that may not be sent now.
            LostError: where the server takes no more.
        """
        data = self._connection.send(message)
        if self._socket is None:
            raise LostError("there is no server")
        try:
            await self._socket.send(data, zmq.NOBLOCK)
        except zmq.Again:
            raise LostError("the server takes no more messages") from None

    async def receive(self) -> tuple[m.FromServer, bytes]:
        """The next message and its bytes; pings a quiet server.

        Raises:
            LostError: once the server says bye or is silent for ``SILENCE_SECONDS``.
            PeerError: for a server that does not keep to the protocol.
        """
        for _ in range(_PINGS):
            message, data = await self._next(SILENCE_SECONDS / _PINGS)
            if isinstance(message, m.Bye):
                raise LostError(f"the server ended the session: {message.reason}")
            if isinstance(message, m.Welcome):
                self.welcome = message
            if message is not None:
                return message, data
            await self.send(m.Ping())
        raise LostError("the server is silent")

    async def _next(self, timeout: float) -> tuple[m.FromServer | None, bytes]:
        if self._socket is None or not await self._socket.poll(round(1000.0 * timeout)):
            return None, b""
        data = await self._socket.recv()
        return self._connection.receive(data), data  # type: ignore[return-value]

    def drop(self) -> None:
        """Let go of the socket without a word: the server keeps the session for a while."""
        if self._socket is not None:
            self._socket.close()
        self._socket = None

    def close(self) -> None:
        """Say bye, if there is a session, and let go of the socket."""
        if self._socket is not None and self.is_open:
            self._socket.set(zmq.LINGER, 200)
            with suppress(zmq.Again):
                zmq.Socket.shadow(self._socket).send(self._connection.send(m.Bye(reason="done")), zmq.NOBLOCK)
        self.drop()
