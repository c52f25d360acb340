"""A small blocking client: connect, spawn, command, look at the poses."""

import math
import time
from collections import deque
from collections.abc import Iterator
from typing import Self, TypeVar

import zmq

from footwork.protocol import messages as m
from footwork.protocol.address import connect
from footwork.protocol.codec import SERVER_MESSAGE_BYTES
from footwork.protocol.connection import Connection, Role, State
from footwork.protocol.curve import CurveKeys
from footwork.protocol.errors import LOCK_STEP, RefusedError

DEFAULT_ADDRESS = "tcp://127.0.0.1:5555"
_KEPT = 4096
# Low, so that after a pause the poses are recent ones: what does not fit is the server's to drop.
_QUEUE = 64
_Any = TypeVar("_Any", bound=m.FromServer | None)


class Client:
    """A session with a server; also a context manager that says bye.

    Args:
        address: of the server, such as ``tcp://127.0.0.1:5555``.
        name: for the server's log.
        timeout: how long to wait for the welcome, and for any other answer unless a call says otherwise, seconds.
        events: kinds of events to be told of beside those that answer a message, of ``messages.EVENTS``.
        resume: the welcome's token of a session whose connection broke, to go on with it.
        curve: the client's keys and the server's, for a server that lets in only those it knows.
        bundle: which of the server's bundles to play, the first unless given; the welcome tells all.

    Raises:
        LocalError: for an address that is none.
        RefusedError: for a server that refuses the session, or none that answers in time (code ``timeout``).
    """

    def __init__(
        self,
        address: str = DEFAULT_ADDRESS,
        *,
        name: str = "",
        timeout: float = 5.0,
        events: tuple[str, ...] = (),
        resume: bytes = b"",
        curve: CurveKeys | None = None,
        bundle: str = "",
    ) -> None:
        self._connection = Connection(Role.CLIENT)
        self._waiting: deque[m.FromServer] = deque(maxlen=_KEPT)
        self._timeout = timeout
        self._nonce = 0
        self._ping_every = float("inf")
        self._socket = zmq.Context.instance().socket(zmq.DEALER)
        self._poller = zmq.Poller()
        self._poller.register(self._socket, zmq.POLLIN)
        self._socket.set(zmq.LINGER, 200)
        self._socket.set(zmq.MAXMSGSIZE, SERVER_MESSAGE_BYTES)
        self._socket.set(zmq.RCVHWM, _QUEUE)
        if curve is not None:
            curve.put_on(self._socket)
        try:
            connect(self._socket, address, DEFAULT_ADDRESS)
            hello = m.Hello(version=m.PROTOCOL_VERSION, client=name, events=events, resume=resume, bundle=bundle)
            self.welcome = self._greet(hello)
        except BaseException:
            self._socket.close(linger=0)
            raise
        self._sequence = self.welcome.sequence
        self._ping_every = self.welcome.idle_seconds / 3.0 or float("inf")

    def _greet(self, hello: m.Hello) -> m.Welcome:
        self._send(hello)
        answer = self._require(self._timeout, "no answer to hello")
        if not isinstance(answer, m.Welcome):
            raise RefusedError("state", f"{type(answer).__name__.lower()} in answer to hello")
        return answer

    def spawn(self, character: int = 0, *, x: float = 0.0, z: float = 0.0, yaw: float = 0.0, behaviour="") -> int:
        """Put a character into the world; returns the message's sequence, as all of these do."""
        sequence = self._next()
        self._send(m.Spawn(sequence=sequence, character=character, x=x, z=z, yaw=yaw, behaviour=behaviour))
        return sequence

    def command(
        self, character: int, heading: float, behaviour: str, *, speed: float | None = None, tick: int = 0
    ) -> int:
        """Ask for a direction of travel, radians, and a behaviour, at a speed in m/s where it takes one."""
        sequence, asked = self._next(), {"heading": heading, "behaviour": behaviour, "speed": speed}
        self._send(m.Command(sequence=sequence, character=character, tick=tick, **asked))
        return sequence

    def keys(self, character: int, keys: m.Keys, *, tick: int = 0) -> int:
        """Ask by the view yaw and the keys that a player holds."""
        sequence = self._next()
        self._send(m.Command(sequence=sequence, character=character, keys=keys, tick=tick))
        return sequence

    def correct(self, character: int, x: float, z: float, yaw: float) -> int:
        """Move a character's root, metres and radians; its motion goes on from there."""
        sequence = self._next()
        self._send(m.Correct(sequence=sequence, character=character, x=x, z=z, yaw=yaw))
        return sequence

    def teleport(self, character: int, x: float, z: float, yaw: float) -> int:
        """Put a character elsewhere, metres and radians, with nothing of where it was lingering."""
        sequence = self._next()
        self._send(m.Teleport(sequence=sequence, character=character, x=x, z=z, yaw=yaw))
        return sequence

    def despawn(self, character: int) -> int:
        """Take a character out of the world."""
        sequence = self._next()
        self._send(m.Despawn(sequence=sequence, character=character))
        return sequence

    def step(self, ticks: int = 1, timeout: float | None = None) -> list[m.Pose]:
        """Let a server in lock-step make ticks; the poses at the last one's own moment. Events are kept for later.

        Raises:
            RefusedError: where the server refused this or an earlier message, says bye, or is silent for ``timeout``
                seconds.
        """
        timeout = self._timeout if timeout is None else timeout
        self._send(m.Step(ticks=ticks))
        poses, refused = [], None
        while not isinstance(answer := self._arrival(timeout), m.Stepped):
            if answer is None:
                raise RefusedError("timeout", f"no tick in {timeout:g} s")
            if isinstance(answer, m.Pose):
                poses.append(answer)
            elif isinstance(answer, m.Error) and answer.code != LOCK_STEP:
                refused = refused or answer
            else:
                self._waiting.append(_accepted(answer))
        _accepted(refused)
        return poses

    def ping(self, timeout: float | None = None) -> float:
        """Seconds until the pong came; messages that come meanwhile are kept for later.

        Raises:
            RefusedError: with code ``timeout`` where none comes in ``timeout`` seconds.
        """
        sent, timeout = time.monotonic(), self._timeout if timeout is None else timeout
        self._nonce += 1
        self._send(m.Ping(nonce=self._nonce))
        while (answer := self._arrival(sent + timeout - time.monotonic())) is not None:
            if isinstance(answer, m.Pong) and answer.nonce == self._nonce:
                return time.monotonic() - sent
            self._waiting.append(answer)
        raise RefusedError("timeout", f"no pong in {timeout:g} s")

    def receive(self, timeout: float) -> m.FromServer | None:
        """The next message of any kind, None where none comes in ``timeout`` seconds.

        Pings by itself, so that a client which only looks is not taken for dead.

        Raises:
            PeerError: for a server that does not keep to the protocol.
        """
        return self._waiting.popleft() if self._waiting else self._arrival(timeout)

    def _arrival(self, timeout: float) -> m.FromServer | None:
        end = time.monotonic() + timeout
        while True:
            if time.monotonic() - self._sent > self._ping_every and self._connection.state is State.OPEN:
                self._send(m.Ping())
            left = max(0.0, end - time.monotonic())
            if self._poller.poll(math.ceil(1000.0 * min(left, self._ping_every))):
                message = self._connection.receive(self._socket.recv())
                if isinstance(message, m.Welcome):  # the server plays another bundle from now on
                    self.welcome = message
                return message  # type: ignore[return-value]
            if time.monotonic() >= end:
                return None

    def poses(self, timeout: float | None = None) -> Iterator[m.Pose]:
        """Poses as they come, for as long as they do; events and pongs are passed over.

        Raises:
            RefusedError: where the server refuses a message, says bye, or is silent for ``timeout`` seconds.
        """
        timeout = self._timeout if timeout is None else timeout
        while True:
            message = self._require(timeout, "no pose")
            if isinstance(message, m.Pose):
                yield message

    def listen(self, timeout: float) -> m.FromServer | None:
        """As ``receive``, but a refusal or a bye is raised.

        Raises:
            RefusedError: where the server refuses a message or says bye.
            PeerError: for a server that does not keep to the protocol.
        """
        return _accepted(self.receive(timeout))

    def _require(self, timeout: float, problem: str) -> m.FromServer:
        message = self.listen(timeout)
        if message is None:
            raise RefusedError("timeout", f"{problem} in {timeout:g} s")
        return message

    def _next(self) -> int:
        self._sequence += 1
        return self._sequence

    def _send(self, message: m.FromClient) -> None:
        self._sent = time.monotonic()
        try:
            self._socket.send(self._connection.send(message), zmq.NOBLOCK)
        except zmq.Again:
            raise RefusedError("timeout", "the server takes no more messages") from None

    def close(self) -> None:
        """Say bye, if the session is still open, and let go of the socket."""
        if not self._socket.closed and self._connection.state is State.OPEN:
            self._send(m.Bye(reason="done"))
        self._socket.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _accepted(message: _Any) -> _Any:
    """The message, unless it is a refusal or a bye."""
    if isinstance(message, m.Error):
        raise RefusedError(message.code, message.message, message.sequence, message.valid)
    if isinstance(message, m.Bye):
        raise RefusedError(message.reason, "the server ended the session")
    return message
