"""Films for the live view: characters of whom every pose is known, as one file of the page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from footwork.errors import InputError
from footwork.motion.tick import TICK_RATE

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help loads no numerics
    import numpy as np
    from numpy.typing import NDArray

    from footwork.motion.graph import MotionGraph

LONGEST_SECONDS = 600.0
"""Of a film: a browser keeps all of it."""


@dataclass(frozen=True, eq=False)
class Role:
    """What one character of a film does, F frames long.

    Args:
        title: for people.
        first: the film's frame at which it comes, from 0.
        poses: place of joint 0, then local rotations joint by joint.  # (F, 3 + 4 J) float32
        behaviour: numbers of the film's behaviours, -1 for none.  # (F,)
        transition: whether a step to this frame's tick left the captured order.  # (F,)
        node: of the graph.  # (F,)
        health: 1 for unhurt, where there is such a thing.  # (F,)
    """

    title: str
    first: int
    poses: NDArray[np.float32]
    behaviour: NDArray[np.int64]
    transition: NDArray[np.bool_]
    node: NDArray[np.int64]
    health: NDArray[np.float64] | None = None


def packed(
    graph: MotionGraph,
    behaviours: Sequence[str],
    roles: Sequence[Role],
    *,
    rate: int = TICK_RATE,
    first_tick: int = 1,
    attribution: Sequence[str] = (),
) -> bytes:
    """A film as one MessagePack map: ``welcome`` as in the protocol, ``first_tick``, ``frames``, and ``roles``.

    A role has a ``title``, the frame ``first`` at which it comes, and little-endian arrays of what it does from then
    on: ``poses`` (3 + 4 J float32 each), ``behaviour`` (int16), ``transition`` (uint8), ``clip`` and ``frame`` (int32),
    and ``health`` (float32) or nothing.

    Args:
        graph: what the characters move on.
        behaviours: their names.
        roles: the characters.
        rate: frames a second.
        first_tick: of the first frame.
        attribution: of the bundle.
    """
    import msgpack

    skeleton = graph.skeleton
    welcome = {
        "tick_rate": TICK_RATE,
        "frame_rate": rate,
        "joints": skeleton.names,
        "parents": skeleton.parents.tolist(),
        "offsets": skeleton.offsets.tolist(),
        "ends": skeleton.ends.tolist(),
        "behaviours": tuple(behaviours),
        "clips": graph.clips,
        "attribution": tuple(attribution),
    }
    frames = max(role.first + len(role.poses) for role in roles)
    shown = [_packed_role(role, graph) for role in roles]
    return msgpack.Packer().pack({"welcome": welcome, "first_tick": first_tick, "frames": frames, "roles": shown})


def _packed_role(role: Role, graph: MotionGraph) -> dict[str, Any]:
    clip, frame = graph.nearest_source
    return {
        "title": role.title,
        "first": role.first,
        "poses": role.poses.astype("<f4").tobytes(),
        "behaviour": role.behaviour.astype("<i2").tobytes(),
        "transition": role.transition.astype("u1").tobytes(),
        "clip": clip[role.node].astype("<i4").tobytes(),
        "frame": frame[role.node].astype("<i4").tobytes(),
        "health": None if role.health is None else role.health.astype("<f4").tobytes(),
    }


def ticks_within(seconds: float, option: str) -> int:
    """So many seconds of a film in ticks.

    Raises:
        InputError: for none, and for more than LONGEST_SECONDS.
    """
    if not 1.0 / TICK_RATE <= seconds <= LONGEST_SECONDS:
        raise InputError(f"{seconds:g} seconds of a film, expected up to {LONGEST_SECONDS:g}", option)
    return round(seconds * TICK_RATE)
