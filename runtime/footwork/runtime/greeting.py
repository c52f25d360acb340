"""What a client is told on arrival."""

from typing import Any

from msgspec import UNSET
from msgspec.structs import replace

from footwork.motion.bundle import Bundle
from footwork.protocol import messages as m
from footwork.protocol.codec import CLIENT_MESSAGE_BYTES, encode_checked
from footwork.runtime.limits import Limits
from footwork.runtime.session import Session


def welcome_of(
    bundle: Bundle,
    behaviours: tuple[str, ...],
    speeds: dict[str, tuple[float, float]],
    frame_rate: int,
    limits: Limits,
    /,
    **more: Any,
) -> m.Welcome:
    """The welcome of a server that plays ``bundle``, as far as it is the same for all sessions.

    Args:
        bundle: what is played.
        behaviours: what commands may ask for.
        speeds: the slowest and the fastest that they may ask of each behaviour that takes a speed, m/s.
        frame_rate: shown frames a second.
        limits: how much the client may ask for.
        more: fields that are not the bundle's own.

    Raises:
        LocalError: for a bundle that the wire cannot hold, such as one with a name that is too long.
    """
    skeleton = bundle.graph.skeleton
    welcome = m.Welcome(
        version=m.PROTOCOL_VERSION,
        tick=0,
        tick_rate=m.TICK_RATE,
        frame_rate=frame_rate,
        joints=skeleton.names,
        parents=tuple(skeleton.parents.tolist()),
        offsets=tuple(map(tuple, skeleton.offsets.tolist())),
        ends=tuple(map(tuple, skeleton.ends.tolist())),
        behaviours=behaviours,
        speeds=speeds,
        clips=bundle.graph.clips,
        digest=bundle.digest,
        attribution=bundle.attribution,
        idle_seconds=limits.idle_seconds,
        characters=limits.session_characters,
        message_bytes=CLIENT_MESSAGE_BYTES,
        messages_per_tick=limits.messages_per_tick,
        resume_seconds=limits.resume_seconds,
        **more,
    )
    encode_checked(welcome)
    return welcome


def welcome_to(session: Session, welcome: m.Welcome, tick: int, *, resumed: bool) -> m.Welcome:
    """The welcome of one session; ``resumed`` if it is not new."""
    fights = ((number, one.opponent) for number, one in session.characters.items() if one.steered)
    return replace(
        welcome,
        tick=tick,
        token=session.token,
        resumed=resumed,
        sequence=session.sequence,
        spawned=tuple(session.characters),
        opponents=UNSET if welcome.opponent is UNSET else tuple(fights),
    )
