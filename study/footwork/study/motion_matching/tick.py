"""One tick of motion matching, compiled: look ahead, search, step, and bring character and simulated root together."""

import math
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.moves import LEAP
from footwork.motion.tick import TICK
from footwork.motion.turn_warp import turn_about
from footwork.study.motion_matching.features import AHEAD, COUNT, TRAJECTORY_DIRECTION, TRAJECTORY_POSITION
from footwork.study.motion_matching.search import NOWHERE, distance, nearest
from footwork.study.motion_matching.simulated_root import NUMBERS, move_character, pull_to, root_after, wrapped

_POSITION, _DIRECTION = TRAJECTORY_POSITION.start, TRAJECTORY_DIRECTION.start


class Memory(NamedTuple):
    """What is remembered of characters, by slot.

    Args:
        root: the simulated roots.  # (slots, 8)
        asked: what was asked for last: heading in the world (rad), speed (m/s) and behaviour.  # (slots, 3)
        wait: ticks until the next search.  # (slots,)
    """

    root: NDArray[np.float64]
    asked: NDArray[np.float64]
    wait: NDArray[np.int64]


def memory_for(slots: int) -> Memory:
    """Room for so many characters that begin."""
    return Memory(np.zeros((slots, NUMBERS)), np.zeros((slots, 3)), np.zeros(slots, np.int64))


@numba.njit(cache=True, nogil=True)
def _note(asked, heading, speed, behaviour, options):
    """Remember what is asked for; whether it changed sharply."""
    east = speed * math.sin(heading) - asked[1] * math.sin(asked[0])
    north = speed * math.cos(heading) - asked[1] * math.cos(asked[0])
    turned = abs(wrapped(heading - asked[0]))
    sharp = behaviour != asked[2] or math.hypot(east, north) > options.sharp_velocity or turned > options.sharp_turn
    asked[0], asked[1], asked[2] = heading, speed, behaviour
    return sharp


@numba.njit(cache=True, nogil=True)
def write_query(query, node, root, speed, heading, data, options):
    """The pose of the frame shown, and where the simulated root will be, as features."""
    for k in range(_POSITION):
        query[k] = data.values[node, k]
    for k in range(len(AHEAD)):
        x, z, yaw, _, _, _, _, _ = root_after(root, speed, heading, options, AHEAD[k] * TICK)
        _write_feature(query, _POSITION + 2 * k, x, data)
        _write_feature(query, _POSITION + 2 * k + 1, z, data)
        _write_feature(query, _DIRECTION + 2 * k, math.sin(yaw), data)
        _write_feature(query, _DIRECTION + 2 * k + 1, math.cos(yaw), data)


@numba.njit(cache=True, nogil=True)
def _write_feature(query, k, value, data):
    query[k] = (value - data.offset[k]) / data.scale[k]


@numba.njit(cache=True, nogil=True)
def _found(query, node, behaviour, goes_on, data, options, scratch):
    """The frame to play on from: the one shown where no other is nearer and it may go on."""
    number, cost = data.set_of[behaviour], np.inf
    if goes_on:
        cost = distance(query, data.values, node, np.inf) - options.transition_cost
    around = (node - options.skipped_around, node + options.skipped_around + 1)
    found, _ = nearest(query, data.sets, number, around, cost, scratch)
    if found == NOWHERE and not goes_on:
        found, _ = nearest(query, data.sets, number, (NOWHERE, NOWHERE), cost, scratch)
    return node if found == NOWHERE else found


@numba.njit(cache=True, nogil=True)
def _turn(heading, step, target, data, turning):
    """The adjustment that turns a character after its step towards the heading, seen from before it."""
    gain = turning.gain if data.headed[target] else turning.gain_unheaded
    yaw = min(max(gain * wrapped(heading - step[2]), -turning.most), turning.most)
    return turn_about(data.pivot[target, 0], data.pivot[target, 1], yaw)


@numba.njit(cache=True, nogil=True)
def _adjust(root, speed, heading, step, target, data, options, adjustment):
    """Let a tick pass for the simulated root, and write how the character is adjusted after its step."""
    after = root_after(root, speed, heading, options, TICK)
    for k in range(NUMBERS):
        root[k] = after[k]
    move_character(root, step)
    if options.follows:
        by = _turn(heading, step, target, data, options.turning)
    else:
        by = pull_to(root, data.root_speed[target], abs(step[2]) / TICK, options.pull)
    move_character(root, by)
    if options.follows:
        root[:3] = 0.0
    for k in range(3):
        adjustment[k] = by[k]


@numba.njit(cache=True, nogil=True)
def choose(
    data: Any,
    options: Any,
    memory: Any,
    slots: NDArray,
    nodes: NDArray,
    places: NDArray,
    headings: NDArray,
    behaviours: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
) -> None:
    """Write the moves of all characters.

    Args:
        data: the ``Database``.
        options: the ``MatchingOptions``.
        memory: the ``Memory``, changed in place.
        slots: of the situations, as are the next four.  # (C,)
        nodes: the frames shown.  # (C,)
        places: where they stand.  # (C, 3)
        headings: wanted yaws in the world.  # (C,)
        behaviours: what is asked for.  # (C,)
        edge: of the moves, as are the last four.  # (C,)
        target: the frames moved to.  # (C,)
        displacement: as the capture has them.  # (C, 3)
        adjustment: what is added.  # (C, 3)
        natural: whether the capture goes on.  # (C,)
    """
    query = np.empty(COUNT, np.float32)
    scratch = np.empty(data.sets.large.shape[2], np.float32)
    for who in range(nodes.shape[0]):
        slot, node, behaviour = slots[who], nodes[who], behaviours[who]
        root, heading, speed = memory.root[slot], wrapped(headings[who] - places[who, 2]), data.speed[behaviour]
        sharp = _note(memory.asked[slot], headings[who], speed, behaviour, options)
        goes_on = data.edge[node] >= 0 and not (data.strict[behaviour] and data.behaviour[node + 1] != behaviour)
        frame = node
        if sharp or not goes_on or memory.wait[slot] <= 0:
            memory.wait[slot] = options.search_ticks
            write_query(query, node, root, speed, heading, data, options)
            frame = _found(query, node, behaviour, goes_on, data, options, scratch)
        memory.wait[slot] -= 1
        natural[who], target[who] = frame == node, frame + 1
        edge[who] = data.edge[frame] if frame == node else LEAP
        for k in range(3):
            displacement[who, k] = data.displacement[data.edge[frame], k]
        _adjust(root, speed, heading, displacement[who], frame + 1, data, options, adjustment[who])
