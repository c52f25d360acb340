"""The protocol's exceptions (whose bug it was is what tells them apart) and the codes that go over the wire."""

from footwork.errors import FootworkError

MALFORMED = "malformed"
TOO_LARGE = "too_large"
VERSION = "version"
STATE = "state"
NO_SESSION = "no_session"
SESSIONS = "sessions"
RATE = "rate"
STALE = "stale"
TICK = "tick"
CHARACTERS = "characters"
CHARACTER_TAKEN = "character_taken"
CHARACTER_UNKNOWN = "character_unknown"
BEHAVIOUR = "behaviour"
SPEED = "speed"
LOCK_STEP = "lock_step"
RESUME = "resume"
BUNDLE = "bundle"
OPPONENT = "opponent"

CODES = {
    MALFORMED: "the bytes are no message of this protocol, or a field is out of bounds",
    TOO_LARGE: "the message is longer than the welcome's message_bytes",
    VERSION: "the server does not speak the hello's protocol version; the session is closed",
    STATE: "a message that may not come in this state, such as a second hello",
    NO_SESSION: "a message from a peer that has no session: say hello first",
    SESSIONS: "the server has all the sessions it takes; try later",
    RATE: "more messages within one tick than the server takes from a session; the surplus is dropped",
    STALE: "the sequence number is not above the session's last one; the message is dropped",
    TICK: "the command is for a tick too far ahead",
    CHARACTERS: "the session or the server has all the characters it takes",
    CHARACTER_TAKEN: "the session has a character of this number already",
    CHARACTER_UNKNOWN: "the session has no character of this number",
    BEHAVIOUR: "the bundle has no such behaviour; ``valid`` lists those it has",
    SPEED: "the behaviour takes no speed; ``valid`` lists those that do",
    LOCK_STEP: "a step where the server has a clock of its own, or while the session's last one is not answered",
    RESUME: "no session waits for this token; the session is closed, say hello without it",
    BUNDLE: "the server plays no bundle of this name; ``valid`` lists those it plays; the session is closed",
    OPPONENT: "the character is an opponent, which decides for itself and leaves with the one that it fights",
}


class ProtocolError(FootworkError):
    """The root of the protocol's exceptions."""


class LocalError(ProtocolError):
    """Our own bug: a message that may not be sent now, or whose fields are out of bounds."""


class PeerError(ProtocolError):
    """The peer's bug: what came in may not come, or is no message at all.

    Args:
        code: one of ``CODES``.
        problem: one line on what is wrong.
        sequence: sequence number of the message at fault, 0 where unknown.
        valid: what would have been valid, where that is a list of names.
    """

    def __init__(self, code: str, problem: str, sequence: int = 0, valid: tuple[str, ...] = ()) -> None:
        super().__init__(f"{code}: {problem}")
        self.code = code
        self.problem = problem
        self.sequence = sequence
        self.valid = valid


class RefusedError(ProtocolError):
    """The server answered with an error message or a bye.

    Args:
        code: the error's code, or the bye's reason.
        problem: the error's message.
        sequence: sequence number of the message that was refused, 0 where the server could not tell.
        valid: what would have been valid.
    """

    def __init__(self, code: str, problem: str = "", sequence: int = 0, valid: tuple[str, ...] = ()) -> None:
        super().__init__(f"{code}: {problem}" if problem else code)
        self.code = code
        self.problem = problem
        self.sequence = sequence
        self.valid = valid
