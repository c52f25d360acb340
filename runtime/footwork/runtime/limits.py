"""How much a server takes from its clients."""

from dataclasses import dataclass

from footwork.errors import InputError


@dataclass(frozen=True)
class Limits:
    """Bounds on what clients may ask for.

    Args:
        sessions: sessions at a time.
        characters: characters of all sessions together.
        session_characters: characters of one session.
        messages_per_tick: messages taken from one session within a tick.
        ahead_ticks: how far ahead of the next tick a command may lie.
        errors_per_tick: error replies to one peer within a tick.
        idle_seconds: a session silent for longer is ended.

    Raises:
        InputError: for a bound that is not above zero.
    """

    sessions: int = 64
    characters: int = 256
    session_characters: int = 16
    messages_per_tick: int = 64
    ahead_ticks: int = 30
    errors_per_tick: int = 4
    idle_seconds: float = 10.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not value > 0:
                raise InputError(f"{name} is {value}, expected above zero", "limits")
