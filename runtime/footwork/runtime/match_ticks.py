"""Ticks of a match, any number of them in one compiled call: decide, move, strike, and count.

Both fighters decide from what was before either moved. What they decide is committed together.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.controllers.activity import ATTACK, EVADE, SHADOW
from footwork.controllers.aiming import aim
from footwork.controllers.fight_map import place_of
from footwork.controllers.fighters import BY_ITSELF, NO_GOAL
from footwork.controllers.prediction import Paths, begin_paths, next_edge
from footwork.controllers.supervisor import Minds, decide, undecided
from footwork.motion.planar import after, triple
from footwork.runtime.bodies import adjustment_for, push_apart
from footwork.runtime.characters import Characters, Motion, Smoothing
from footwork.runtime.hits import BodyPoints, shown_strike_distance
from footwork.runtime.match_rules import Rules
from footwork.runtime.tally import BEGUN, EVADING, HIT, MISSED, NOBODY, ROUND, Tally, Track, note
from footwork.runtime.ticking import advance, show_characters

UNDECIDED = -1


class Ring(NamedTuple):
    """What a tick works on besides minds and fighters.

    Args:
        rules: of the match.
        characters: what the world remembers of the two.
        motion: what they move on.
        smoothing: how they are shown.
        body: the points that count.
    """

    rules: Rules
    characters: Characters
    motion: Motion
    smoothing: Smoothing
    body: BodyPoints


class Room(NamedTuple):
    """Room to work in: the arrays of Moves for two, predicted paths, places and pushes, and what is shown."""

    edge: NDArray[np.int32]
    target: NDArray[np.int32]
    displacement: NDArray[np.float64]
    adjustment: NDArray[np.float64]
    natural: NDArray[np.bool_]
    paths: Paths
    there: NDArray[np.float64]
    pushes: NDArray[np.float64]
    decided: NDArray[np.int64]
    root: NDArray[np.float32]
    rotations: NDArray[np.float32]


def new_room(paths: Paths, joints: int) -> Room:
    """Room for two bodies of so many joints."""
    return Room(
        edge=np.zeros(2, np.int32),
        target=np.zeros(2, np.int32),
        displacement=np.zeros((2, 3)),
        adjustment=np.zeros((2, 3)),
        natural=np.zeros(2, np.bool_),
        paths=paths,
        there=np.zeros((2, 3)),
        pushes=np.zeros((2, 2)),
        decided=np.zeros((2, 3), np.int64),
        root=np.zeros((2, 3), np.float32),
        rotations=np.zeros((2, joints, 4), np.float32),
    )


@numba.njit(cache=True, nogil=True)
def fight(
    minds: Minds, fighters: NDArray, ring: Ring, room: Room, tally: Tally, track: Track, ticks: int, poses: NDArray
) -> None:
    """Make ticks of a match.

    Args:
        minds: what the fighters decide by.
        fighters: what is remembered of them.  # (2,) FIGHTER
        ring: what they fight in.
        room: to work in.
        tally: counts.
        track: written tick by tick, where it has rows.
        ticks: how many to make.
        poses: written where it has rows: place of joint 0, then local rotations joint by joint.  # (T, 2, 3 + 4 J)
    """
    slots, clock = np.arange(2), tally.clock[0]
    rules, characters, motion, smoothing, body = ring
    node, place, natural = characters.node, characters.place, characters.natural
    edge, target, as_captured = room.edge, room.target, room.natural
    displacement, adjustment = room.displacement, room.adjustment
    for tick in range(ticks):
        begin_paths(fighters, node, place, room.paths)
        _choose(minds, fighters, node, room, tally, track)
        _fill_moves(minds.world, fighters, minds.styles, rules, place, room)
        advance(slots, edge, target, displacement, adjustment, as_captured, characters, motion, smoothing)
        struck = _arrive(minds.world, fighters, rules, node, tally.of)
        if struck or tick < poses.shape[0]:
            show_characters(slots, 1.0, characters, motion, smoothing, room.root, room.rotations)
        if struck:
            _strike(minds.world.nodes, fighters, rules, body, node, room, tally, track)
        _count_round(rules, fighters, tally, track)
        if tick < track.node.shape[0]:
            _write_down(node, place, natural, fighters, track, tick)
        if tick < poses.shape[0]:
            _write_poses(room.root, room.rotations, poses[tick])
        clock.ticks += 1


@numba.njit(cache=True, nogil=True)
def _choose(minds, fighters, node, room, tally, track):
    """Let those decide who are at the end of what they had queued, and commit it together."""
    world, decided = minds.world, room.decided
    for who in range(2):
        decided[who, 0] = UNDECIDED
        if undecided(world.nodes, fighters[who], node[who]):
            decided[who, 0], decided[who, 1], decided[who, 2] = decide(minds, fighters, who, room.paths)
    for who in range(2):
        if decided[who, 0] == UNDECIDED:
            room.edge[who] = next_edge(world, int(node[who]), fighters[who].goal, fighters[who].activity)
        else:
            room.edge[who] = decided[who, 2]
            _commit(world, fighters[who], minds.styles[who], who, node[who], decided[who], tally, track)


@numba.njit(cache=True, nogil=True)
def _commit(world, fighter, style, who, node, decided, tally, track):
    """Queue what a fighter decided."""
    activity, goal, edge = decided
    counts, now = tally.of[who], tally.clock[0].ticks
    counts.decisions += 1
    fighter.calm = fighter.calm + 1 if activity == SHADOW else 0
    fighter.activity, fighter.goal = activity, goal
    fighter.until = NO_GOAL if goal == NO_GOAL else world.segments[goal].action_end
    fighter.chosen_goal = BY_ITSELF
    if activity == ATTACK:
        counts.attacks += 1
        fighter.stamina -= style.attack_cost
        fighter.rest = int(style.rest)
    elif activity == EVADE:
        counts.evades += 1
        fighter.stamina -= style.evade_cost
    if activity != SHADOW:
        note(track, now, BEGUN if activity == ATTACK else EVADING, who, goal, NOBODY, 0.0)
    else:
        fighter.rest = max(fighter.rest - 1, 0)
        if world.nodes[node].edge_end - world.nodes[node].edge_start == 1:
            there = world.edges[edge].target
            counts.forced_ticks += world.segments[world.nodes[there].segment].last - there + 1


@numba.njit(cache=True, nogil=True)
def _fill_moves(world, fighters, styles, rules, place, room):
    """The moves of both along their edges, turned, aimed and pushed apart."""
    there, adjustment = room.there, room.adjustment
    for who in range(2):
        edge = world.edges[room.edge[who]]
        target, step = edge.target, place_of(edge)
        room.target[who], room.natural[who] = target, edge.natural
        x, z, yaw = after(triple(place, who), step)
        aimed = aim(world, fighters, styles, who, room.paths, target, (x, z, yaw))
        for k in range(3):
            room.displacement[who, k], adjustment[who, k] = step[k], aimed[k]
        there[who, 0], there[who, 1], there[who, 2] = x + aimed[0], z + aimed[1], yaw
    push_apart(there, rules.apart, rules.push, room.pushes)
    for who in range(2):
        node = world.nodes[room.target[who]]
        x, z = adjustment[who, 0] + room.pushes[who, 0], adjustment[who, 1] + room.pushes[who, 1]
        turned = adjustment_for(there[who, 2], x, z, node.pivot_x, node.pivot_z, adjustment[who, 2])
        for k in range(3):
            adjustment[who, k] = turned[k]


@numba.njit(cache=True, nogil=True)
def _arrive(world, fighters, rules, node, counts):
    """What becomes of queues and strength with the step; whether a strike is at its contact."""
    struck = False
    for who in range(2):
        fighter, at = fighters[who], world.nodes[node[who]]
        if fighter.goal != NO_GOAL and at.segment == fighter.goal:
            fighter.goal = NO_GOAL
        fighter.stamina = min(fighter.stamina + rules.recovery, 1.0)
        if fighter.activity == SHADOW:
            counts[who].shadow_ticks += 1
        elif fighter.activity == EVADE:
            counts[who].evade_ticks += 1
        else:
            counts[who].attack_ticks += 1
            struck |= _at_contact(fighter, at)
    return struck


@numba.njit(cache=True, nogil=True)
def _at_contact(fighter, at):
    return fighter.activity == ATTACK and fighter.goal == NO_GOAL and at.limb >= 0


@numba.njit(cache=True, nogil=True)
def _strike(nodes, fighters, rules, body, node, room, tally, track):
    """Judge the strikes that are at their contact, both from the same poses."""
    for who in range(2):
        at = nodes[node[who]]
        if not _at_contact(fighters[who], at):
            continue
        distance, target = shown_strike_distance(room.root, room.rotations, body, at.limb, who)
        counts, other, now = tally.of[who], 1 - who, tally.clock[0].ticks
        counts.strikes += 1
        hit, worth = distance <= rules.limb, distance - rules.limb
        if hit:
            worth = rules.damage * min(1.0, at.speed / rules.full_speed)
            counts.hits += 1
            counts.dealt += worth
            fighters[other].health -= worth
        elif fighters[other].activity == EVADE:
            tally.of[other].evaded += 1
        note(track, now, HIT if hit else MISSED, who, at.limb, target, worth)


@numba.njit(cache=True, nogil=True)
def _count_round(rules, fighters, tally, track):
    """End the round when its time is over or somebody is beaten; both begin the next one fresh, where they are."""
    clock = tally.clock[0]
    clock.round_ticks += 1
    beaten = min(fighters[0].health, fighters[1].health) <= 0.0
    if clock.round_ticks < rules.round_ticks and not beaten:
        return
    ahead = fighters[0].health - fighters[1].health
    winner = NOBODY if ahead == 0.0 else (0 if ahead > 0.0 else 1)
    if winner != NOBODY:
        tally.of[winner].rounds += 1
    note(track, clock.ticks, ROUND, winner, int(beaten), NOBODY, abs(ahead))
    clock.round_ticks = 0
    clock.rounds += 1
    for who in range(2):
        fighters[who].health = 1.0
        fighters[who].stamina = 1.0


@numba.njit(cache=True, nogil=True)
def _write_down(node, place, natural, fighters, track, tick):
    for who in range(2):
        track.node[tick, who], track.activity[tick, who] = node[who], fighters[who].activity
        track.natural[tick, who] = natural[who]
        for k in range(3):
            track.place[tick, who, k] = place[who, k]


@numba.njit(cache=True, nogil=True)
def _write_poses(root, rotations, poses):
    for who in range(2):
        for k in range(3):
            poses[who, k] = root[who, k]
        for joint in range(rotations.shape[1]):
            for k in range(4):
                poses[who, 3 + 4 * joint + k] = rotations[who, joint, k]
