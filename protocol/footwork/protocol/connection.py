"""Which message may come in which state of a session, as a table; no sockets here.

Both peers hold a ``Connection`` each and put every message, going out or coming in, through it.
"""

from enum import Enum

from footwork.protocol import messages as m
from footwork.protocol.codec import decode_from_client, decode_from_server, encode, encode_checked
from footwork.protocol.errors import STATE, LocalError, PeerError


class Role(Enum):
    """The two sides of a session."""

    CLIENT = "client"
    SERVER = "server"


class State(Enum):
    """What a session has come to."""

    NEW = "new"
    GREETED = "greeted"
    OPEN = "open"
    CLOSED = "closed"


# who sends -> state -> message -> the state it leads to
TRANSITIONS: dict[Role, dict[State, dict[type, State]]] = {
    Role.CLIENT: {
        State.NEW: {m.Hello: State.GREETED},
        State.GREETED: {m.Bye: State.CLOSED},
        State.OPEN: {
            m.Spawn: State.OPEN,
            m.Command: State.OPEN,
            m.Correct: State.OPEN,
            m.Teleport: State.OPEN,
            m.Despawn: State.OPEN,
            m.Step: State.OPEN,
            m.Ping: State.OPEN,
            m.Bye: State.CLOSED,
        },
        State.CLOSED: {},
    },
    Role.SERVER: {
        State.NEW: {m.Error: State.NEW, m.Bye: State.CLOSED},
        State.GREETED: {m.Welcome: State.OPEN, m.Error: State.GREETED, m.Bye: State.CLOSED},
        State.OPEN: {
            m.Welcome: State.OPEN,
            m.Pose: State.OPEN,
            m.Event: State.OPEN,
            m.Error: State.OPEN,
            m.Stepped: State.OPEN,
            m.Pong: State.OPEN,
            m.Bye: State.CLOSED,
        },
        State.CLOSED: {},
    },
}


class Connection:
    """One side's view of a session.

    Args:
        role: the side that this is.
    """

    def __init__(self, role: Role) -> None:
        self.role = role
        self.peer = Role.SERVER if role is Role.CLIENT else Role.CLIENT
        self.state = State.NEW
        self._outgoing, self._incoming = TRANSITIONS[self.role], TRANSITIONS[self.peer]
        self._decode = decode_from_client if role is Role.SERVER else decode_from_server
        self._encode = encode if role is Role.SERVER else encode_checked

    def send(self, message: m.AnyMessage) -> bytes:
        """The bytes to send.

        Raises:
            LocalError: for a message that may not be sent in this state, or with fields out of bounds.
        """
        following = self._outgoing[self.state].get(type(message))
        if following is None:
            raise LocalError(self._misplaced(self.role, message))
        data = self._encode(message)
        self.state = following
        return data

    def receive(self, data: bytes) -> m.AnyMessage:
        """The message in the bytes that came.

        Raises:
            PeerError: for bytes that are no message, or a message that may not come in this state. The state stays.
        """
        message = self._decode(data)
        following = self._incoming[self.state].get(type(message))
        if following is None:
            raise PeerError(STATE, self._misplaced(self.peer, message), getattr(message, "sequence", 0))
        self.state = following
        return message

    def _misplaced(self, sender: Role, message: m.AnyMessage) -> str:
        allowed = ", ".join(kind.__name__.lower() for kind in TRANSITIONS[sender][self.state]) or "nothing"
        return f"{type(message).__name__.lower()} in state {self.state.value}, expected {allowed}"
