"""The raw peer that the checks talk through: bytes out, messages in, and no manners of its own."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol, TypeVar

import zmq
from msgspec import UNSET

from footwork.protocol import messages as m
from footwork.protocol.address import connect
from footwork.protocol.client import DEFAULT_ADDRESS
from footwork.protocol.codec import decode_from_server, encode
from footwork.protocol.errors import LocalError, PeerError

PATIENCE = 20.0
"""How long an answer may take, on a busy machine too, seconds."""

Kind = TypeVar("Kind", bound=m.FromServer)


class Failed(Exception):  # noqa: N818  (it reads as what happened)
    """A server did not do what it should have."""


class Line(Protocol):
    """Carries messages to a server and back, for one peer."""

    def send(self, data: bytes) -> None:
        """Send a message."""
        ...

    def receive(self, seconds: float) -> bytes | None:
        """The next message, None where none comes in time."""
        ...

    def close(self) -> None:
        """Hang up, without a word."""
        ...


Dial = Callable[[], Line]


class SocketLine:
    """A line over a DEALER socket.

    Args:
        address: of the server.

    Raises:
        LocalError: for an address that is none.
    """

    def __init__(self, address: str) -> None:
        self._socket = zmq.Context.instance().socket(zmq.DEALER)
        self._socket.set(zmq.LINGER, 200)
        try:
            connect(self._socket, address, DEFAULT_ADDRESS)
        except LocalError:
            self.close()
            raise

    def send(self, data: bytes) -> None:
        """Send a message."""
        self._socket.send(data)

    def receive(self, seconds: float) -> bytes | None:
        """The next message, None where none comes in time."""
        return self._socket.recv() if self._socket.poll(round(1000.0 * seconds)) else None

    def close(self) -> None:
        """Hang up, without a word."""
        self._socket.close()


class Peer:
    """One end of a line.

    Args:
        line: to the server.

    Attributes:
        watches: whether it hears of opponents too, and of blows and rounds; else it passes them over.
    """

    def __init__(self, line: Line) -> None:
        self.line = line
        self.watches = False
        self._opponents: set[int] = set()
        self._own: set[int] = set()
        self._welcome: m.Welcome | None = None
        self._sequence = 0
        self._stepping = False

    @property
    def welcome(self) -> m.Welcome:
        """What the server said on arrival.

        Raises:
            Failed: where it said nothing yet.
        """
        if self._welcome is None:
            raise Failed("there is no session yet")
        return self._welcome

    def next(self) -> int:
        """A sequence number that was not used yet."""
        self._sequence += 1
        return self._sequence

    def say(self, message: m.FromClient) -> None:
        """Send a message."""
        if isinstance(message, m.Spawn):
            self._own.add(message.character)
        self.line.send(encode(message))

    def hear(self, kind: type[Kind], seconds: float = PATIENCE) -> Kind:
        """The next message of a kind; others before it are passed over, but no refusal and no bye.

        Raises:
            Failed: where none comes in time, or anything that is no message.
        """
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            message = self.listen(left)
            if isinstance(message, kind):
                return message
            if isinstance(message, m.Stepped):
                self.step()
            if isinstance(message, m.Error | m.Bye):
                raise Failed(f"{message} where {kind.__name__.lower()} was expected")
        raise Failed(f"no {kind.__name__.lower()} in {seconds:g} s")

    def listen(self, seconds: float) -> m.FromServer | None:
        """The next message of any kind, None where none comes in time.

        Raises:
            Failed: for bytes that are no message.
        """
        end = time.monotonic() + seconds
        message = self._message(seconds)
        while not self.watches and self._is_of_a_fight(message):
            message = self._message(max(0.0, end - time.monotonic()))
        return message

    def _message(self, seconds: float) -> m.FromServer | None:
        data = self.line.receive(seconds)
        try:
            message = None if data is None else decode_from_server(data)
        except PeerError as error:
            raise Failed(f"the server sent what is no message: {error}") from None
        self._stepping = self._stepping and not isinstance(message, m.Stepped)
        return message

    def _is_of_a_fight(self, message: m.FromServer | None) -> bool:
        """Whether a message is about an opponent or tells of blows and rounds."""
        if not isinstance(message, m.Event | m.Pose):
            return False
        if isinstance(message, m.Event) and message.opponent is not UNSET:
            if message.kind != "spawned":
                return True
            self._opponents.update({message.character, message.opponent} - self._own)
        return message.character in self._opponents

    def greet(self, **fields) -> m.Welcome:
        """Begin a session."""
        self.say(m.Hello(version=m.PROTOCOL_VERSION, client="compliance", **fields))
        self._welcome = self.hear(m.Welcome)
        self._opponents = {other for _, other in self._welcome.opponents or ()}
        return self._welcome

    @property
    def own(self) -> tuple[int, ...]:
        """The characters of the welcome that the client steers."""
        return tuple(number for number in self.welcome.spawned if number not in self._opponents)

    @property
    def company(self) -> int:
        """How many characters a spawn brings."""
        return 1 if self.welcome.opponent is UNSET else 2

    def spawn(self, character: int = 0, **fields) -> m.Event:
        """Put a character into the world; the event that tells of it."""
        sequence = self.next()
        self.say(m.Spawn(sequence=sequence, character=character, **fields))
        return self.event("spawned", sequence)

    def event(self, kind: str, sequence: int) -> m.Event:
        """The event of a message, once a tick was made."""
        self.step()
        event = self.hear(m.Event)
        expect((event.kind, event.sequence), (kind, sequence), "event")
        return event

    def step(self) -> None:
        """Let a tick be made where the server has no clock, unless one is being made."""
        if self._welcome is not None and self._welcome.lockstep and not self._stepping:
            self._stepping = True
            self.say(m.Step())

    def pose(self) -> m.Pose:
        """The next pose."""
        self.step()
        return self.hear(m.Pose)

    def pose_after(self, sequence: int) -> m.Pose:
        """The first pose that acknowledges a sequence."""
        for _ in range(600):
            pose = self.pose()
            if pose.acknowledged >= sequence:
                return pose
        raise Failed(f"600 poses and none acknowledges {sequence}")

    def refusal(self, code: str, sequence: int = 0) -> m.Error:
        """The next error, which has to have this code and, unless it is 0, this sequence."""
        self.step()
        error = self.hear(m.Error)
        expect(error.code, code, "error code")
        if sequence:
            expect(error.sequence, sequence, "sequence of the error")
        return error


@contextmanager
def calling(dial: Dial) -> Iterator[Peer]:
    """A peer on a new line."""
    line = dial()
    try:
        yield Peer(line)
    finally:
        line.close()


@contextmanager
def in_session(dial: Dial, **fields) -> Iterator[Peer]:
    """A peer with a session, which says bye in the end."""
    with calling(dial) as peer:
        peer.greet(**fields)
        yield peer
        peer.say(m.Bye(reason="done"))


def expect(found: object, wanted: object, what: str) -> None:
    """Hold what was found against what should have been.

    Raises:
        Failed: where they differ.
    """
    if found != wanted:
        raise Failed(f"{what} is {found!r}, expected {wanted!r}")
