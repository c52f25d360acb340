"""What a client says, beside bye."""

from typing import Annotated

from msgspec import Meta, Struct

from footwork.protocol.fields import (
    CharacterNumber,
    Counter,
    Kinds,
    Metres,
    Name,
    Radians,
    Sequence,
    Sign,
    Speed,
    Token,
    Version,
)
from footwork.protocol.message import Message

STEP_TICKS = 30
EVENTS = ("behaviour", "transition")
"""Kinds of events that a client asks for."""


class Hello(Message, frozen=True):
    """client: opens a session.

    Args:
        version: the protocol version that the client speaks.
        client: a name for the server's log.
        events: kinds of events to be told of beside those that answer a message, of ``EVENTS``.
        resume: token of a session whose connection broke, empty for a new session.
        bundle: which of the server's bundles to play, empty for the first.
    """

    version: Version
    client: Name = ""
    events: Kinds = ()
    resume: Token = b""
    bundle: Name = ""


class Spawn(Message, frozen=True):
    """client: puts a character into the world.

    Args:
        sequence: above all earlier ones of the session.
        character: the client's own number for it, free to choose.
        x: where it stands, metres.
        z: where it stands, metres.
        yaw: where it looks, radians.
        behaviour: what it starts in, empty for the server's choice.
    """

    sequence: Sequence
    character: CharacterNumber
    x: Metres = 0.0
    z: Metres = 0.0
    yaw: Radians = 0.0
    behaviour: Name = ""


class Keys(Struct, frozen=True, kw_only=True, gc=False):
    """Held keys as a player holds them.

    Args:
        view_yaw: where the camera looks, radians.
        forward: -1 back, 0, 1 forward.
        strafe: -1 left, 0, 1 right.
        run: the run modifier is held.
        jump: the jump key is held.
    """

    view_yaw: Radians
    forward: Sign = 0
    strafe: Sign = 0
    run: bool = False
    jump: bool = False


class Command(Message, frozen=True):
    """client: what a character shall do from a tick on, either by ``keys`` or by ``heading`` and ``behaviour``.

    Args:
        sequence: above all earlier ones of the session.
        character: whom it is for.
        keys: held keys, in place of heading and behaviour.
        heading: wanted direction of travel in the world, radians.
        behaviour: one of the welcome's behaviours.
        tick: the tick it is for; 0 or a tick gone by is the next one.
        speed: m/s, of a behaviour that takes one; none where any will do, and with keys.
    """

    sequence: Sequence
    character: CharacterNumber
    keys: Keys | None = None
    heading: Radians | None = None
    behaviour: Name | None = None
    tick: Counter = 0
    speed: Speed | None = None

    def __post_init__(self) -> None:
        outright = (self.heading is not None, self.behaviour is not None)
        if (self.keys is None) != all(outright) or any(outright) != all(outright):
            raise ValueError("expected either keys, or both heading and behaviour")
        if self.keys is not None and self.speed is not None:
            raise ValueError("expected no speed with keys")


class Moved(Message, frozen=True):
    """What ``correct`` and ``teleport`` say.

    Args:
        sequence: above all earlier ones of the session.
        character: whom it is for.
        x: the new place, metres.
        z: the new place, metres.
        yaw: the new facing, radians.
    """

    sequence: Sequence
    character: CharacterNumber
    x: Metres
    z: Metres
    yaw: Radians


class Correct(Moved, frozen=True):
    """client: moves a character's root, as where a wall stopped it; its motion goes on from there, turned with it."""


class Teleport(Moved, frozen=True):
    """client: puts a character somewhere else, and nothing of where it was lingers in how it is shown."""


class Despawn(Message, frozen=True):
    """client: takes a character out of the world.

    Args:
        sequence: above all earlier ones of the session.
        character: whom it is for.
    """

    sequence: Sequence
    character: CharacterNumber


class Step(Message, frozen=True):
    """client: asks a server in lock-step for the next ticks.

    Args:
        ticks: how many.
    """

    ticks: Annotated[int, Meta(ge=1, le=STEP_TICKS)] = 1


class Ping(Message, frozen=True):
    """client: asks for a pong, and keeps a quiet session alive.

    Args:
        nonce: comes back in the pong.
    """

    nonce: Counter = 0
