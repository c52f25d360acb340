"""What all messages share, and the one that both sides say."""

from msgspec import Struct

from footwork.protocol.fields import Name

PROTOCOL_VERSION = 1
TICK_RATE = 30


class Message(Struct, frozen=True, kw_only=True, gc=False, tag_field="type", tag=str.lower):
    """What all messages share: immutable, named by ``type`` on the wire, out of the garbage collector's sight."""


class Bye(Message, frozen=True):
    """either: ends the session.

    Args:
        reason: a word for it.
    """

    reason: Name = ""
