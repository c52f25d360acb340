"""How much a server takes from its clients."""

from dataclasses import dataclass

from footwork.errors import InputError


@dataclass(frozen=True)
class Limits:
    """Bounds on what clients may ask for.

    Args:
        connections: connections at a time, with or without a session.
        sessions: sessions at a time.
        characters: characters of all sessions together.
        session_characters: characters of one session.
        messages_per_tick: messages taken from one session within a tick.
        ahead_ticks: how far ahead of the next tick a command may lie.
        errors_per_tick: error replies to one peer within a tick.
        idle_seconds: a session silent for longer is ended.
        waiting_messages: what waits for a session that does not read, poses apart; one more and it is ended.
        resume_seconds: for how long a session waits for its client to come back once its connection is gone.

    Raises:
        InputError: for a bound that is not above zero.
    """

    connections: int = 256
    sessions: int = 64
    characters: int = 256
    session_characters: int = 16
    messages_per_tick: int = 64
    ahead_ticks: int = 30
    errors_per_tick: int = 4
    idle_seconds: float = 10.0
    waiting_messages: int = 64
    resume_seconds: float = 10.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not value > 0:
                raise InputError(f"{name} is {value}, expected above zero", "limits")
