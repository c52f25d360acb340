"""The messages of the wire: one tagged union a direction, every field bounded.

Each is a MessagePack map whose key ``type`` names the message. Fields are added with defaults and never retyped, and
unknown fields are skipped, so that old and new peers of one protocol version understand each other. SPEC.md tells
the same in words.
"""

from footwork.protocol.client_messages import (
    EVENTS,
    STEP_TICKS,
    Command,
    Correct,
    Despawn,
    Hello,
    Keys,
    Ping,
    Spawn,
    Step,
    Teleport,
)
from footwork.protocol.message import PROTOCOL_VERSION, TICK_RATE, Bye, Message
from footwork.protocol.server_messages import Error, Event, Pong, Pose, Stepped, Welcome

__all__ = [
    "EVENTS",
    "PROTOCOL_VERSION",
    "STEP_TICKS",
    "TICK_RATE",
    "AnyMessage",
    "Bye",
    "Command",
    "Correct",
    "Despawn",
    "Error",
    "Event",
    "FromClient",
    "FromServer",
    "Hello",
    "Keys",
    "Message",
    "Ping",
    "Pong",
    "Pose",
    "Spawn",
    "Step",
    "Stepped",
    "Teleport",
    "Welcome",
]

FromClient = Hello | Spawn | Command | Correct | Teleport | Despawn | Step | Ping | Bye
FromServer = Welcome | Pose | Event | Error | Stepped | Pong | Bye
AnyMessage = FromClient | FromServer
