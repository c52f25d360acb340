"""A fight as a film for the live view: every pose of two AI fighters, what they do and how they fare."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help loads no numerics
    from footwork.runtime.match import Match

LONGEST_SECONDS = 600.0
_TICK_RATE = 30


def fight_film(bundle: Path, styles: Sequence[str], seed: int, seconds: float) -> bytes:
    """The film, as one MessagePack map: ``welcome`` as in the protocol, ``ticks``, and an entry for each fighter.

    A fighter has a ``title``, ``poses`` (ticks x (3 + 4 J) little-endian float32: place of joint 0, then rotations),
    ``health`` (ticks float32), ``behaviour`` and ``transition`` (ticks uint8), ``clip`` and ``frame`` (ticks int32).

    Raises:
        InputError: for a bundle without fighters, styles that are not two, or a time that is too long.
    """
    import msgpack

    from footwork.controllers.fighting_style import STYLES, style_named
    from footwork.motion.bundle import read_bundle
    from footwork.runtime.match import Match, fight_ground, table_of

    if len(styles) != 2:
        raise InputError(f"{len(styles)} styles, expected two", "--styles")
    if not 1.0 / _TICK_RATE <= seconds <= LONGEST_SECONDS:
        raise InputError(f"{seconds:g} seconds of a fight, expected up to {LONGEST_SECONDS:g}", "--seconds")
    ground = fight_ground(read_bundle(bundle))
    chosen = [style_named(name, STYLES) for name in styles]
    match = Match(ground, chosen, seed, shadowing=table_of(ground.bundle))
    fighters = _played(match, round(seconds * _TICK_RATE))
    titled = [{"title": style, **fighter} for style, fighter in zip(styles, fighters, strict=True)]
    return msgpack.Packer().pack({"welcome": _welcome(match), "ticks": match.tick, "fighters": titled})


def _welcome(match: Match) -> dict[str, Any]:
    from footwork.controllers.activity import ACTIVITIES

    graph = match.world.graph
    skeleton = graph.skeleton
    return {
        "tick_rate": _TICK_RATE,
        "frame_rate": _TICK_RATE,
        "joints": skeleton.names,
        "parents": skeleton.parents.tolist(),
        "offsets": skeleton.offsets.tolist(),
        "ends": skeleton.ends.tolist(),
        "behaviours": ACTIVITIES,
        "clips": graph.clips,
        "attribution": match.ground.bundle.attribution,
    }


def _played(match: Match, ticks: int) -> list[dict[str, bytes]]:
    """What is kept of both fighters, tick by tick."""
    import numpy as np

    joints = match.world.graph.skeleton.joint_count
    poses = np.empty((ticks, 2, 3 + 4 * joints), dtype="<f4")
    health, behaviour = np.empty((ticks, 2), dtype="<f4"), np.empty((ticks, 2), dtype=np.uint8)
    node, transition = np.empty((ticks, 2), dtype=np.int64), np.empty((ticks, 2), dtype=np.uint8)
    for tick in range(ticks):
        poses[tick] = match.play(1, shown=True)[0]
        health[tick], node[tick] = match.health, match.track.node[0]
        behaviour[tick], transition[tick] = match.track.activity[0], ~match.track.natural[0]
    clip, frame = match.world.graph.nearest_source
    kept = {
        "poses": poses,
        "health": health,
        "behaviour": behaviour,
        "transition": transition,
        "clip": clip[node].astype("<i4"),
        "frame": frame[node].astype("<i4"),
    }
    return [{name: values[:, who].tobytes() for name, values in kept.items()} for who in range(2)]
