"""The messages of the wire: one tagged union a direction, every field bounded.

Each is a MessagePack map whose key ``type`` names the message. Fields are added with defaults and never retyped, and
unknown fields are skipped, so that old and new peers of one protocol version understand each other. SPEC.md tells
the same in words.
"""

from typing import Annotated

from msgspec import Meta, Struct

PROTOCOL_VERSION = 1
TICK_RATE = 30

# Bounds refuse NaN and infinities too: neither is above a lower and below an upper bound.
Metres = Annotated[float, Meta(ge=-1e5, le=1e5)]
Radians = Annotated[float, Meta(ge=-1e5, le=1e5)]
Sign = Annotated[int, Meta(ge=-1, le=1)]
# Whole numbers stay exact in a peer whose only number is a double.
Counter = Annotated[int, Meta(ge=0, le=2**53 - 1)]
Sequence = Annotated[int, Meta(ge=1, le=2**53 - 1)]
CharacterNumber = Annotated[int, Meta(ge=0, le=65535)]
Index = Annotated[int, Meta(ge=-1, le=2**31 - 1)]
Name = Annotated[str, Meta(max_length=64)]
Names = Annotated[tuple[Name, ...], Meta(max_length=256)]
ClipName = Annotated[str, Meta(max_length=256)]
Line = Annotated[str, Meta(max_length=1024)]
Text = Annotated[str, Meta(max_length=65536)]
Offset = tuple[Metres, Metres, Metres]
Offsets = Annotated[tuple[Offset, ...], Meta(max_length=256)]
VectorBytes = Annotated[bytes, Meta(min_length=12, max_length=12)]
RotationBytes = Annotated[bytes, Meta(min_length=16, max_length=16 * 256)]


class Message(Struct, frozen=True, kw_only=True, gc=False, tag_field="type", tag=str.lower):
    """What all messages share: immutable, named by ``type`` on the wire, out of the garbage collector's sight."""


class Hello(Message, frozen=True):
    """client: opens a session.

    Args:
        version: the protocol version that the client speaks.
        client: a name for the server's log.
    """

    version: Annotated[int, Meta(ge=0, le=2**31 - 1)]
    client: Name = ""


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
    """

    sequence: Sequence
    character: CharacterNumber
    keys: Keys | None = None
    heading: Radians | None = None
    behaviour: Name | None = None
    tick: Counter = 0

    def __post_init__(self) -> None:
        outright = (self.heading is not None, self.behaviour is not None)
        if (self.keys is None) != all(outright) or any(outright) != all(outright):
            raise ValueError("expected either keys, or both heading and behaviour")


class Correct(Message, frozen=True):
    """client: moves a character's root (a wall stopped it, a teleport); its motion goes on from there.

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


class Despawn(Message, frozen=True):
    """client: takes a character out of the world.

    Args:
        sequence: above all earlier ones of the session.
        character: whom it is for.
    """

    sequence: Sequence
    character: CharacterNumber


class Ping(Message, frozen=True):
    """client: asks for a pong, and keeps a quiet session alive.

    Args:
        nonce: comes back in the pong.
    """

    nonce: Counter = 0


class Bye(Message, frozen=True):
    """either: ends the session.

    Args:
        reason: a word for it.
    """

    reason: Name = ""


class Welcome(Message, frozen=True):
    """server: answers hello with all that a client needs to ask and to draw.

    Args:
        version: the protocol version of the session.
        tick: the tick last made.
        tick_rate: ticks a second.
        frame_rate: shown frames a second, a whole number of times the tick rate.
        joints: joint names; parents come before children.  # (J,)
        parents: index of each joint's parent, -1 for the root.  # (J,)
        offsets: place of each joint in its parent's frame at rest, metres.  # (J, 3)
        ends: tip of a leaf joint's segment in the joint's frame, metres, zero for none.  # (J, 3)
        behaviours: what commands may ask for.
        clips: names of the source clips.
        digest: of the bundle.
        attribution: what the licences of the motion ask to be shown.
        idle_seconds: a session that is silent for longer is ended.
        characters: how many characters a session may have.
        message_bytes: how long a message to the server may be.
        messages_per_tick: how many messages a session may send within a tick.
    """

    version: Annotated[int, Meta(ge=0, le=2**31 - 1)]
    tick: Counter
    tick_rate: Annotated[int, Meta(ge=1, le=1000)]
    frame_rate: Annotated[int, Meta(ge=1, le=1000)]
    joints: Names
    parents: Annotated[tuple[Index, ...], Meta(max_length=256)]
    offsets: Offsets
    ends: Offsets
    behaviours: Names
    clips: Annotated[tuple[ClipName, ...], Meta(max_length=4096)]
    digest: Name = ""
    attribution: Annotated[tuple[Text, ...], Meta(max_length=256)] = ()
    idle_seconds: Annotated[float, Meta(ge=0, le=1e6)] = 0.0
    characters: Counter = 0
    message_bytes: Counter = 0
    messages_per_tick: Counter = 0


class Pose(Message, frozen=True):
    """server: how one character looks at one shown frame, and what it does.

    Args:
        tick: the tick it shows.
        frame: which of the tick's shown frames, 1..frame_rate / tick_rate; the last is the tick's own moment.
        character: the client's number for it.
        acknowledged: highest sequence of this character's messages that took effect.
        facing: where it looks at the end of the tick, radians.
        behaviour: index into the welcome's behaviours, -1 for none.
        clip: source of the frame, of two sources the nearer: index into the welcome's clips.
        source_frame: frame of that clip, at 30 a second.
        transition: whether the edge taken leaves the captured order.
        root: place of joint 0 in the world, metres: 3 float32, little-endian.
        rotations: local rotations xyzw, joint 0 in the world: J x 4 float32, little-endian.
    """

    tick: Counter
    frame: Annotated[int, Meta(ge=1, le=1000)]
    character: CharacterNumber
    acknowledged: Counter
    facing: Radians
    behaviour: Index
    clip: Index
    source_frame: Index
    transition: bool
    root: VectorBytes
    rotations: RotationBytes

    def __post_init__(self) -> None:
        if len(self.rotations) % 16:
            raise ValueError("expected 16 bytes of rotations a joint")


class Event(Message, frozen=True):
    """server: something happened to a character: ``spawned``, ``despawned`` or ``corrected``.

    Args:
        tick: when.
        kind: what; a client skips kinds that it does not know.
        character: to whom.
        sequence: of the message that caused it, 0 for none.
    """

    tick: Counter
    kind: Name
    character: CharacterNumber
    sequence: Counter = 0


class Error(Message, frozen=True):
    """server: a message was refused.

    Args:
        code: a word for programs, one of SPEC.md's error codes.
        message: a line for people.
        sequence: of the message refused, 0 where the server could not tell.
        valid: what would have been valid, where that is a list of names.
    """

    code: Name
    message: Line
    sequence: Counter = 0
    valid: Names = ()


class Pong(Message, frozen=True):
    """server: answers ping.

    Args:
        nonce: the ping's.
        tick: the tick last made.
    """

    nonce: Counter
    tick: Counter


FromClient = Hello | Spawn | Command | Correct | Despawn | Ping | Bye
FromServer = Welcome | Pose | Event | Error | Pong | Bye
AnyMessage = FromClient | FromServer
