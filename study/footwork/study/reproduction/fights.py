"""The graph that fighters of the reproduction move on, and a bout of theirs in numbers."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from footwork.controllers.activity import ACTIVITIES
from footwork.controllers.fighting_style import STYLES
from footwork.controllers.shadowing import TableShadowing
from footwork.motion.bundle import Bundle
from footwork.motion.state_machine import StateMachine
from footwork.motion.tick import TICK_RATE
from footwork.runtime.match import FightGround, Match, fight_ground
from footwork.study.reproduction.row import Cause, Judgement, unjudged
from footwork.study.reproduction.state_annotated import MACHINE
from footwork.study.reproduction.workbench import Workbench
from footwork.study.shadowing_trials import bearings, distances
from footwork.training.build import build_bundle
from footwork.training.graph_options import GraphOptions

SET = "fighting"
FIGHTING = StateMachine((replace(MACHINE.states[0], shadowing=True), *MACHINE.states[1:]))
STYLE = STYLES["balanced"]


@dataclass(frozen=True)
class Bout:
    """A bout of two fighters of one style.

    Args:
        seconds: how long it took, of the fighters' own time.
        distance: mean between the fighters, metres, and error of the distance that they keep, while both shadow.
        facing: mean error, degrees, while they shadow.
        share: of the time in each activity.
        forced: share of the time after decisions that left no choice.
        counts: attacks, strikes, hits, evades and evaded strikes of both.
        nearest: that hips came, metres.
        longest: seconds without a new segment, of either.
    """

    seconds: float
    distance: float
    distance_error: float
    facing: float
    share: dict[str, float]
    forced: float
    counts: dict[str, int]
    nearest: float
    longest: float


def without_fighting(bench: Workbench, claims: tuple[str, ...]) -> list[Judgement]:
    """Judgements where the motions have no fighting; none where they have."""
    if (bench.motions.folder / SET).is_dir():
        return []
    return [unjudged(claim, f"The motions have no folder {SET}.", Cause.DATA) for claim in claims]


def fight_bundle(bench: Workbench, *, mirror: bool = False) -> tuple[Bundle, dict[str, Any]]:
    """The annotated graph of all fighting capture at the knee, with its table of shadowing, and the build's report."""
    options = GraphOptions(graph="annotated", mirror=mirror)

    def build() -> tuple[Bundle, dict[str, Any]]:
        bench.tell(f"{SET}, states and shadowing", 0.0)
        return build_bundle(bench.dataset(SET, whole=True), options, machine=FIGHTING)

    return bench.once(("fight bundle", mirror), build)


def ground_of(bench: Workbench, *, mirror: bool = False) -> FightGround:
    """What matches on that graph share."""
    return bench.once(("fight ground", mirror), lambda: fight_ground(fight_bundle(bench, mirror=mirror)[0]))


def bout(ground: FightGround, seconds: float, table: TableShadowing | None, *, seed: int = 1) -> Bout:
    """A bout by the usual style; they shadow by a table, or by the rule where there is none."""
    match = Match(ground, (STYLE, STYLE), seed, shadowing=table, inertialise=False, foot_lock=False)
    match.play(round(seconds * TICK_RATE))
    track, of = match.track, match.tally.of
    apart, off = distances(track.place), np.degrees(np.abs(bearings(track.place)))
    shadows = track.activity == ACTIVITIES.index("shadow")
    both = shadows.all(axis=1)
    ticks = {name: float(of[f"{name}_ticks"].sum()) for name in ACTIVITIES}
    return Bout(
        seconds=seconds,
        distance=float(apart[both].mean()),
        distance_error=float(np.abs(apart[both] - STYLE.distance).mean()),
        facing=float(off[shadows].mean()),
        share={name: count / sum(ticks.values()) for name, count in ticks.items()},
        forced=float(of["forced_ticks"].sum() / sum(ticks.values())),
        counts={name: int(of[name].sum()) for name in ("attacks", "strikes", "hits", "evades", "evaded")},
        nearest=float(apart.min()),
        longest=max(_longest(ground, track.node[:, who]) for who in (0, 1)),
    )


def _longest(ground: FightGround, node: np.ndarray) -> float:
    """Seconds between a fighter's changes of segment, at most."""
    segment = ground.world.nodes["segment"][node]
    # a segment that leads to itself begins again
    changes = np.flatnonzero((segment[1:] != segment[:-1]) | (node[1:] <= node[:-1]))
    return float(np.diff(np.concatenate([[0], changes, [len(node) - 1]])).max() / TICK_RATE)
