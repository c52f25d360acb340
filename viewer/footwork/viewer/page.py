"""One page in a browser: what it says is held against the protocol and its limits, what the server says goes to it.

The page speaks the protocol itself, one message a binary frame, but for three things that are the bridge's: hello and
bye with the session's token, the way back to a server that was lost, and that a page has one character. What the
bridge has to say is a map of type ``bridge``.
"""

import asyncio
import time

import msgspec
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_client, encode
from footwork.protocol.errors import (
    CHARACTERS,
    MALFORMED,
    NO_SESSION,
    RATE,
    STATE,
    LocalError,
    PeerError,
    ProtocolError,
)
from footwork.viewer.allowance import Allowance
from footwork.viewer.server_link import LostError, ServerLink

CHARACTER = 0
"""The number of a page's character."""
MESSAGES_A_SECOND, MESSAGES_AT_ONCE = 120.0, 120.0
ERRORS_A_SECOND = 4.0
# A page that goes on saying more than it may is not a page of ours.
SURPLUS_A_SECOND, SURPLUS_AT_ONCE = 120.0, 1000.0
_RETRY_SECONDS = 0.3
_TO_SAY = m.Spawn | m.Command | m.Correct | m.Teleport | m.Despawn | m.Step | m.Ping


class FloodError(Exception):
    """A page says far too much."""


class Notice(msgspec.Struct, frozen=True, tag_field="type", tag="bridge"):
    """What the bridge itself tells a page.

    Args:
        state: ``lost`` while there is no server, ``refused`` where this page gets no character.
        message: a line for people.
    """

    state: str
    message: str


class Page:
    """Carries messages both ways for as long as the page is there.

    Args:
        socket: the page's.
        link: to the server, not yet open.
    """

    def __init__(self, socket: ServerConnection, link: ServerLink) -> None:
        self._socket, self._link = socket, link
        now = time.monotonic()
        self._messages = Allowance(MESSAGES_A_SECOND, MESSAGES_AT_ONCE, now)
        self._errors = Allowance(ERRORS_A_SECOND, ERRORS_A_SECOND, now)
        self._surplus = Allowance(SURPLUS_A_SECOND, SURPLUS_AT_ONCE, now)

    async def play(self) -> None:
        """Until the page goes.

        Raises:
            FloodError: where it says far too much.
        """
        to_page = asyncio.create_task(self._to_page())
        try:
            async for data in self._socket:
                await self._take(data)
        except ConnectionClosed:
            pass
        finally:
            to_page.cancel()
            await asyncio.gather(to_page, return_exceptions=True)
            self._link.close()

    async def _take(self, data: str | bytes) -> None:
        try:
            await self._link.send(self._checked(data))
        except PeerError as error:
            await self._refuse(error)
        except (LostError, LocalError):
            await self._refuse(PeerError(NO_SESSION, "there is no server at the moment"))

    def _checked(self, data: str | bytes) -> m.FromClient:
        now = time.monotonic()
        if not self._messages.take(now):
            if not self._surplus.take(now):
                raise FloodError
            raise PeerError(RATE, f"more than {MESSAGES_A_SECOND:g} messages a second; this one is dropped")
        if isinstance(data, str):
            raise PeerError(MALFORMED, "text, expected a binary frame")
        message = decode_from_client(data)
        if not isinstance(message, _TO_SAY):
            raise PeerError(STATE, f"{type(message).__name__.lower()} is the bridge's to say")
        if getattr(message, "character", CHARACTER) != CHARACTER:
            raise PeerError(CHARACTERS, f"a page has one character, number {CHARACTER}", _sequence(message))
        return message

    async def _refuse(self, error: PeerError) -> None:
        if self._errors.take(time.monotonic()):
            told = m.Error(code=error.code, message=error.problem, sequence=error.sequence, valid=error.valid)
            await self._socket.send(encode(told))

    async def _to_page(self) -> None:
        while True:
            try:
                await self._tell_welcome(await self._link.open())
                await self._carry()
            except (LostError, ProtocolError) as error:
                self._link.drop()
                await self._socket.send(told("lost", str(error)))
                await asyncio.sleep(_RETRY_SECONDS)

    async def _carry(self) -> None:
        while True:
            message, data = await self._link.receive()
            if isinstance(message, m.Welcome):
                await self._tell_welcome(message)
            else:
                await self._socket.send(data)

    async def _tell_welcome(self, welcome: m.Welcome) -> None:
        """The token stays with the bridge, which alone resumes the session."""
        await self._socket.send(encode(msgspec.structs.replace(welcome, token=b"")))


def told(state: str, message: str) -> bytes:
    """What the bridge says, as it goes to a page."""
    return msgspec.msgpack.encode(Notice(state, message))


def _sequence(message: m.FromClient) -> int:
    return getattr(message, "sequence", 0)
