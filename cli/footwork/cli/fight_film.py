"""Fights as films: every pose of two AI fighters, what they do and how they fare."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from footwork.cli.film import Role, packed, ticks_within
from footwork.errors import InputError

if TYPE_CHECKING:  # at run time they are imported where they are needed, so that --help loads no numerics
    from footwork.runtime.match import Match


def fight_film(bundle: Path, styles: Sequence[str], seed: int, seconds: float) -> bytes:
    """The film of the fight that ``footwork fight`` makes of the same styles and seed.

    Raises:
        InputError: for a bundle without fighters, styles that are not two, or a time that is too long.
    """
    from footwork.controllers.fighting_style import STYLES, style_named
    from footwork.motion.bundle import read_bundle
    from footwork.runtime.match import Match, fight_ground, table_of

    if len(styles) != 2:
        raise InputError(f"{len(styles)} styles, expected two", "--styles")
    ticks = ticks_within(seconds, "--seconds")
    ground = fight_ground(read_bundle(bundle))
    chosen = [style_named(name, STYLES) for name in styles]
    return film_of_match(Match(ground, chosen, seed, shadowing=table_of(ground.bundle)), styles, ticks)


def film_of_match(match: Match, titles: Sequence[str], ticks: int) -> bytes:
    """The film of the next ticks of a match."""
    from footwork.controllers.activity import ACTIVITIES

    first_tick = match.tick + 1
    roles = _roles(match, titles, ticks)
    bundle = match.ground.bundle
    return packed(bundle.graph, ACTIVITIES, roles, first_tick=first_tick, attribution=bundle.attribution)


def _roles(match: Match, titles: Sequence[str], ticks: int) -> list[Role]:
    import numpy as np

    joints = match.world.graph.skeleton.joint_count
    poses, health = np.empty((ticks, 2, 3 + 4 * joints), np.float32), np.empty((ticks, 2))
    node, activity, natural = np.empty((ticks, 2), int), np.empty((ticks, 2), int), np.empty((ticks, 2), bool)
    for tick in range(ticks):
        poses[tick] = match.play(1, shown=True)[0]
        health[tick], node[tick] = match.health, match.track.node[0]
        activity[tick], natural[tick] = match.track.activity[0], match.track.natural[0]
    return [
        Role(titles[who], 0, poses[:, who], activity[:, who], ~natural[:, who], node[:, who], health[:, who])
        for who in range(2)
    ]
