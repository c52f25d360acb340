"""What a server says, beside bye."""

from typing import Annotated

from msgspec import UNSET, Meta, UnsetType, field

from footwork.protocol.fields import (
    CharacterNumber,
    CharacterNumbers,
    CharacterPairs,
    ClipName,
    Counter,
    Index,
    Line,
    Name,
    Names,
    Offsets,
    Radians,
    RotationBytes,
    Share,
    SpeedRanges,
    Text,
    Token,
    VectorBytes,
    Version,
)
from footwork.protocol.message import Message


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
        lockstep: whether ticks are made when clients ask for them, not by a clock.
        token: resumes the session after its connection broke; for nobody else's eyes.
        resume_seconds: for how long it does.
        resumed: whether this is the session that hello's token named.
        sequence: the highest that a message of the session had.
        spawned: numbers of the characters that the session has.
        speeds: the slowest and the fastest, m/s, that commands may ask of each behaviour that takes a speed.
        bundle: the name of the bundle that the session plays.
        bundles: the names of all that the server plays, the first being that of a hello which names none.
        opponent: the style of the opponents that come with characters; left out where none do.
        opponents: of ``spawned``, each one that the client steers and its opponent; left out likewise.
    """

    version: Version
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
    lockstep: bool = False
    token: Token = b""
    resume_seconds: Annotated[float, Meta(ge=0, le=1e6)] = 0.0
    resumed: bool = False
    sequence: Counter = 0
    spawned: CharacterNumbers = ()
    speeds: SpeedRanges = field(default_factory=dict)
    bundle: Name = ""
    bundles: Names = ()
    opponent: Name | UnsetType = UNSET
    opponents: CharacterPairs | UnsetType = UNSET


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
        lost: how many poses of this character were dropped since the last one sent, for a client that reads slowly.
        health: of a fighter, 1 at the beginning of a round; left out of others.
        stamina: of a fighter, 1 when rested; left out of others.
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
    lost: Counter = 0
    health: Share | UnsetType = UNSET
    stamina: Share | UnsetType = UNSET

    def __post_init__(self) -> None:
        if len(self.rotations) % 16:
            raise ValueError("expected 16 bytes of rotations a joint")


class Event(Message, frozen=True):
    """server: something happened to a character.

    Args:
        tick: when.
        kind: what: ``spawned``, ``despawned``, ``corrected``, ``teleported``, ``hit``, ``miss``, ``round`` or one of
            ``EVENTS``; a client skips kinds that it does not know.
        character: to whom.
        sequence: of the message that caused it, 0 for none.
        behaviour: what the character does from this tick on: index into the welcome's behaviours, -1 for none.
        opponent: the number of the one that a fighter fights, -1 for none; left out where nobody fights.
        damage: of ``hit``: the part of its health that it took; left out of others.
    """

    tick: Counter
    kind: Name
    character: CharacterNumber
    sequence: Counter = 0
    behaviour: Index = -1
    opponent: Index | UnsetType = UNSET
    damage: Share | UnsetType = UNSET


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


class Stepped(Message, frozen=True):
    """server: answers step once its ticks are made and the characters' poses are sent.

    Args:
        tick: the tick last made.
    """

    tick: Counter


class Pong(Message, frozen=True):
    """server: answers ping.

    Args:
        nonce: the ping's.
        tick: the tick last made.
    """

    nonce: Counter
    tick: Counter
