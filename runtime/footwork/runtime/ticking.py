"""The kernels of a tick: characters are moved and shown one after the other, as none knows of another."""

import numba
import numpy as np
from numpy.typing import NDArray

from footwork.motion.tick import TICK
from footwork.runtime.characters import Characters, Motion, Smoothing
from footwork.runtime.foot_lock import RELEASE_HALFLIFE, update_locks
from footwork.runtime.held_feet import hold_feet
from footwork.runtime.inertialisation import decay, decay_weights, jump
from footwork.runtime.moving import first_wrong_move, glided, move_place
from footwork.runtime.posing import pose


@numba.njit(cache=True, nogil=True)
def make_moves(
    slots: NDArray,
    edge: NDArray,
    target: NDArray,
    displacement: NDArray,
    adjustment: NDArray,
    natural: NDArray,
    characters: Characters,
    motion: Motion,
    smoothing: Smoothing,
) -> int:
    """Take characters through one tick, in place; -1, or the first whose move cannot be made: nobody has moved then.

    Args:
        slots: rows of the characters, of the moves and of what is remembered.  # (n,)
        edge: of the moves, and so are target, displacement, adjustment and natural.  # (C,)
        characters: what is remembered of them.
        motion: what they move on.
        smoothing: how they are shown.
    """
    wrong = first_wrong_move(
        slots, characters.node, edge, target, displacement, adjustment, motion.edge_start, motion.target
    )
    if wrong >= 0:
        return wrong
    weights, dying = decay_weights(TICK, smoothing.halflife), decay_weights(TICK, RELEASE_HALFLIFE)
    for who in slots:
        if smoothing.foot_lock:
            _renew_locks(who, target[who], characters, motion, weights, dying)
        node, place = characters.node[who], characters.place[who]
        left = place[0], place[1], place[2]
        move_place(place, displacement[who], adjustment[who], characters.glide[who])
        characters.node[who], characters.edge[who], characters.natural[who] = target[who], edge[who], natural[who]
        if smoothing.inertialise:
            _decay(who, characters, weights)
            if not natural[who]:
                characters.ticks_left[who] = smoothing.settle_ticks
                _jump(who, node, left, characters, motion)
    return -1


@numba.njit(cache=True, nogil=True)
def _renew_locks(who, target, characters, motion, weights, dying):
    update_locks(
        characters.node[who],
        target,
        characters.place[who],
        motion.contacts,
        weights,
        dying,
        motion.root_position,
        motion.nodes,
        characters.offsets[who],
        characters.roots[who],
        motion.legs,
        motion.bones,
        motion.floor,
        characters.locked[who],
        characters.anchor[who],
        characters.slip[who],
        characters.stride[who],
    )


@numba.njit(cache=True, nogil=True)
def _decay(who, characters, weights):
    """Let one character's offsets decay over a tick, and drop them where nothing is left to see."""
    if characters.ticks_left[who] == 0:
        return
    characters.ticks_left[who] -= 1
    if characters.ticks_left[who] == 0:
        characters.offsets[who] = 0.0
        characters.roots[who] = 0.0
    else:
        decay(characters.offsets[who], characters.roots[who], weights)


@numba.njit(cache=True, nogil=True)
def _jump(who, node, place, characters, motion):
    """Take the jump from a node and place, to where a character's tick now begins, into its offsets."""
    jump(
        node,
        place,
        characters.node[who],
        glided(characters.place[who], characters.glide[who], -1.0),
        motion.root_position,
        motion.root_velocity,
        motion.nodes,
        characters.offsets[who],
        characters.roots[who],
    )


@numba.njit(cache=True, nogil=True)
def show_characters(
    slots: NDArray,
    fraction: float,
    characters: Characters,
    motion: Motion,
    smoothing: Smoothing,
    shown_root: NDArray,
    shown_rotations: NDArray,
) -> None:
    """Write the poses of characters at a fraction of the tick into their rows of the last two arrays.

    Args:
        slots: which.  # (n,)
        fraction: how much of the tick has passed, above 0 and at most 1.
        characters: what is remembered of them.
        motion: what they move on.
        smoothing: how they are shown.
        shown_root: joint 0 in the world, m.  # (C, 3) float32
        shown_rotations: local rotations xyzw, joint 0 in the world.  # (C, J, 4) float32
    """
    back = (1.0 - fraction) * TICK
    weights = decay_weights(fraction * TICK, smoothing.halflife)
    dying = decay_weights(fraction * TICK, RELEASE_HALFLIFE)
    rows = np.empty((4, motion.nodes.shape[2]), dtype=np.float32)
    goals = np.empty((motion.legs.shape[0], 6))
    for who in slots:
        at = glided(characters.place[who], characters.glide[who], fraction - 1.0)
        _pose(who, at, back, weights, characters, motion, shown_root[who], shown_rotations[who], rows)
        if smoothing.foot_lock:
            _hold_feet(who, fraction, dying, characters, motion, shown_root[who], shown_rotations[who], goals)


@numba.njit(cache=True, nogil=True)
def _pose(who, place, back, weights, characters, motion, root, rotations, rows):
    pose(
        characters.node[who],
        place,
        back,
        weights,
        motion.root_position,
        motion.root_velocity,
        motion.nodes,
        characters.offsets[who],
        characters.roots[who],
        root,
        rotations,
        rows,
    )


@numba.njit(cache=True, nogil=True)
def _hold_feet(who, fraction, dying, characters, motion, root, rotations, goals):
    hold_feet(
        fraction,
        dying,
        motion.legs,
        motion.bones,
        motion.spans,
        motion.floor,
        characters.locked[who],
        characters.anchor[who],
        characters.slip[who],
        characters.stride[who],
        root,
        rotations,
        goals,
    )
