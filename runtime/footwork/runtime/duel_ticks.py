"""Ticks of duels: each player's commands become choices in a match, made by the kernel of all matches."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ACTIVITIES, ATTACK, EVADE, SHADOW
from footwork.controllers.fighters import BY_ITSELF
from footwork.controllers.fighting_style import styles_for_kernels
from footwork.controllers.orders import Orders, ask
from footwork.controllers.prediction import no_paths
from footwork.controllers.shadow import NO_TABLE, Shadowing
from footwork.controllers.stepping import STAND, wish_towards
from footwork.controllers.supervisor import Minds, undecided
from footwork.motion.fighting_points import fighting_points
from footwork.motion.shadowing_lookahead import rules_of_shadowing
from footwork.motion.shadowing_task import ShadowingTask
from footwork.runtime.characters import Characters
from footwork.runtime.duels import DuelSteering
from footwork.runtime.hits import BodyPoints
from footwork.runtime.match import table_of
from footwork.runtime.match_rules import rules_for_kernels
from footwork.runtime.match_ticks import Ring, fight, new_room
from footwork.runtime.single_ticks import SingleTicks
from footwork.runtime.tally import EVENTS, Tally, new_track
from footwork.runtime.world import World

_STANDS_BELOW = 0.25  # m/s: who is asked for less stands


class Happening(NamedTuple):
    """What happened in a duel within a tick.

    Args:
        kind: one of ``tally.EVENTS``.
        slot: of whom did it; for a round of whom won it, -1 for nobody.
        other: of whom that one fights; of a round that nobody won, of the player.
        worth: damage, or metres that a strike missed by.
    """

    kind: str
    slot: int
    other: int
    worth: float


class Pair(NamedTuple):
    """A duel as the kernel of matches takes it: views of what is remembered of its two slots."""

    fighters: NDArray[np.void]
    ring: Ring
    tally: Tally


class DuelTicks(SingleTicks):
    """Makes the ticks of a world of duels; of each pair of slots, both or none.

    Args:
        steering: what they decide by.
        world: where the characters are, players in even slots and each one's opponent in the slot after.
        orders: what the players ask for.

    Attributes:
        happened: in the tick last made.
    """

    def __init__(self, steering: DuelSteering, world: World, orders: Orders) -> None:
        super().__init__(world, orders)
        self._steering = steering
        self._map, opponent = steering.ground.world, steering.opponent
        table = table_of(steering.ground.bundle) if opponent.table else None
        lookahead = rules_of_shadowing(ShadowingTask()) if table is None else table.rules
        shadowing = Shadowing(steering.ground.hops, lookahead, NO_TABLE if table is None else table.values)
        self._minds = Minds(self._map, styles_for_kernels([opponent.player, opponent.style]), shadowing)
        self._costs = {ATTACK: opponent.player.attack_cost, EVADE: opponent.player.evade_cost}
        joints = world.graph.skeleton.joint_count
        self._room, self._track = new_room(no_paths(), joints), new_track(1)
        self._unseen = np.empty((0, 2, 3 + 4 * joints), dtype=np.float32)
        steering.memory(world.capacity)
        self._pairs = self._all_pairs()
        self._actions = {steering.behaviours.index(ACTIVITIES[one]): one for one in (ATTACK, EVADE)}
        self.happened: list[Happening] = []

    def _all_pairs(self) -> list[Pair]:
        world, body, duel = self._world, self._world.graph.skeleton, self._steering.duel
        points = BodyPoints(body.parents, body.offsets, *fighting_points(body))
        rules, pairs = rules_for_kernels(self._steering.opponent.rules), []
        for slot in range(0, world.capacity - 1, 2):
            both = slice(slot, slot + 2)
            characters = Characters._make(array[both] for array in world.characters)
            ring = Ring(rules, characters, world.motion, world.smoothing, points)
            tally = Tally(duel.counts[both], duel.clock[slot : slot + 1])
            pairs.append(Pair(duel.fighters[both], ring, tally))
        return pairs

    def _step(self, slots: NDArray[np.intp]) -> None:
        ask(slots, self._world.graph.behaviour[self._world.node[slots]], self._orders.in_force)
        self.happened = []
        for slot in slots.tolist():
            if slot % 2 == 0 and slot // 2 < len(self._pairs):
                self._fight(slot // 2)

    def _fight(self, pair: int) -> None:
        fighters, ring, tally = self._pairs[pair]
        if undecided(self._map.nodes, fighters[0], int(self._world.node[2 * pair])):
            self._choose(2 * pair, fighters)
        self._track.events[0] = 0
        fight(self._minds, fighters, ring, self._room, tally, self._track, 1, self._unseen)
        self._note(2 * pair)

    def _choose(self, slot: int, fighters: NDArray[np.void]) -> None:
        """Let a player's character do what it is asked for, as far as its strength goes."""
        fighter = fighters[0]
        action = self._actions.get(int(self._orders.asked[slot]), SHADOW)
        tired = action != SHADOW and fighter["stamina"] < self._costs[action]
        if action == SHADOW or tired or (action == ATTACK and fighter["rest"] > 0):
            fighter["chosen_activity"], fighter["chosen_goal"] = SHADOW, self._step_to(slot)
        else:
            fighter["chosen_activity"], fighter["chosen_goal"] = action, BY_ITSELF

    def _step_to(self, slot: int) -> int:
        """The segment of footwork that goes where a player wants, BY_ITSELF at the end of one that is no footwork."""
        in_force, node = self._orders.in_force, int(self._world.node[slot])
        direction = float(in_force.heading[slot] - self._world.place[slot, 2])
        wish = STAND if in_force.speed[slot] < _STANDS_BELOW else wish_towards(direction)
        edge = self._steering.stepping.edge(int(self._map.nodes["segment"][node]), wish)
        return BY_ITSELF if edge < 0 else int(self._map.nodes["segment"][self._map.edges["target"][edge]])

    def _note(self, slot: int) -> None:
        """Take over what the kernel wrote down."""
        count = int(self._track.events[0])
        rows = zip(self._track.event[:count].tolist(), self._track.worth[:count].tolist(), strict=True)
        for (_, kind, who, _, _), worth in rows:
            nobody = who < 0
            did, other = (-1, slot) if nobody else (slot + who, slot + 1 - who)
            self.happened.append(Happening(EVENTS[kind], did, other, worth))
