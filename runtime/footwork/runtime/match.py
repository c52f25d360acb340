"""A match: two fighters on one world, who decide by their styles or as somebody else lets them."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ACTIVITIES
from footwork.controllers.fight_map import FightMap, fight_map
from footwork.controllers.fighters import BY_ITSELF, new_fighters
from footwork.controllers.fighting_style import FightingStyle, styles_for_kernels
from footwork.controllers.prediction import no_paths
from footwork.controllers.shadow import NO_TABLE, Shadowing
from footwork.controllers.shadowing import TableShadowing
from footwork.controllers.supervisor import Minds, undecided
from footwork.errors import InputError
from footwork.motion.angle import wrapped
from footwork.motion.bundle import Bundle
from footwork.motion.fighting_points import fighting_points
from footwork.motion.hops import Hops, hops_within
from footwork.motion.shadowing_lookahead import rules_of_shadowing
from footwork.motion.shadowing_task import ShadowingTask
from footwork.runtime.characters import Motion, motion_of
from footwork.runtime.hits import BodyPoints
from footwork.runtime.match_rules import MatchRules, rules_for_kernels
from footwork.runtime.match_ticks import Ring, Room, fight, new_room
from footwork.runtime.tally import Tally, Track, new_tally, new_track
from footwork.runtime.world import World

LONGEST_PLAY = 1 << 20
"""Ticks of one call."""
_USUAL_RULES = MatchRules()


@dataclass(frozen=True, eq=False)
class FightGround:
    """What all matches on one bundle share: computed once, then only read.

    Args:
        bundle: the bundle.
        world: its fight map.
        hops: of the state in which fighters shadow.
        motion: what worlds on it share.
    """

    bundle: Bundle
    world: FightMap
    hops: Hops
    motion: Motion


def fight_ground(bundle: Bundle) -> FightGround:
    """What matches on a bundle share.

    Raises:
        InputError: for a bundle that nobody can fight with (``fight_map``).
    """
    world = fight_map(bundle)
    if bundle.annotation is None:
        raise InputError("no states", bundle.graph.where)
    return FightGround(bundle, world, hops_within(bundle.graph, bundle.annotation, 0), motion_of(bundle.graph))


def table_of(bundle: Bundle) -> TableShadowing | None:
    """What a bundle has to shadow by, None for nothing but the rule."""
    if bundle.shadowing is None or bundle.annotation is None:
        return None
    return TableShadowing(bundle.graph, bundle.annotation, bundle.shadowing)


@dataclass(frozen=True)
class Relative:
    """Where a fighter has its opponent.

    Args:
        x: to its left, metres.
        z: ahead, metres.
        facing: the opponent's yaw less one's own, radians within -pi..pi.
    """

    x: float
    z: float
    facing: float

    @property
    def distance(self) -> float:
        """Between the hips, metres."""
        return float(np.hypot(self.x, self.z))

    @property
    def bearing(self) -> float:
        """The opponent's direction less one's own facing, radians; 0 straight ahead, positive left."""
        return float(np.arctan2(self.x, self.z))


class Match:
    """Two fighters, 0 and 1.

    A seed gives where in the footwork each begins, and its share of chance; the same seed gives the same bytes.

    Args:
        ground: of the bundle.
        styles: of both fighters.
        seed: from 0.
        rules: of the match.
        shadowing: a table to shadow by, in place of the rule.
        inertialise: whether transitions are smoothed.
        foot_lock: whether feet that stand stay where they are shown.

    Attributes:
        world: the world they are in, fighter i in slot i.
        fighters: what is remembered of them besides.
        tally: what was counted.
        tick: ticks made.
        track: the ticks last made, and what happened in them.
        minds, ring, room: what the kernels take.

    Raises:
        InputError: for other than two styles, and a seed below 0.
    """

    def __init__(
        self,
        ground: FightGround,
        styles: Sequence[FightingStyle],
        seed: int = 0,
        *,
        rules: MatchRules = _USUAL_RULES,
        shadowing: TableShadowing | None = None,
        inertialise: bool = True,
        foot_lock: bool = True,
    ) -> None:
        if len(styles) != 2:
            raise InputError(f"{len(styles)} styles, expected one for each of two fighters", "match")
        if seed < 0:
            raise InputError(f"seed {seed}, expected 0 or more", "match")
        graph = ground.bundle.graph
        self.ground, self.seed, self.styles, self.rules, self.shadowing = ground, seed, tuple(styles), rules, shadowing
        self.world = World(graph, 2, inertialise=inertialise, foot_lock=foot_lock, motion=ground.motion)
        self.fighters = new_fighters(seed)
        self.tally: Tally = new_tally()
        lookahead = rules_of_shadowing(ShadowingTask()) if shadowing is None else shadowing.rules
        values = NO_TABLE if shadowing is None else shadowing.values
        self.minds = Minds(ground.world, styles_for_kernels(styles), Shadowing(ground.hops, lookahead, values))
        world, body = self.world, graph.skeleton
        points = BodyPoints(body.parents, body.offsets, *fighting_points(body))
        self.ring = Ring(rules_for_kernels(rules), world.characters, world.motion, world.smoothing, points)
        self.room: Room = new_room(no_paths(), graph.skeleton.joint_count)
        self.track: Track = new_track(0)
        self._start(rules.start)

    def _start(self, apart: float) -> None:
        """Put both face to face somewhere in the footwork, by the seed."""
        random = np.random.default_rng(self.seed)
        segments = self.ground.world.segments
        last = segments["last"][segments["state"] == 0]
        for who in range(2):
            node = int(last[random.integers(len(last))])
            self.world.spawn(node, 0.0, (0.5 - who) * -apart, who * np.pi)

    @property
    def tick(self) -> int:
        """Ticks made."""
        return int(self.tally.clock["ticks"][0])

    def step(self) -> None:
        """Make one tick."""
        self.play(1)

    def play(self, ticks: int, *, shown: bool = False) -> NDArray[np.float32]:
        """Make ticks; ``track`` then holds them, and what happened in them.

        Args:
            ticks: how many, LONGEST_PLAY at most.
            shown: whether poses are wanted.

        Returns:
            The poses at each tick: place of joint 0, then local rotations joint by joint; none where not wanted.
            # (ticks or 0, 2, 3 + 4 J)

        Raises:
            InputError: for fewer than none or too many ticks.
        """
        if not 0 <= ticks <= LONGEST_PLAY:
            raise InputError(f"{ticks} ticks, expected 0 to {LONGEST_PLAY}", "play")
        joints = self.world.graph.skeleton.joint_count
        poses = np.empty((ticks if shown else 0, 2, 3 + 4 * joints), dtype=np.float32)
        self.track = new_track(ticks)
        fight(self.minds, self.fighters, self.ring, self.room, self.tally, self.track, ticks, poses)
        return poses

    def choose(self, who: int, *, activity: str | None = None, segment: int | None = None) -> None:
        """Let a fighter do something else than it would by itself, from its next decision on.

        An activity holds until another is chosen; its best action is taken, whether it is reasonable or not, and where
        there is none the fighter shadows. A segment is a goal: of an attack or an evasion to go to, or of footwork that
        can be reached at once; it holds for one decision, before the activity. Without an activity the fighter decides
        by itself.

        Raises:
            InputError: for no fighter, activity or segment.
        """
        if who not in (0, 1):
            raise InputError(f"fighter {who}, expected 0 or 1", "match")
        if activity is not None and activity not in ACTIVITIES:
            raise InputError(f"activity {activity!r}, expected {', '.join(ACTIVITIES)}", "match")
        segments = len(self.ground.world.segments)
        if segment is not None and not 0 <= segment < segments:
            raise InputError(f"segment {segment}, expected 0 to {segments - 1}", "match")
        fighter = self.fighters[who]
        fighter["chosen_activity"] = BY_ITSELF if activity is None else ACTIVITIES.index(activity)
        fighter["chosen_goal"] = BY_ITSELF if segment is None else segment

    def relative(self, who: int) -> Relative:
        """Where a fighter has its opponent."""
        own, other = self.world.place[who], self.world.place[1 - who]
        dx, dz = other[0] - own[0], other[1] - own[1]
        cosine, sine = np.cos(own[2]), np.sin(own[2])
        facing = float(wrapped(other[2] - own[2]))
        return Relative(float(dx * cosine - dz * sine), float(dx * sine + dz * cosine), facing)

    def activity(self, who: int) -> str:
        """What a fighter does."""
        return ACTIVITIES[self.fighters["activity"][who]]

    def undecided(self, who: int) -> bool:
        """Whether a fighter decides in the next tick."""
        return bool(undecided(self.ground.world.nodes, self.fighters[who], self.world.node[who]))

    @property
    def health(self) -> NDArray[np.float64]:
        """Of both, 1 at the beginning of a round.  # (2,)"""
        return self.fighters["health"]

    @property
    def stamina(self) -> NDArray[np.float64]:
        """Of both, 1 when rested.  # (2,)"""
        return self.fighters["stamina"]

    @property
    def winner(self) -> int | None:
        """Who has won more rounds, or of as many has dealt more damage; None where neither has."""
        for counted in (self.tally.of["rounds"], self.tally.of["dealt"]):
            if counted[0] != counted[1]:
                return int(np.argmax(counted))
        return None

    def digest(self) -> str:
        """A digest of all that is remembered of both fighters."""
        return hashlib.blake2b(self.rows(), digest_size=16).hexdigest()

    def rows(self) -> bytes:
        """All that is remembered of both fighters, as bytes."""
        return b"".join(array.tobytes() for array in (*self.world.characters, self.fighters, *self.tally))
