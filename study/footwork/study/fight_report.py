"""What there is to say of a match: how fighters kept to each other, what they threw and landed, how their feet slid."""

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ACTIVITIES
from footwork.motion.angle import wrapped
from footwork.motion.tick import TICK_RATE
from footwork.runtime.match import Match
from footwork.runtime.tally import Track
from footwork.study.shown import ground_of, shown, shown_report, source_report, source_skating

CHUNK = 600 * TICK_RATE
"""Ticks that are made and looked at together."""


class Watched:
    """What is seen of a match tick by tick, from one or more tracks."""

    def __init__(self) -> None:
        self._distance: list[NDArray] = []
        self._facing: list[NDArray] = []
        self._activity: list[NDArray] = []

    def watch(self, track: Track) -> None:
        """Look at the ticks last made."""
        self._distance.append(distances(track))
        self._facing.append(facing_errors(track))
        self._activity.append(track.activity)

    def report(self) -> dict[str, Any]:
        """Distance, metres, and facing error, degrees, of both: mean and 95 %; that of shadowing by itself.

        And the longest time in which neither did anything but shadow.
        """
        distance, facing = np.concatenate(self._distance), np.degrees(np.concatenate(self._facing))
        activity = np.concatenate(self._activity)
        shadowing = facing[activity == 0]
        apart = {"mean": float(distance.mean()), "p95": float(np.percentile(distance, 95))}
        error = {"mean": float(facing.mean()), "p95": float(np.percentile(facing, 95))}
        alone = {"shadow_mean": float(shadowing.mean()) if shadowing.size else None}
        return {
            "longest_pause_s": longest_run((activity == 0).all(axis=1)) / TICK_RATE,
            "facing_error_deg": error | alone,
            "distance_m": apart | {"smallest": float(distance.min()), "largest": float(distance.max())},
        }


def distances(track: Track) -> NDArray[np.float64]:
    """Between the hips over the ground, metres.  # (T,)"""
    return np.hypot(*(track.place[:, 1, :2] - track.place[:, 0, :2]).T)


def facing_errors(track: Track) -> NDArray[np.float64]:
    """How far each looks past the other, radians.  # (T, 2)"""
    away = (track.place[:, 1, :2] - track.place[:, 0, :2])[:, None] * np.array([1.0, -1.0])[:, None]
    return np.abs(wrapped(np.arctan2(away[..., 0], away[..., 1]) - track.place[..., 2]))


def longest_run(of: NDArray[np.bool_]) -> int:
    """How many in a row are true at most.  # (T,)"""
    changes = np.flatnonzero(np.diff(of, prepend=False, append=False))
    return int((changes[1::2] - changes[::2]).max(initial=0))


def timed(match: Match, ticks: int) -> tuple[Watched, float]:
    """Make ticks of a match, and what was seen of it and how long it took, seconds, without compiling."""
    match.play(0)
    watched, wall = Watched(), 0.0
    while ticks > 0:
        start = time.perf_counter()
        match.play(min(ticks, CHUNK))
        wall += time.perf_counter() - start
        watched.watch(match.track)
        ticks -= CHUNK
    return watched, wall


def counts_report(match: Match) -> dict[str, Any]:
    """JSON-able: what was counted of both together, and of each in ``fighters``."""
    of = match.tally.of
    ticks = np.array([of[f"{name}_ticks"].sum() for name in ACTIVITIES])
    total = max(int(ticks.sum()), 1)
    edges = np.diff(match.world.graph.edge_start)
    names = "attacks", "strikes", "hits", "evades", "evaded", "decisions", "rounds"
    return {
        "attacks": int(of["attacks"].sum()),
        "strikes": int(of["strikes"].sum()),
        "hits": int(of["hits"].sum()),
        "evades": int(of["evades"].sum()),
        "evaded": int(of["evaded"].sum()),
        "activity_share": dict(zip(ACTIVITIES, (ticks / total).tolist(), strict=True)),
        "without_choice_share": float(of["forced_ticks"].sum() / total),
        "dead_ends": int((edges[match.track.node] == 0).sum()),
        "rounds": int(match.tally.clock["rounds"][0]),
        "winner": match.winner,
        "fighters": [{name: int(one[name]) for name in names} | {"damage_dealt": float(one["dealt"])} for one in of],
    }


def slide_report(match: Match, ticks: int) -> dict[str, Any]:
    """JSON-able: what feet slide and skate as they are shown in ticks of a match, and in the clips themselves.

    Of skating also what the frames that were shown come to in the clips: fights have more kicks than the clips have.
    """
    poses = match.play(ticks, shown=True).astype(np.float64)
    graph, track = match.world.graph, match.track
    ground = ground_of(graph)
    parts = [
        shown(
            graph,
            track.node[:, who],
            ~track.natural[:, who],
            poses[:, who, :3],
            poses[:, who, 3:].reshape(ticks, -1, 4),
            ground,
        )
        for who in range(2)
    ]
    of_frames = {"source_skating_ratio_of_frames_shown": source_skating(graph, track.node.ravel())}
    return shown_report(parts) | source_report(graph) | of_frames
